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
  return drawn(mesh).sse(problem_.textures.at(texture), problem_.reference);
}

Image ScreenErrors::picture(std::size_t mesh, std::size_t texture) { return drawn(mesh).picture(problem_.textures.at(texture)); }

const CoordinatePicture& ScreenErrors::drawn(std::size_t mesh) {
  const auto found = std::ranges::find(last_, mesh, &Drawn::mesh);
  if (found != last_.end()) {
    last_.splice(last_.begin(), last_, found);
    return last_.front().picture;
  }
  const Image& texture = problem_.textures.front();
  last_.push_front(
      {mesh, CoordinatePicture(draw_coordinates(renderer_, problem_.mesh(mesh), problem_.frame), texture.width(), texture.height())});
  ++meshes_drawn_;
  if (last_.size() > kKept) last_.pop_back();
  return last_.front().picture;
}

}  // namespace etalon::validation
