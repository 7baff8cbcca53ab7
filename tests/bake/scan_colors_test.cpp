// Colours of the scan's surface in texels.
#include <doctest/doctest.h>

#include <cmath>

#include "core/bake/scan_colors.h"
#include "core/base/parallel.h"
#include "tests/bake/fill_fixture.h"

using namespace etalon;
using namespace etalon::bake;
using namespace etalon::test;

namespace {

constexpr int kCells = 8;

// A square of kCells² quads at z = 0, each vertex coloured by a function of its place.
template <class Color>
Mesh flat_scan(const Color& color) {
  std::vector<Vec3f> positions;
  std::vector<std::array<std::uint32_t, 3>> faces;
  for (int y = 0; y <= kCells; ++y)
    for (int x = 0; x <= kCells; ++x) positions.push_back({static_cast<float>(x), static_cast<float>(y), 0});
  for (std::uint32_t y = 0; y < kCells; ++y)
    for (std::uint32_t x = 0; x < kCells; ++x) {
      const std::uint32_t a = y * (kCells + 1) + x, b = a + kCells + 1;
      faces.push_back({a, a + 1, b}), faces.push_back({a + 1, b + 1, b});
    }
  Mesh scan = mesh_of(positions, faces);
  for (const Vec3f& p : positions) scan.colors.push_back(color(p.x, p.y));
  return scan;
}

// One triangle over the lower left half of that square, its right angle at its corner 0.
struct Target {
  Mesh mesh;
  Atlas atlas = make_atlas({16}, 32, 32);
  TexelNodes nodes;
  explicit Target(float height)
      : mesh(mesh_of({{0, 0, height}, {kCells, 0, height}, {0, kCells, height}}, {{0, 1, 2}})), nodes(mesh, atlas) {}
  [[nodiscard]] ScanColors sample(const Mesh& scan) const { return sample_scan(scan, TriangleTree(scan), mesh, atlas, nodes); }
};

}  // namespace

TEST_CASE("on a flat scan each texel has the mean of the linear colours at its places, exactly") {
  // Sixteenths, float32 exactly; x and y in units of the square's side.
  const auto linear = [](double x, double y) { return std::array<double, 3>{x, (1 + y) / 4, (x + y) / 2}; };
  const Mesh scan = flat_scan([&](float x, float y) {
    const auto c = linear(x / kCells, y / kCells);
    return Vec4f(static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2]), 1);
  });
  const Target target(0);
  const int size = target.atlas.tiles[0].size;
  REQUIRE(size == 16);
  const ScanColors sampled = target.sample(scan);
  CHECK(sampled.distance_max < 0x1p-40);
  std::uint32_t t = 0;
  std::size_t checked = 0;
  for_each_texel(size, [&](int i, int j) {
    std::array<int, 3> sums{};
    int places = 0;
    bool clear = true;
    for (const auto& [x, y] : {std::pair(0, 0), {-2, -2}, {2, -2}, {-2, 2}, {2, 2}}) {
      const int right = 6 * i + 3 + x, up = 6 * j + 3 + y;
      if (right + up > 6 * size) continue;
      ++places;
      const auto color = linear(right / (6.0 * size), up / (6.0 * size));
      for (std::size_t c = 0; c < 3; ++c) {
        const double level = 255 * color[c] + 0.5;
        // Weights and sums are off by a few times 2^-53; no level but one on a half is so near to the next byte, since levels are whole
        // multiples of 1/(24 · size).
        clear = clear && std::abs(level - std::round(level)) > 0x1p-30;
        sums[c] += static_cast<int>(level);
      }
    }
    CHECK(places == (i + j + 1 < size ? 5 : 4));
    if (clear) {
      ++checked;
      for (std::size_t c = 0; c < 3; ++c) REQUIRE(sampled.color[t][c] == (2 * sums[c] + places) / (2 * places));
    }
    ++t;
  });
  CHECK(checked > 100);
}

TEST_CASE("where the triangle is away from the scan, its places are as far apart as that") {
  const Mesh scan = flat_scan([](float x, float) { return x < 4 ? Vec4f(0, 0, 0, 1) : Vec4f(1, 1, 1, 1); });
  // Black up to x = 3, white from 4 on. Texel (4, 2), half a unit wide, is centred at x = 2.25.
  const Target near(0), above(2);
  const std::uint32_t texel = near.nodes.texel(0, 16, 4, 2);
  CHECK(near.sample(scan).color[texel] == Rgb8{0, 0, 0});
  // Two of five at 2.25 + 1/6 + 4/3 = 3.75: three quarters of the way to white, 191.25; two fifths of 191.
  CHECK(above.sample(scan).color[texel] == Rgb8{76, 76, 76});
  CHECK(above.sample(scan).distance_max == doctest::Approx(2).epsilon(1e-12));
}

TEST_CASE("one colour a node, of all its places; colours beyond [0, 1] are clamped; the same for every thread count") {
  const FillCase c(relief(3, 7), std::vector<double>(18, 8), 3, 4);
  Mesh scan = relief(9, 5);
  for (std::size_t v = 0; v < scan.positions.size(); ++v) {
    scan.positions[v].x /= 3, scan.positions[v].y /= 3;
    scan.colors.emplace_back(static_cast<float>(v % 7) / 6, 2.0f, -1.0f, 1);
  }
  const ScanColors first = sample_scan(scan, TriangleTree(scan), c.mesh, c.atlas, c.nodes);
  CHECK(first.distance_max > 0);
  bool different = false;
  for (std::uint32_t t = 0; t < c.nodes.texel_count(); ++t) {
    REQUIRE(first.color[t] == first.color[c.nodes.node_of(t)]);
    REQUIRE(first.color[t][1] == 255);
    REQUIRE(first.color[t][2] == 0);
    different = different || first.color[t] != first.color[0];
  }
  CHECK(different);
  for (const int threads : {1, 2, 7}) {
    set_thread_count(threads);
    const ScanColors again = sample_scan(scan, TriangleTree(scan), c.mesh, c.atlas, c.nodes);
    CHECK(again.color == first.color);
    CHECK(again.distance_max == first.distance_max);
  }
  set_thread_count(0);
}
