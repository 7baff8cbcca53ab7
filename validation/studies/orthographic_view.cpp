#include "validation/studies/orthographic_view.h"

#include <algorithm>

#include "core/base/float_environment.h"
#include "core/draw/scene.h"

namespace etalon::validation {

StudyScene orthographic_scene(const Mesh& mesh, const std::shared_ptr<const Image>& texture, const SampleGrid& grid,
                              const RasterState& state) {
  const DefaultFloatEnvironment environment;
  StudyScene scene;
  scene.frame = {.width = grid.width + 2, .height = grid.height + 2, .guard = 2048, .state = state, .targets = {}};
  scene.frame.targets = {{TargetContent::color, kRgba8, {0, 0, 0, 1}}, {TargetContent::triangle_id, kR32ui, {}}};
  DrawList& list = scene.list;
  const BoundingBox box = bounding_box(mesh);
  const double depth = double{box.hi.z} - box.lo.z;
  for (const Wedge& wedge : mesh.wedges) {
    const Vec3f& p = mesh.positions[wedge.vertex.index];
    RasterVertex v;
    v.x = snap(p.x / grid.spacing + 1, state);
    v.y = snap(p.y / grid.spacing + 1, state);
    v.z = depth > 0 ? static_cast<float>(std::clamp((box.hi.z - double{p.z}) / depth, 0.0, 1.0)) : 0.0f;
    v.uv = wedge.uv;
    if (!mesh.colors.empty()) v.color = mesh.colors[wedge.vertex.index];
    list.vertices.push_back(v);
  }
  for (const auto& face : mesh.faces) list.triangles.push_back({face[0].index, face[1].index, face[2].index});
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) list.source_faces.push_back(f);
  Draw draw{.triangle_count = static_cast<std::uint32_t>(mesh.face_count())};
  if (texture != nullptr) {
    draw.shading = Shading::texture, draw.texture = 0;
    draw.sampler = {Filter::nearest, Wrap::clamp, Wrap::clamp};
    list.images = {texture};
  }
  list.draws = {draw};
  return scene;
}

}  // namespace etalon::validation
