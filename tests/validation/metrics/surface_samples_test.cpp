#include "validation/metrics/surface_samples.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "core/base/error.h"
#include "tests/simplify/sample_meshes.h"

using namespace etalon;
using namespace etalon::test;
using namespace etalon::validation;

namespace {

SampleBlock all_of(const SurfaceSamples& samples) {
  SampleBlock all;
  for (std::size_t b = 0; b < samples.block_count(); ++b) {
    const SampleBlock block = samples.block(b);
    CHECK(block.points.size() == (b + 1 < samples.block_count() ? kBlockSamples : samples.count() - b * kBlockSamples));
    all.points.insert(all.points.end(), block.points.begin(), block.points.end());
    all.colors.insert(all.colors.end(), block.colors.begin(), block.colors.end());
  }
  return all;
}

}  // namespace

TEST_CASE("a square: its vertices, even steps on its edges, the rest by area") {
  // Area 1, four vertices, target 104: 100 to share, so 10 to a unit of length; 4 sides and a diagonal, 54.1 units of length.
  const SurfaceSamples samples(square(), 104);
  CHECK(samples.vertex_count() == 4);
  CHECK(samples.edge_count() == 54);
  CHECK(samples.face_count() == 46);
  CHECK(samples.count() == 104);
}

TEST_CASE("blocks together are all samples; they lie on the surface") {
  const Mesh mesh = square();
  const SurfaceSamples samples(mesh, 20'000);
  const std::vector<Vec3d> list = all_of(samples).points;
  REQUIRE(list.size() == samples.count());
  std::size_t lower = 0, inside = 0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Vec3d& p = list[i];
    REQUIRE(p.z == 0);
    REQUIRE(std::min(p.x, p.y) >= 0);
    REQUIRE(std::max(p.x, p.y) <= 1);
    if (i < samples.vertex_count() + samples.edge_count()) continue;
    ++inside;
    lower += p.y < p.x ? 1 : 0;
  }
  // Both triangles have the same area: a half each, up to the one sample that rounding may shift.
  CHECK(inside == samples.face_count());
  CHECK(lower + 1 >= inside - lower);
  CHECK(lower <= inside - lower + 1);
}

TEST_CASE("points inside a face are spread evenly: no quarter of a triangle has much more than its share") {
  Mesh one = square();
  one.faces.resize(1);
  const SurfaceSamples samples(one, 4000);
  const std::vector<Vec3d> list = all_of(samples).points;
  std::size_t corner = 0, total = 0;
  for (std::size_t i = samples.vertex_count() + samples.edge_count(); i < list.size(); ++i) {
    ++total;
    corner += list[i].x < 0.5 ? 1 : 0;  // the quarter at vertex 0 of (0,0), (1,0), (1,1)
  }
  // A sequence of n points of discrepancy O(log n / n): within 1 % of a quarter for n = 3,800.
  CHECK(total > 3500);
  CHECK(corner * 4 > total - total / 100);
  CHECK(corner * 4 < total + total / 100);
}

TEST_CASE("colours are blended as positions are") {
  Mesh mesh = square();
  for (const Vec3f& p : mesh.positions) mesh.colors.push_back({p.x, p.y, 0.25f, 1});
  const SampleBlock all = all_of(SurfaceSamples(mesh, 500));
  REQUIRE(all.colors.size() == all.points.size());
  for (std::size_t i = 0; i < all.points.size(); ++i) {
    REQUIRE(all.colors[i].x == all.points[i].x);
    REQUIRE(all.colors[i].y == all.points[i].y);
    REQUIRE(all.colors[i].z == doctest::Approx(0.25).epsilon(1e-15));
  }
  CHECK(all_of(SurfaceSamples(square(), 500)).colors.empty());
}

TEST_CASE("few samples, a surface without area, a vertex of no face") {
  CHECK(SurfaceSamples(square(), 1).count() == 4);
  const Mesh grid = bumpy_grid(80, 0.1f, 1);  // 6,561 vertices: two blocks of nothing else
  const SurfaceSamples only_vertices(grid, 100);
  CHECK(only_vertices.block_count() == 2);
  CHECK(all_of(only_vertices).points.size() == 6561);
  Mesh point = square();
  for (Vec3f& p : point.positions) p = {1, 2, 3};
  CHECK(SurfaceSamples(point, 1000).count() == 4);
  Mesh loose = square();
  loose.positions.push_back({9, 9, 9});
  CHECK(SurfaceSamples(loose, 1).count() == 4);
}

TEST_CASE("bad surfaces are refused with their place") {
  Mesh none = square();
  none.faces.clear();
  CHECK_THROWS_WITH_AS((SurfaceSamples{none, 1}), "surface: expected at least one face, got none", InputError);
  Mesh range = square();
  range.wedges[1].vertex = VertexId(8u);
  CHECK_THROWS_WITH_AS((SurfaceSamples{range, 1}), "surface: face 0 names a vertex that is not there", InputError);
  Mesh infinite = square();
  infinite.positions[2].z = std::numeric_limits<float>::quiet_NaN();
  CHECK_THROWS_WITH_AS((SurfaceSamples{infinite, 1}), "surface: vertex 2: expected a finite position", InputError);
}
