// The atlas and its invariants.
#include <doctest/doctest.h>

#include <cmath>

#include "core/bake/atlas.h"
#include "core/base/rng.h"
#include "core/procedural/knot.h"

using namespace etalon;
using namespace etalon::bake;

namespace {

// Each triangle has its own texels, all inside; in each column they reach from the top without a gap.
void check_invariants(const Atlas& atlas) {
  std::vector<int> owner(static_cast<std::size_t>(atlas.width) * static_cast<std::size_t>(atlas.height), -1);
  const auto at = [&](int x, int y) -> int& {
    return owner[static_cast<std::size_t>(y) * static_cast<std::size_t>(atlas.width) + static_cast<std::size_t>(x)];
  };
  std::uint64_t inside = 0;
  for (std::size_t f = 0; f < atlas.tiles.size(); ++f) {
    const Tile& tile = atlas.tiles[f];
    for (int j = 0; j < tile.size; ++j)
      for (int i = 0; i + j < tile.size; ++i) {
        const auto [x, y] = tile.place(i, j);
        REQUIRE((x >= 0 && y >= 0 && x < atlas.width && y < atlas.height));
        REQUIRE(at(x, y) == -1);
        at(x, y) = static_cast<int>(f);
        ++inside;
      }
  }
  REQUIRE(inside == atlas.inside_count());
  for (int x = 0; x < atlas.width; ++x)
    for (int y = 0; y + 1 < atlas.height; ++y) REQUIRE((at(x, y) == -1 || at(x, y + 1) != -1));
}

std::array<int, 2> texel_under(const Vec2d& p) { return {static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y))}; }

}  // namespace

TEST_CASE("own half-squares, inside, nothing shared, waste only at the bottom: random sizes and maps") {
  Rng rng(3);
  int done = 0;
  for (int n = 0; n < 400; ++n) {
    std::vector<double> ratios(1 + rng.below(300));
    const std::uint64_t spread = 1 + rng.below(8);
    for (double& ratio : ratios) ratio = rng.unit() * static_cast<double>(1u << rng.below(spread));
    const int width = 1 << rng.between(1, 8), height = static_cast<int>(rng.between(3, 300));
    if (least_height(ratios.size(), width) > static_cast<std::uint64_t>(height)) continue;
    check_invariants(make_atlas(ratios, width, height));
    ++done;
  }
  CHECK(done > 200);
}

TEST_CASE("of a mesh: the longest side is the hypotenuse, and the tile's corners are the face's in their order") {
  const Mesh mesh = procedural::make_knot({.rings = 60, .around = 12});
  for (const int width : {128, 256, 1024}) {
    const Atlas atlas = make_atlas(mesh, mean_edge_length(mesh) / 9, width, width);
    check_invariants(atlas);
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
      const Tile& tile = atlas.tiles[f];
      const auto length = [&](int a, int b) {
        const Vec3f d = mesh.position(FaceId(f), a) - mesh.position(FaceId(f), b);
        return d.x * d.x + d.y * d.y + d.z * d.z;
      };
      const int r = tile.right_corner, s = (r + 1) % 3, t = (r + 2) % 3;
      REQUIRE(length(s, t) >= length(r, s) * 0.999999f);
      REQUIRE(length(s, t) >= length(r, t) * 0.999999f);
      const Vec2d a = corner_place(tile, 0, 0), b = corner_place(tile, 1, 0), c = corner_place(tile, 2, 0);
      // Counter-clockwise, with half a square's area: not mirrored.
      REQUIRE((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) == static_cast<double>(tile.size) * tile.size);
    }
  }
}

TEST_CASE("texel centres: weights of the drawn corners, the texel nearest to itself, sides by step") {
  for (const bool turned : {false, true})
    for (const int right : {0, 1, 2})
      for (const int size : {2, 4, 8, 16}) {
        const Tile tile{.x = 5, .y = 7, .size = size, .turned = turned, .right_corner = right};
        const Vec2d p[3] = {corner_place(tile, 0, 0), corner_place(tile, 1, 0), corner_place(tile, 2, 0)};
        for (int j = 0; j < size; ++j)
          for (int i = 0; i + j < size; ++i) {
            const Vec3d w = tile.center_weights(i, j);
            REQUIRE((w.x >= 0 && w.y >= 0 && w.z >= 0));
            REQUIRE(w.x + w.y + w.z == 1);
            const auto [x, y] = tile.place(i, j);
            REQUIRE(w.x * p[0].x + w.y * p[1].x + w.z * p[2].x == x + 0.5);
            REQUIRE(w.x * p[0].y + w.y * p[1].y + w.z * p[2].y == y + 0.5);
            REQUIRE(tile.nearest_texel(w) == std::array{i, j});
          }
        for (int a = 0; a < 3; ++a)
          for (int b = 0; b < 3; ++b) {
            if (a == b) continue;
            REQUIRE(tile.side_texel(a, b, 0) == tile.corner_texel(a));
            REQUIRE(tile.side_texel(a, b, size - 1) == tile.corner_texel(b));
            for (int step = 0; step < size; ++step) {
              // The texel's piece of the side is [step, step + 1] / size.
              Vec3d w{0, 0, 0};
              w[a] = 1 - (step + 0.5) / size;
              w[b] = (step + 0.5) / size;
              REQUIRE(tile.nearest_texel(w) == tile.side_texel(a, b, step));
            }
          }
      }
}

TEST_CASE("points of a side and beyond it by rounding have a texel of the tile") {
  for (const int size : {2, 8, 64}) {
    const Tile tile{.size = size};
    const auto check = [&](const Vec3d& w) {
      const auto [i, j] = tile.nearest_texel(w);
      REQUIRE((i >= 0 && j >= 0 && i + j < size));
      // Nearest: no centre of its own is nearer.
      const auto distance2 = [&](int p, int q) { return std::pow(w.y * size - p - 0.5, 2) + std::pow(w.z * size - q - 0.5, 2); };
      for (int q = 0; q < size; ++q)
        for (int p = 0; p + q < size; ++p) REQUIRE(distance2(i, j) <= distance2(p, q) + 1e-12);
    };
    for (int k = 0; k <= 4 * size; ++k) {
      const double t = k / (4.0 * size);
      check({0, t, 1 - t});
      check({1 - t, t, 0});
      check({1 - t, 0, t});
      check({0, std::nextafter(t, 2), std::nextafter(1 - t, 2)});
    }
  }
}

TEST_CASE("drawn-in corners: every point of the float32 triangle is in a texel of its own, as far as 5 units of 2^-24 around it") {
  Rng rng(4);
  for (const int width : {4, 64, 512, 4096, 16384})
    for (const int least : {2, 8}) {
      if (least >= width) continue;
      for (const bool turned : {false, true})
        for (int size = least; size < width; size *= 4) {
          Atlas atlas{.width = width, .height = width, .tiles = {{.size = least}}};
          const Tile tile{.x = width - size, .y = width - size - 1, .size = size, .turned = turned};
          const double share = drawn_in_share(atlas);
          Vec2d uv[3];
          for (int c = 0; c < 3; ++c) {
            const Vec2d p = corner_place(tile, c, share);
            uv[c] = {static_cast<float>(p.x / width), static_cast<float>(p.y / width)};
          }
          for (int n = 0; n < 400; ++n) {
            double s = rng.unit(), t = rng.unit();
            if (s + t > 1) s = 1 - s, t = 1 - t;
            // Half of the points on a side.
            if (rng.coin())
              (rng.coin() ? s : t) = 0;
            else if (rng.coin())
              t = 1 - s;
            const double error = 5 * 0x1p-24;
            for (const double ex : {-error, error})
              for (const double ey : {-error, error}) {
                const Vec2d p{(uv[0].x + s * (uv[1].x - uv[0].x) + t * (uv[2].x - uv[0].x) + ex) * width,
                              (uv[0].y + s * (uv[1].y - uv[0].y) + t * (uv[2].y - uv[0].y) + ey) * width};
                const auto [x, y] = texel_under(p);
                const int i = turned ? tile.x + size - 1 - x : x - tile.x, j = turned ? tile.y + size - y : y - tile.y;
                REQUIRE((i >= 0 && j >= 0 && i + j < size));
              }
          }
        }
    }
}

TEST_CASE("the paper's corners do leave the tile: at the hypotenuse's integer points") {
  const Tile tile{.size = 4};
  const auto [x, y] = texel_under(Vec2d{3, 1});
  CHECK(x + y == tile.size);
  CHECK(corner_place(tile, 1, 0) == Vec2d{4, 0});
}
