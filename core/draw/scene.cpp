#include "core/draw/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/float_environment.h"
#include "core/draw/clip_placer.h"

namespace etalon {
namespace {

double rounded(double x, SnapRounding rounding) {
  const double below = std::floor(x), middle = below + 0.5;  // exact for |x| <= 2^30; x − below would not be
  switch (rounding) {
    case SnapRounding::nearest_even: return x > middle || (x == middle && (static_cast<std::int64_t>(below) & 1) != 0) ? below + 1 : below;
    case SnapRounding::half_up: return x >= middle ? below + 1 : below;
    case SnapRounding::half_away: return x > middle || (x == middle && x > 0) ? below + 1 : below;
    case SnapRounding::toward_zero: return x < 0 && x != below ? below + 1 : below;
    case SnapRounding::floor: return below;
  }
  return below;
}

// The images of a scene, each once, and its draws as faces come in.
class ListBuilder {
 public:
  ListBuilder(const std::vector<Material>& materials, DrawList& list) : materials_(materials), list_(list) {
    if (materials.empty()) throw InputError("scene: expected at least one material");
  }

  void begin_face(std::uint32_t material) {
    if (material >= materials_.size()) throw InputError(fmt::format("scene: face material {} of {}", material, materials_.size()));
    Draw draw;
    const Material& m = materials_[material];
    if (m.texture != nullptr) {
      draw.shading = m.indexing_map != nullptr ? Shading::indexed : Shading::texture;
      draw.texture = image(m.texture), draw.sampler = m.sampler;
      if (m.indexing_map != nullptr) draw.indexing_map = image(m.indexing_map), draw.map_sampler = m.map_sampler;
    }
    if (!list_.draws.empty()) {
      draw.first_triangle = list_.draws.back().first_triangle, draw.triangle_count = list_.draws.back().triangle_count;
      if (draw == list_.draws.back()) return;
    }
    draw.first_triangle = static_cast<std::uint32_t>(list_.triangles.size()), draw.triangle_count = 0;
    list_.draws.push_back(draw);
  }

  // All triangles that were added to the list since the last call come from `face`.
  void end_face(std::uint32_t face) {
    const auto added = static_cast<std::uint32_t>(list_.triangles.size() - list_.source_faces.size());
    list_.source_faces.insert(list_.source_faces.end(), added, face);
    list_.draws.back().triangle_count += added;
  }

 private:
  std::uint32_t image(const std::shared_ptr<const Image>& wanted) {
    for (std::size_t n = 0; n < list_.images.size(); ++n)
      if (list_.images[n] == wanted) return static_cast<std::uint32_t>(n);
    list_.images.push_back(wanted);
    return static_cast<std::uint32_t>(list_.images.size() - 1);
  }
  const std::vector<Material>& materials_;
  DrawList& list_;
};

void check_mesh(const Mesh& mesh) {
  if (!mesh.colors.empty() && mesh.colors.size() != mesh.positions.size())
    throw InputError(fmt::format("mesh: expected {} vertex colours or none, got {}", mesh.positions.size(), mesh.colors.size()));
  if (!mesh.face_materials.empty() && mesh.face_materials.size() != mesh.faces.size())
    throw InputError(fmt::format("mesh: expected {} face materials or none, got {}", mesh.faces.size(), mesh.face_materials.size()));
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (const WedgeId wedge : mesh.faces[f])
      if (wedge.index >= mesh.wedges.size() || mesh.wedges[wedge.index].vertex.index >= mesh.positions.size())
        throw InputError(fmt::format("mesh: face {} names a wedge or vertex that does not exist", f));
}

Vec4f color_of(const Mesh& mesh, VertexId vertex) { return mesh.colors.empty() ? Vec4f(0.5f, 0.5f, 0.5f, 1) : mesh.colors[vertex.index]; }

ClipVertex clip_vertex(const Mesh& mesh, WedgeId id, const Matrix4& clip_from_object) {
  const Wedge& wedge = mesh.wedges[id.index];
  const Vec3f& p = mesh.positions[wedge.vertex.index];
  const auto row = [&](int r) {
    const double* m = clip_from_object.m[r];
    return static_cast<float>(m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3]);
  };
  ClipVertex v;
  v.x = row(0), v.y = row(1), v.z = row(2), v.w = row(3);
  v.uv = wedge.uv;
  v.color = color_of(mesh, wedge.vertex);
  v.order = wedge.vertex.index;
  return v;
}

}  // namespace

std::int32_t snap(double x_texel, const RasterState& state) {
  if (state.subtexel_bits < 1 || state.subtexel_bits > 16)
    throw InputError(fmt::format("sub-texel bits: expected 1 to 16, got {}", state.subtexel_bits));
  const double scaled = x_texel * static_cast<double>(1 << state.subtexel_bits);  // exact: a power of two
  if (!(std::abs(scaled) <= 0x1p30)) throw InputError(fmt::format("position: expected at most 2^30 sub-texels, got {}", scaled));
  return static_cast<std::int32_t>(rounded(scaled, state.snap));
}

DrawList make_scene(const Mesh& mesh, const std::vector<Material>& materials, const Camera& camera, const Frame& frame) {
  const DefaultFloatEnvironment environment;
  validate(frame);
  check_mesh(mesh);
  const Matrix4 matrix = clip_from_object(camera, frame.width, frame.height);
  DrawList list;
  ListBuilder builder(materials, list);
  std::vector<ClipVertex> clip(mesh.wedges.size());
  for (std::size_t w = 0; w < clip.size(); ++w) clip[w] = clip_vertex(mesh, WedgeId(w), matrix);
  ClipPlacer placer(clip, frame, list);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto& face = mesh.faces[f];
    builder.begin_face(mesh.face_materials.empty() ? 0 : mesh.face_materials[f]);
    placer.add({face[0].index, face[1].index, face[2].index});
    builder.end_face(static_cast<std::uint32_t>(f));
  }
  std::erase_if(list.draws, [](const Draw& draw) { return draw.triangle_count == 0; });
  return list;
}

DrawList make_uv_scene(const Mesh& mesh, const std::vector<Material>& materials, const Frame& frame) {
  const DefaultFloatEnvironment environment;
  validate(frame);
  check_mesh(mesh);
  DrawList list;
  ListBuilder builder(materials, list);
  for (const Wedge& wedge : mesh.wedges) {
    RasterVertex v;
    v.x = snap(double{wedge.uv.x} * frame.width, frame.state);
    v.y = snap(double{wedge.uv.y} * frame.height, frame.state);
    v.uv = wedge.uv;
    v.color = color_of(mesh, wedge.vertex);
    list.vertices.push_back(v);
  }
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    builder.begin_face(mesh.face_materials.empty() ? 0 : mesh.face_materials[f]);
    const auto& face = mesh.faces[f];
    list.triangles.push_back({face[0].index, face[1].index, face[2].index});
    builder.end_face(static_cast<std::uint32_t>(f));
  }
  return list;
}

}  // namespace etalon
