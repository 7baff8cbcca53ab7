// The kernels that set up several triangles at once against their one-triangle forms.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "core/base/rng.h"
#include "core/draw/draw_list.h"
#include "raster/fast/planes.h"
#include "raster/fast/tile_edges.h"
#include "raster/fast/visible_triangles.h"
#include "raster/simd_level.h"

using namespace etalon;
using namespace etalon::raster;
using namespace etalon::raster::fast;

namespace {

struct Case {
  DrawList list;
  Frame frame;
};

// Triangles of all sizes around the tile's middle; w alike, close or far apart; attributes constant, small, large.
Case random_case(int subtexel_bits, std::uint64_t seed) {
  Case c{{}, {.width = 64, .height = 64, .guard = 0, .state = {}, .targets = {{}}}};
  c.frame.state.subtexel_bits = subtexel_bits;
  Rng rng(seed);
  for (std::uint32_t t = 0; t < 400; ++t) {
    const std::int64_t reach = std::int64_t{1} << rng.between(1, subtexel_bits + 9);
    const bool affine = rng.below(3) == 0, constant = rng.below(5) == 0;
    const float spread = std::array{0.01f, 1000.0f, 1e6f}[rng.below(3)];
    for (int k = 0; k < 3; ++k) {
      RasterVertex v;
      const auto middle = std::int64_t{32} << subtexel_bits;
      v.x = static_cast<std::int32_t>(middle + rng.between(-reach, reach)),
      v.y = static_cast<std::int32_t>(middle + rng.between(-reach, reach));
      v.w = affine ? 1.0f : 1.0f + spread * rng.uniform(0, 1);
      v.uv = constant ? Vec2f{0.25f, -3} : Vec2f{rng.uniform(-1, 1) * 1e-42f, rng.uniform(-2000, 2000)};
      v.color = {rng.uniform(0, 1), rng.uniform(-1, 1), rng.uniform(0, 1e30f), constant ? 1.0f : rng.uniform(0, 1)};
      c.list.vertices.push_back(v);
    }
    c.list.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  if (subtexel_bits >= 8) {  // consecutive Fibonacci numbers: twice the area is 1; with these w no plane is worth anything
    const std::int32_t middle = 32 << subtexel_bits;
    const std::int32_t x[3] = {0, 514229, 317811}, y[3] = {0, 317811, 196418};
    for (int k = 0; k < 3; ++k) {
      RasterVertex v = c.list.vertices[static_cast<std::size_t>(k)];
      v.x = middle - 257114 + x[k], v.y = middle - 158905 + y[k], v.w = k == 0 ? 1 : 0x1p20f;
      c.list.vertices.push_back(v);
    }
    c.list.triangles.push_back({1200, 1201, 1202});
  }
  c.list.draws = {{.triangle_count = static_cast<std::uint32_t>(c.list.triangles.size())}};
  return c;
}

PlaneLayout full_layout() {
  PlaneLayout layout;
  layout.add_edges();
  for (int a = 0; a < kPlaneAttributes; ++a) layout.add(static_cast<PlaneAttribute>(a));
  return layout;
}

}  // namespace

TEST_CASE("planes: several at once agree with one at a time within both bounds, at every level") {
  const Tile tile = {0, 0, 64, 64};
  const PlaneLayout layout = full_layout();
  const auto stride = static_cast<std::size_t>(layout.stride());
  std::size_t planes_compared = 0, useless = 0;
  for (const SimdLevel level : available_simd_levels())
    for (const int bits : {1, 4, 8, kMostEdgeBits}) {
      const Case c = random_case(bits, static_cast<std::uint64_t>(bits));
      VisibleTriangles visible;
      visible.id = {kNoTriangle};
      for (std::uint32_t t = 0; t < c.list.triangles.size(); ++t) {
        TileEdges edges;
        const auto& corner = c.list.triangles[t];
        if (edges.set(c.list.vertices[corner[0]], c.list.vertices[corner[1]], c.list.vertices[corner[2]], c.frame.state, tile))
          visible.id.push_back(t);
      }
      visible.make_planes(c.list, c.frame, tile, layout, *kernels_for(level));
      bool perspective = false;
      auto one = std::make_unique<double[]>(stride);
      for (std::size_t n = 1; n < visible.id.size(); ++n) {
        perspective |= make_planes(c.list, visible.id[n], c.frame, tile, layout, one.get());
        const double* const many = visible.planes.get() + n * stride;
        CHECK(many[kAnchorColumn] == one[kAnchorColumn]);
        CHECK(many[kAnchorRow] == one[kAnchorRow]);
        for (int i = layout.edges(); i < layout.edges() + 3 * kEdgeNumbers; ++i) CHECK(many[i] == one[static_cast<std::size_t>(i)]);
        for (int a = 0; a < kPlaneAttributes; ++a) {
          const auto attribute = static_cast<PlaneAttribute>(a);
          const double error = one[static_cast<std::size_t>(layout.error(attribute))], other = many[layout.error(attribute)];
          REQUIRE(std::isinf(error) == std::isinf(other));
          ++planes_compared;
          if (std::isinf(error)) {
            ++useless;
            continue;
          }
          CHECK(std::abs(error - other) <= 0x1p-45 * error);  // the same formula, some roundings apart
          const auto at = [&](const double* p, double x, double y) {
            const double* const plane = p + layout.offset(attribute);
            const double q = p[kQ] + p[kQ + 1] * x + p[kQ + 2] * y;
            return plane[kPlaneBase] + (plane[kPlaneAnchor] + plane[kPlaneX] * x + plane[kPlaneY] * y) / q;
          };
          // At the anchor, if it is inside: bounds hold there.
          bool inside = true;
          for (int k = 0; k < 3; ++k) inside &= many[layout.edges() + k * kEdgeNumbers + kEdgeAnchor] >= 0;
          if (inside) CHECK(std::abs(at(many, 0, 0) - at(one.get(), 0, 0)) <= error + other);
        }
      }
      CHECK(visible.perspective == perspective);
    }
  CHECK(planes_compared > 10'000);
  CHECK(useless > 0);
  CHECK(useless < planes_compared / 2);
}
