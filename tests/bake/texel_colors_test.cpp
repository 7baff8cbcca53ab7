// Colours of vertices in texels.
#include <doctest/doctest.h>

#include <limits>

#include "core/base/error.h"
#include "tests/bake/fill_fixture.h"

using namespace etalon;
using namespace etalon::bake;
using namespace etalon::test;

TEST_CASE("a channel becomes the nearest byte; what a file stored as a byte comes back") {
  for (int i = 0; i < 256; ++i) CHECK(color_byte(static_cast<float>(i) / 255.0f) == i);
  CHECK(color_byte(-1) == 0);
  CHECK(color_byte(2) == 255);
  CHECK(color_byte(0.499f / 255) == 0);
  CHECK(color_byte(0.501f / 255) == 1);
}

TEST_CASE("several vertices in one texel: the integer mean, halves up; a kept vertex hits all its triangles, once") {
  // The third makes the class of 8 even.
  const Mesh mesh =
      mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}}, {{0, 1, 2}, {3, 2, 1}, {4, 5, 6}});
  const Atlas atlas = make_atlas({8, 4, 8}, 16, 16);
  const TexelNodes nodes(mesh, atlas);
  const auto grey = [](int r, int g, int b) { return Vec4f(r / 255.0f, g / 255.0f, b / 255.0f, 1); };
  // Vertex 1 kept: corner 1 of face 0, corner 2 of face 1. Three in texel (1, 2) of face 0: 10, 11, 11 → 32/3; two of 5 and 6 → 5.5.
  const Vec3d inside{1 - 1.4 / 8 - 2.6 / 8, 1.4 / 8, 2.6 / 8};
  const std::vector<Landing> landings{{FaceId(0u), {0, 1, 0}}, {FaceId(0u), inside}, {FaceId(0u), inside}, {FaceId(0u), inside}, {}};
  const TexelColors colors =
      average_colors(atlas, nodes, {grey(200, 100, 50), grey(10, 5, 0), grey(11, 6, 255), grey(11, 0, 254), grey(9, 9, 9)}, landings);
  const std::uint32_t t = nodes.texel(0, 8, 1, 2);
  CHECK(colors.hits[t] == 3);
  CHECK(colors.color[t] == Rgb8{11, 4, 170});  // 32/3 = 10.67, 11/3 = 3.67, 509/3 = 169.67
  CHECK(colors.without_face == 1);
  const std::uint32_t corner = nodes.texel(1, 4, 0, 3), other = nodes.texel(0, 8, 7, 0);
  CHECK(colors.hits[corner] == 1);
  CHECK(colors.color[corner] == Rgb8{200, 100, 50});
  CHECK(colors.color[other] == Rgb8{200, 100, 50});
  // On the common edge face 0 has 8 texels, face 1 has 4: the second at the corner is equated too.
  CHECK(colors.is_hit(nodes.texel(0, 8, 6, 1)));
  CHECK_FALSE(colors.is_hit(nodes.texel(0, 8, 5, 2)));
  const TexelColors half = average_colors(atlas, nodes, {grey(5, 0, 0), grey(6, 0, 1)}, {landings[1], landings[2]});
  CHECK(half.color[t] == Rgb8{6, 0, 1});
}

TEST_CASE("no colours: refused") {
  const Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const Atlas atlas = make_atlas({8}, 16, 16);
  CHECK_THROWS_AS((void)average_colors(atlas, TexelNodes(mesh, atlas), {}, {}), InputError);
}
