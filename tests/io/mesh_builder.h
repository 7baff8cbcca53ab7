// Meshes for the reader and writer tests, and the comparison that does not care how wedges are numbered.
#pragma once

#include <doctest/doctest.h>

#include <cstdint>
#include <string>

#include "core/io/mesh_file.h"
#include "tests/io/image_builder.h"

namespace etalon::test {

/// Positions, colours, faces, materials and the uv of every corner are equal; wedges may be numbered differently.
inline void check_same_surface(const Mesh& a, const Mesh& b) {
  CHECK(a.positions == b.positions);
  CHECK(a.colors == b.colors);
  CHECK(a.face_materials == b.face_materials);
  CHECK(a.has_uv == b.has_uv);
  REQUIRE(a.face_count() == b.face_count());
  std::size_t different_corners = 0;
  for (std::uint32_t f = 0; f < a.face_count(); ++f)
    for (int k = 0; k < 3; ++k) {
      const Wedge& x = a.wedge(FaceId(f), k);
      const Wedge& y = b.wedge(FaceId(f), k);
      different_corners += x.vertex != y.vertex || (a.has_uv && x.uv != y.uv);
    }
  CHECK(different_corners == 0);
}

enum class Colors { none, bytes, reals };

/// Four vertices, two triangles that share an edge which is a seam (two uvs at each of its ends), one unused vertex. `seed` gives positions
/// with all 24 bits of a float; uvs are multiples of 2^-24 in [1/2, 1], so that 1 − (1 − v) = v.
inline Mesh seam_mesh(bool has_uv, Colors colors, bool alpha, std::uint64_t seed) {
  Rng rng(seed);
  Mesh mesh;
  mesh.has_uv = has_uv;
  for (int v = 0; v < 5; ++v) {
    mesh.positions.push_back({rng.uniform(-10, 10), rng.uniform(-1, 1) * 1e-12f, rng.uniform(0, 1) * 1e15f});
    if (colors == Colors::none) continue;
    Vec4f c;
    for (int k = 0; k < 4; ++k) c[k] = colors == Colors::bytes ? static_cast<float>(rng.below(256)) / 255.0f : rng.uniform(0, 1);
    if (!alpha) c.w = 1;
    mesh.colors.push_back(c);
  }
  if (!has_uv) {
    for (std::uint32_t v = 0; v < 5; ++v) mesh.wedges.push_back({VertexId(v), {0, 0}});
    mesh.faces = {{WedgeId(0u), WedgeId(1u), WedgeId(2u)}, {WedgeId(2u), WedgeId(1u), WedgeId(3u)}};
  } else {
    for (const std::uint32_t v : {0u, 1u, 2u, 2u, 1u, 3u})
      mesh.wedges.push_back({VertexId(v), {rng.uniform(-3, 3), 0.5f + static_cast<float>(rng.below(1 << 23)) * 0x1p-24f}});
    mesh.faces = {{WedgeId(0u), WedgeId(1u), WedgeId(2u)}, {WedgeId(3u), WedgeId(4u), WedgeId(5u)}};
  }
  return mesh;
}

/// Two materials with textures and one without, one face each.
inline io::LoadedModel textured_model() {
  io::LoadedModel model;
  model.mesh = seam_mesh(true, Colors::none, false, 3);
  model.mesh.faces.push_back(model.mesh.faces[0]);
  model.mesh.face_materials = {0, 1, 2};
  model.materials = {{"skin of the cow", {}, random_image(4, 3, kRgba8, 1)}, {"horn", {}, random_image(2, 2, kRgb8, 2)}, {"plain", {}, {}}};
  return model;
}

}  // namespace etalon::test
