#include "validation/joint/terrain_problem.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/draw/scene.h"

namespace etalon::validation {

PictureFrame picture_frame(const terrain::TerrainView& view) {
  PictureFrame frame;
  frame.camera = {
      .eye = view.eye, .target = view.target, .up = view.up, .tan_half_fov_y = view.tan_half_fov_y, .near = view.near, .far = view.far};
  frame.width = view.width, frame.height = view.height;
  return frame;
}

Mesh full_mesh(const terrain::HeightField& field) { return terrain::level_mesh(field, terrain::uniform_grid(field.bits, field.bits), 0); }

std::size_t visible_triangles(Renderer& renderer, const Mesh& mesh, const PictureFrame& picture) {
  Frame frame{.width = picture.width, .height = picture.height, .guard = 2048, .state = {}, .targets = {}};
  frame.targets = {{TargetContent::triangle_id, kR32ui, {}}};
  frame.state = renderer.supported_state(frame.state);
  const DrawList list = make_scene(mesh, {Material{}}, picture.camera, frame);
  const Image ids = std::move(renderer.render(list, frame).front());
  std::vector<std::uint8_t> is_seen(mesh.faces.size());
  const auto* id = ids.channels<std::uint32_t>(0, 0);
  for (std::size_t n = 0; n < ids.texel_count(); ++n)
    if (id[n] != kNoTriangle) is_seen[list.source_faces[id[n]]] = 1;
  return static_cast<std::size_t>(std::ranges::count(is_seen, 1));
}

TerrainProblem::TerrainProblem(Renderer& renderer, const terrain::HeightField& field, const Image& image, const terrain::TerrainView& view,
                               const joint::LevelOptions& options)
    : frame_(picture_frame(view)), levels_(std::make_unique<joint::JointLevels>(joint::make_joint_levels(field, image, view, options))) {
  textures_ = joint::texture_levels(*levels_);
  const CoordinatePicture full(draw_coordinates(renderer, full_mesh(field), frame_), image.width(), image.height());
  if (full.covered_texels() == 0) throw InputError("view: it shows nothing of the terrain");
  ScreenProblem screen;
  screen.frame = frame_;
  screen.reference = full.picture(opaque_rgba(image));
  for (const Image& texture : textures_) screen.textures.push_back(opaque_rgba(texture));
  screen.mesh = [levels = levels_.get()](std::size_t i) { return terrain::level_mesh(levels->field, levels->levels, i); };
  errors_ = std::make_unique<ScreenErrors>(renderer, std::move(screen));
}

joint::Problem TerrainProblem::problem() {
  joint::Problem problem =
      joint::problem_of(*levels_, [errors = errors_.get()](std::size_t i, std::size_t j) { return errors->sse(i, j); });
  problem.errors_of_mesh = [errors = errors_.get()](std::size_t i) { return errors->sse_of_mesh(i); };
  return problem;
}

}  // namespace etalon::validation
