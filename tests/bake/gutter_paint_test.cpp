// The colours of borders: what linear lookups give, in the written map and its box-filtered levels.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "core/bake/bake.h"
#include "core/io/image_file.h"
#include "core/mesh/adjacency.h"
#include "core/procedural/knot.h"

using namespace etalon;
using namespace etalon::bake;

namespace {

// A level of the map: sums of 4^level bytes, so exact.
struct Level {
  int width = 0, height = 0, level = 0;
  std::vector<Vec3d> sums;
  [[nodiscard]] const Vec3d& at(int x, int y) const {
    return sums[static_cast<std::size_t>(std::clamp(y, 0, height - 1)) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(std::clamp(x, 0, width - 1))];
  }
  // Bilinear, in bytes; u, v from 0 to 1.
  [[nodiscard]] Vec3d look_up(double u, double v) const {
    const double s = u * width - 0.5, t = v * height - 0.5;
    const int x = static_cast<int>(std::floor(s)), y = static_cast<int>(std::floor(t));
    const double fx = s - x, fy = t - y;
    const Vec3d value = (1 - fy) * ((1 - fx) * at(x, y) + fx * at(x + 1, y)) + fy * ((1 - fx) * at(x, y + 1) + fx * at(x + 1, y + 1));
    return std::ldexp(1.0, -2 * level) * value;
  }
};

Level level_of(const Image& image, int level) {
  Level result{image.width() >> level, image.height() >> level, level, {}};
  result.sums.resize(static_cast<std::size_t>(result.width) * static_cast<std::size_t>(result.height));
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const std::uint8_t* const c = image.channels<std::uint8_t>(x, y);
      Vec3d& sum =
          result.sums[static_cast<std::size_t>(y >> level) * static_cast<std::size_t>(result.width) + static_cast<std::size_t>(x >> level)];
      sum = sum + Vec3d{static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])};
    }
  return result;
}

double largest(const Vec3d& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

Mesh smooth_knot() {
  Mesh mesh = procedural::make_knot({.rings = 100, .around = 24});
  const auto box = bounding_box(mesh);
  for (std::size_t v = 0; v < mesh.colors.size(); ++v) {
    const Vec3f p = mesh.positions[v];
    // Far from 0 and 255, so that no a + b − c is cut.
    mesh.colors[v] = {0.25f + 0.5f * (p.x - box.lo.x) / (box.hi.x - box.lo.x), 0.25f + 0.5f * (p.y - box.lo.y) / (box.hi.y - box.lo.y),
                      0.25f + 0.5f * (p.z - box.lo.z) / (box.hi.z - box.lo.z), 1};
  }
  return mesh;
}

Vec2d uv_of(const Mesh& mesh, std::uint32_t f, const Vec3d& weights) {
  Vec2d p{0, 0};
  for (int c = 0; c < 3; ++c) {
    const Vec2f& uv = mesh.wedge(FaceId(f), c).uv;
    p = {p.x + weights[c] * uv.x, p.y + weights[c] * uv.y};
  }
  return p;
}

}  // namespace

TEST_CASE("gutter: where each triangle has a colour of its own, every lookup in levels 0 to N gives it, whatever lies between is") {
  for (const int gutter : {0, 1, 2, 4}) {
    BakeResult result = bake_scan(smooth_knot(), {.target_faces = 150, .width = 512, .height = 768, .gutter = gutter});
    const Atlas& atlas = result.atlas;
    const auto color_of = [](std::uint32_t f, int c) {
      return static_cast<std::uint8_t>(37 + 71 * (c + 1) * static_cast<int>(f % 251) % 199);
    };
    Image image(atlas.width, atlas.height, kRgb8);
    for (std::size_t n = 0; n < image.bytes().size(); ++n) image.bytes()[n] = std::byte{255};
    for (std::uint32_t f = 0; f < atlas.tiles.size(); ++f)
      for (int j = 0; j < atlas.tiles[f].size; ++j)
        for (int i = 0; i + j < atlas.tiles[f].size; ++i) {
          const auto [x, y] = atlas.tiles[f].place(i, j);
          for (int c = 0; c < 3; ++c) image.channels<std::uint8_t>(x, y)[c] = color_of(f, c);
        }
    paint_borders(atlas, image);
    for (int level = 0; level <= gutter; ++level) {
      const Level mip = level_of(image, level);
      for (std::uint32_t f = 0; f < atlas.tiles.size(); ++f)
        for (int a = 0; a <= 12; ++a)
          for (int b = 0; a + b <= 12; ++b) {
            const Vec2d p = uv_of(result.mesh, f, {a / 12.0, b / 12.0, (12 - a - b) / 12.0});
            const Vec3d seen = mip.look_up(p.x, p.y);
            for (int c = 0; c < 3; ++c) REQUIRE(std::abs(seen[c] - color_of(f, c)) < 1e-9);
          }
    }
  }
}

TEST_CASE("gutter: along an edge between triangles of one size, linear lookup at level 0 gives both the same") {
  for (const Corners corners : {Corners::exact, Corners::inset}) {
    const BakeResult result = bake_scan(smooth_knot(), {.target_faces = 300, .width = 512, .height = 512, .corners = corners, .gutter = 0});
    const std::string png = io::encode_png(result.texture, "texture");
    const Level map = level_of(io::decode_image(std::as_bytes(std::span(png)), "texture"), 0);
    const Adjacency adjacency(result.mesh);
    int edges = 0;
    double worst = 0;
    for (std::uint32_t e = 0; e < adjacency.edge_count(); ++e) {
      const auto sides = adjacency.half_edges(EdgeId(e));
      if (sides.size() != 2) continue;
      const auto size_at = [&](HalfEdgeId h) { return result.atlas.tiles[Adjacency::face(h).index].size; };
      if (size_at(sides[0]) != size_at(sides[1])) continue;
      ++edges;
      for (int n = 0; n <= 96; ++n) {
        Vec3d seen[2];
        for (int k = 0; k < 2; ++k) {
          const HalfEdgeId h = sides[static_cast<std::size_t>(k)];
          const int a = Adjacency::corner(h), b = (a + 1) % 3;
          const double t = n / 96.0, along = adjacency.start(h) < adjacency.end(h) ? t : 1 - t;
          Vec3d weights{0, 0, 0};
          weights[a] = 1 - along, weights[b] = along;
          const Vec2d p = uv_of(result.mesh, Adjacency::face(h).index, weights);
          seen[k] = map.look_up(p.x, p.y);
        }
        worst = std::max(worst, largest(seen[0] - seen[1]));
      }
    }
    CHECK(edges > 150);
    // Exactly the same on the paper's corners, but for this sum's own rounding. Drawn in, the lookup moves by up to 2.5·size/8192 texels,
    // 0.02 of one here, between texels that differ by 255 at most.
    if (corners == Corners::exact) CHECK(worst < 1e-9);
    CHECK(worst < 2 * 0.02 * 255);
  }
}

TEST_CASE("gutter: borders change nothing of the triangles, and nearest lookup is continuous as ever") {
  const Mesh scan = smooth_knot();
  const BakeResult with = bake_scan(scan, {.target_faces = 200, .width = 512, .height = 512, .gutter = 1});
  CHECK(with.seam_residual == 0);
  CHECK(with.texels.border == with.atlas.border_count());
  CHECK(with.texels.inside + with.texels.border <= with.texels.atlas);
  Image bare = with.texture;
  for (std::uint32_t f = 0; f < with.atlas.tiles.size(); ++f)
    for_each_border_texel(with.atlas.tiles[f].size, 1, [&](int i, int j) {
      const auto [x, y] = with.atlas.tiles[f].place(i, j);
      for (int c = 0; c < 3; ++c) bare.channels<std::uint8_t>(x, y)[c] = 99;
    });
  CHECK(bare != with.texture);
  paint_borders(with.atlas, bare);
  CHECK(bare == with.texture);
}
