// What the readers of meshes promise about a model that they give.
#pragma once

#include <cmath>

#include "core/io/mesh_file.h"
#include "core/mesh/mesh_validation.h"
#include "tests/fuzz/fuzz_target.h"

namespace etalon::test {

inline bool is_finite(const Vec3f& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

inline void require_valid(const io::LoadedModel& model) {
  const Mesh& mesh = model.mesh;
  require(!mesh.faces.empty(), "a face");
  require(mesh.colors.empty() || mesh.colors.size() == mesh.positions.size(), "a colour for each vertex");
  require(mesh.face_materials.empty() || mesh.face_materials.size() == mesh.faces.size(), "a material for each face");
  for (const Vec3f& p : mesh.positions) require(is_finite(p), "finite positions");
  for (const Vec4f& c : mesh.colors) require(is_finite({c.x, c.y, c.z}) && std::isfinite(c.w), "finite colours");
  for (const Wedge& w : mesh.wedges) {
    require(w.vertex.index < mesh.positions.size(), "wedges of vertices that are there");
    require(std::isfinite(w.uv.x) && std::isfinite(w.uv.y), "finite texture coordinates");
  }
  for (const auto& face : mesh.faces)
    for (const WedgeId w : face) require(w.index < mesh.wedges.size(), "faces of wedges that are there");
  for (const std::uint32_t m : mesh.face_materials)
    require(m < std::max<std::size_t>(model.materials.size(), 1), "materials that are there");
  (void)validate_mesh(mesh, {.overlap_grid = 64});
}

}  // namespace etalon::test
