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
  const Drawn& shown = drawn(mesh);
  std::vector<std::uint64_t> errors;
  for (const TextureGroup& group : groups_) {
    const TextureGroup::Sums sums = shown.picture.sse(group, shown.reference);
    errors.insert(errors.end(), sums.begin(), sums.begin() + static_cast<std::ptrdiff_t>(group.textures().size()));
  }
  return errors;
}

Image ScreenErrors::picture(std::size_t mesh, std::size_t texture) { return drawn(mesh).picture.picture(problem_.textures.at(texture)); }

const ScreenErrors::Drawn& ScreenErrors::drawn(std::size_t mesh) {
  const auto found = std::ranges::find(last_, mesh, &Drawn::mesh);
  if (found != last_.end()) {
    last_.splice(last_.begin(), last_, found);
    return last_.front();
  }
  const Image& texture = problem_.textures.front();
  CoordinatePicture picture(draw_coordinates(renderer_, problem_.mesh(mesh), problem_.frame), texture.width(), texture.height());
  CoordinatePicture::Reference reference = picture.reference(problem_.reference);
  last_.push_front({mesh, std::move(picture), std::move(reference)});
  ++meshes_drawn_;
  if (last_.size() > kKept) last_.pop_back();
  return last_.front();
}

}  // namespace etalon::validation
