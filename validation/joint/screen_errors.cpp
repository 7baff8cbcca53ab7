#include "validation/joint/screen_errors.h"

#include <algorithm>

#include "core/base/error.h"

namespace etalon::validation {
namespace {

constexpr std::size_t kKept = 4;  // a search looks at neighbouring levels only

}  // namespace

ScreenErrors::ScreenErrors(Renderer& renderer, ScreenProblem problem) : renderer_(renderer), problem_(std::move(problem)) {
  ETALON_CHECK(!problem_.textures.empty(), "at least one texture");
}

std::uint64_t ScreenErrors::sse(std::size_t mesh, std::size_t texture) {
  const Drawn& shown = drawn(mesh);
  return shown.picture.sse(problem_.textures.at(texture), shown.reference);
}

std::vector<std::uint64_t> ScreenErrors::sse_of_mesh(std::size_t mesh) {
  const std::span<const Image> textures(problem_.textures);
  if (groups_.empty())
    for (std::size_t n = 0; n < textures.size(); n += TextureGroup::kMost)
      groups_.emplace_back(textures.subspan(n, std::min(TextureGroup::kMost, textures.size() - n)));
  if (row_ && row_->mesh == mesh) return row_->errors;
  DrawnCoordinates now = draw(mesh);
  std::vector<std::uint64_t> errors;
  if (row_) {
    // With C the error where both show the same and E the reference's energy there: error = error of the rest + C − E, in both.
    Row before = std::move(*row_);
    row_.reset();
    DrawnCoordinates rest{now.coordinates, now.ids};
    hide_what_both_show(before.drawn, rest);
    errors = errors_of(std::move(rest));
    const std::vector<std::uint64_t> rest_before = errors_of(std::move(before.drawn));
    for (std::size_t t = 0; t < errors.size(); ++t) errors[t] += before.errors[t] - rest_before[t];
  } else {
    errors = errors_of(now);
  }
  row_ = {mesh, std::move(now), errors};
  return errors;
}

std::vector<std::uint64_t> ScreenErrors::errors_of(DrawnCoordinates drawn) const {
  const Image& texture = problem_.textures.front();
  const CoordinatePicture picture(std::move(drawn), texture.width(), texture.height());
  const CoordinatePicture::Reference reference = picture.reference(problem_.reference);
  std::vector<std::uint64_t> errors;
  for (const TextureGroup& group : groups_) {
    const TextureGroup::Sums sums = picture.sse(group, reference);
    errors.insert(errors.end(), sums.begin(), sums.begin() + static_cast<std::ptrdiff_t>(group.textures().size()));
  }
  return errors;
}

DrawnCoordinates ScreenErrors::draw(std::size_t mesh) {
  ++meshes_drawn_;
  return draw_coordinates(renderer_, problem_.mesh(mesh), problem_.frame);
}

Image ScreenErrors::picture(std::size_t mesh, std::size_t texture) { return drawn(mesh).picture.picture(problem_.textures.at(texture)); }

const ScreenErrors::Drawn& ScreenErrors::drawn(std::size_t mesh) {
  const auto found = std::ranges::find(last_, mesh, &Drawn::mesh);
  if (found != last_.end()) {
    last_.splice(last_.begin(), last_, found);
    return last_.front();
  }
  const Image& texture = problem_.textures.front();
  CoordinatePicture picture(draw(mesh), texture.width(), texture.height());
  CoordinatePicture::Reference reference = picture.reference(problem_.reference);
  last_.push_front({mesh, std::move(picture), std::move(reference)});
  if (last_.size() > kKept) last_.pop_back();
  return last_.front();
}

}  // namespace etalon::validation
