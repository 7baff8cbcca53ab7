#include "core/adapt/rebake.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/adapt/map_format.h"
#include "core/adapt/resolve_texture.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/mesh/weld.h"
#include "core/procedural/swirl.h"
#include "raster/cpu_renderer.h"

using namespace etalon;
using namespace etalon::adapt;

namespace {

// Two triangles over the middle half of the texture, lying in space as they do there, twice as large.
Mesh square() {
  Mesh mesh;
  mesh.has_uv = true;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const Vec2f uv[] = {{0.25f, 0.25f}, {0.75f, 0.25f}, {0.75f, 0.75f}, {0.25f, 0.75f}};
  for (std::uint32_t v = 0; v < 4; ++v) mesh.wedges.push_back({VertexId(v), uv[v]});
  mesh.faces = {{WedgeId(0u), WedgeId(1u), WedgeId(2u)}, {WedgeId(0u), WedgeId(2u), WedgeId(3u)}};
  return mesh;
}

Vec3d place(const Mesh& mesh, const TexelFaces& texels, int x, int y) {
  const std::size_t n = static_cast<std::size_t>(y * texels.width + x);
  const FaceId face(texels.faces[n]);
  Vec3d p(0, 0, 0);
  const double w[] = {texels.weights[n].x, texels.weights[n].y, texels.weights[n].z};
  for (int k = 0; k < 3; ++k) p += Vec3d(mesh.position(face, k)) * w[k];
  return p;
}

double off(const Image& map, int x, int y, const Vec2d& wanted) {
  const Vec2d p = map_coordinate(map, x, y);
  return std::max(std::abs(p.x - wanted.x), std::abs(p.y - wanted.y));
}

}  // namespace

TEST_CASE("texels of faces: covered ones, the gutter in continued planes, nothing farther off") {
  raster::CpuRenderer renderer;
  const Mesh mesh = square();
  const TexelFaces texels = texel_faces(renderer, mesh, 16, 16, 2);  // the square covers texels 4..11
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      CAPTURE(x);
      CAPTURE(y);
      const std::uint32_t face = texels.faces[static_cast<std::size_t>(y * 16 + x)];
      const bool near = x >= 2 && x <= 13 && y >= 2 && y <= 13;
      CHECK((face != kNoTriangle) == near);
      if (!near) continue;
      // Both faces lie in one plane, which the gutter continues: a texel's place is twice its coordinate, less a half.
      const Vec3d p = place(mesh, texels, x, y);
      CHECK(p.x == doctest::Approx((x + 0.5) / 8 - 0.5).epsilon(1e-12));
      CHECK(p.y == doctest::Approx((y + 0.5) / 8 - 0.5).epsilon(1e-12));
    }
  CHECK(texels.faces[4 * 16 + 11] == 0);  // right of the diagonal
  CHECK(texels.faces[11 * 16 + 4] == 1);
  const TexelFaces bare = texel_faces(renderer, mesh, 16, 16, 0);
  CHECK(bare.faces[3 * 16 + 4] == kNoTriangle);
}

TEST_CASE("texels of faces: beside a face thinner than the way to it the nearest texel's weights are taken") {
  Mesh mesh = square();
  mesh.faces.resize(1);
  // A strip one texel high: two texels above it its plane would lead twice its height away.
  mesh.wedges[0].uv = {0.25f, 0.5f}, mesh.wedges[1].uv = {0.75f, 0.5f}, mesh.wedges[2].uv = {0.75f, 0.5625f};
  raster::CpuRenderer renderer;
  const TexelFaces texels = texel_faces(renderer, mesh, 16, 16, 2);
  REQUIRE(texels.faces[8 * 16 + 11] == 0);
  CHECK(texels.faces[10 * 16 + 11] == 0);
  CHECK(texels.weights[10 * 16 + 11] == texels.weights[8 * 16 + 11]);
  CHECK(texels.weights[9 * 16 + 11].z > texels.weights[8 * 16 + 11].z);  // one texel above: continued
}

TEST_CASE("re-bake: of the full mesh itself every texel looks at itself") {
  const procedural::Model model = procedural::make_swirl({.faces = 800, .texture_size = 128});
  const Mesh mesh = welded_by_position(model.mesh);
  raster::CpuRenderer renderer;
  const TriangleTree tree(mesh);
  const Image map = rebake_map(renderer, mesh, tree, mesh, {.width = 128, .height = 128});
  // Faces are drawn with corners on the 1/256 grid: a centre may lie up to 2^-9 texel along either axis outside of the face that covers it, its
  // point so much off the surface's edge, and the nearest point no farther than that: 2^-15 of 128 texels with room for the slope.
  int elsewhere = 0;
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x) elsewhere += off(map, x, y, {(x + 0.5) / 128, (y + 0.5) / 128}) > 0x1p-15;
  CHECK(elsewhere == 0);
  const Image again = resolve_texture(renderer, model.texture, map, Filter::nearest);
  REQUIRE(again.format() == model.texture.format());
  int largest = 0;
  const auto *a = again.channels<std::uint8_t>(0, 0), *b = model.texture.channels<std::uint8_t>(0, 0);
  for (std::size_t n = 0; n < 3 * again.texel_count(); ++n) largest = std::max(largest, std::abs(a[n] - b[n]));
  CHECK(largest <= 2);  // 2^-8 texel along either axis, between texels of 255 steps' difference at most: one step each
}

TEST_CASE("re-bake: the same bytes for 1 and 3 threads; texels of no face name themselves") {
  const Mesh mesh = square();
  Mesh coarse = mesh;
  coarse.faces.resize(1);
  raster::CpuRenderer renderer;
  const TriangleTree tree(mesh);
  set_thread_count(1);
  const Image one = rebake_map(renderer, mesh, tree, coarse, {.width = 96, .height = 64});
  set_thread_count(3);
  CHECK(one == rebake_map(renderer, mesh, tree, coarse, {.width = 96, .height = 64}));
  set_thread_count(0);
  CHECK(off(one, 0, 0, {0.5 / 96, 0.5 / 64}) < 0x1p-24);
  // One texel below the square: the nearest point is on its lower side.
  CHECK(off(one, 50, 15, {50.5 / 96, 0.25}) < 0x1p-20);
}

TEST_CASE("re-bake: what is refused") {
  raster::CpuRenderer renderer;
  const Mesh mesh = square();
  Mesh plain = mesh;
  plain.has_uv = false;
  const TriangleTree tree(mesh);
  CHECK_THROWS_WITH_AS((void)texel_faces(renderer, plain, 8, 8, 2), doctest::Contains("expected a mesh with texture coordinates"),
                       InputError);
  CHECK_THROWS_WITH_AS((void)rebake_map(renderer, plain, tree, mesh), doctest::Contains("full mesh with texture coordinates"), InputError);
  CHECK_THROWS_WITH_AS((void)rebake_map(renderer, mesh, tree, plain), doctest::Contains("texture coordinates"), InputError);
  CHECK_THROWS_WITH_AS((void)rebake_map(renderer, mesh, tree, mesh, {.width = 8, .height = 8, .gutter = 17}),
                       doctest::Contains("expected 0 to 16, got 17"), InputError);
}
