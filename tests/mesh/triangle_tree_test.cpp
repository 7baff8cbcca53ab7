#include "core/mesh/triangle_tree.h"

#include <doctest/doctest.h>

#include <bit>

#include "core/base/error.h"
#include "core/base/rng.h"
#include "tests/simplify/sample_meshes.h"

using namespace etalon;
using namespace etalon::test;

namespace {

SurfacePoint ask_every_face(const Mesh& mesh, const Vec3d& p) {
  SurfacePoint best;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    const FaceId id(f);
    const NearestOnTriangle found =
        nearest_on_triangle(p, to_double(mesh.position(id, 0)), to_double(mesh.position(id, 1)), to_double(mesh.position(id, 2)));
    if (found.distance2 < best.distance2) best = {id, found.weights, found.point, found.distance2};
  }
  return best;
}

bool same(const SurfacePoint& a, const SurfacePoint& b) {
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
  return a.face == b.face && bits(a.distance2) == bits(b.distance2) && a.point == b.point && a.weights == b.weights;
}

Vec3d random_point(Rng& rng, double reach) {
  Vec3d p;
  for (int k = 0; k < 3; ++k) p[k] = reach * (2 * rng.unit() - 1);
  return p;
}

}  // namespace

TEST_CASE("the tree's answer is every face's, to the last bit: near, far, on the surface, with any hint") {
  Rng rng(5);
  for (const NamedMesh& sample : sample_meshes()) {
    CAPTURE(sample.name);
    const TriangleTree tree(sample.mesh);
    for (int i = 0; i < 300; ++i) {
      Vec3d p = random_point(rng, i % 3 == 0 ? 1.5 : i % 3 == 1 ? 100 : 0);
      if (i % 3 == 2) p = to_double(sample.mesh.positions[rng.below(sample.mesh.vertex_count())]);  // ties of all its faces
      const FaceId hint = rng.coin() ? FaceId(static_cast<std::uint32_t>(rng.below(sample.mesh.face_count()))) : FaceId();
      CAPTURE(i);
      REQUIRE(same(tree.nearest(p, hint), ask_every_face(sample.mesh, p)));
    }
  }
}

TEST_CASE("many at once: the same bits as one by one, whatever the points have in common") {
  Rng rng(7);
  for (const NamedMesh& sample : sample_meshes()) {
    CAPTURE(sample.name);
    const TriangleTree tree(sample.mesh);
    for (const int kind : {0, 1, 2, 3, 4}) {
      CAPTURE(kind);
      std::vector<Vec3d> points;
      const Vec3d centre = random_point(rng, 2);
      for (int i = 0; i < 500; ++i) {
        if (kind == 0) points.push_back(random_point(rng, 1.5));
        if (kind == 1) points.push_back(centre + random_point(rng, 0x1p-12));
        if (kind == 2) points.push_back(centre);
        if (kind == 3) points.push_back(to_double(sample.mesh.positions[rng.below(sample.mesh.vertex_count())]));
        if (kind == 4) points.push_back(random_point(rng, i % 2 == 0 ? 1 : 0x1p50));
      }
      points.resize(points.size() - rng.below(30));
      std::vector<SurfacePoint> found(points.size());
      tree.nearest(points, found);
      for (std::size_t i = 0; i < points.size(); ++i) REQUIRE(same(found[i], ask_every_face(sample.mesh, points[i])));
    }
  }
  const TriangleTree tree(square());
  tree.nearest(std::span<const Vec3d>(), std::span<SurfacePoint>());
  std::vector<SurfacePoint> two(2);
  const std::vector<Vec3d> one(1);
  CHECK_THROWS_AS(tree.nearest(one, two), InternalError);
}

TEST_CASE("far from the origin, tiny and huge units: still the same bits") {
  Rng rng(6);
  const Mesh base = bumpy_sphere(5, 0.3f, 1);
  for (const auto& [scale, offset] : {std::pair(1.0f, 1e5f), {0x1p-90f, 0.0f}, {0x1p+90f, 0.0f}, {0x1p-20f, 1.0f}}) {
    Mesh mesh = base;
    for (Vec3f& p : mesh.positions) p = p * scale + Vec3f(offset);
    const TriangleTree tree(mesh);
    std::vector<Vec3d> points;
    for (int i = 0; i < 200; ++i) {
      const Vec3d p = random_point(rng, i % 2 == 0 ? 1.2 : 5) * static_cast<double>(scale) + Vec3d(offset);
      REQUIRE(same(tree.nearest(p), ask_every_face(mesh, p)));
      points.push_back(p);
    }
    std::vector<SurfacePoint> found(points.size());
    tree.nearest(points, found);
    for (std::size_t i = 0; i < points.size(); ++i) REQUIRE(same(found[i], ask_every_face(mesh, points[i])));
  }
}

TEST_CASE("faces in one place, of no area, and a single one") {
  Mesh pile = square();
  for (int i = 0; i < 20; ++i) pile.faces.push_back(pile.faces[static_cast<std::size_t>(i % 2)]);
  pile.faces.push_back({WedgeId(1u), WedgeId(1u), WedgeId(1u)});
  const TriangleTree tree(pile);
  CHECK(tree.nearest({0.5, 0.25, 3}).face == FaceId(0u));
  CHECK(tree.nearest({0.25, 0.5, 3}).face == FaceId(1u));
  CHECK(tree.nearest({0.5, 0.25, 3}, FaceId(20u)).face == FaceId(0u));
  Mesh one = square();
  one.faces.resize(1);
  CHECK(TriangleTree(one).nearest({0.5, 0.25, 3}).distance2 == 9);
}

TEST_CASE("bad surfaces are refused with their place") {
  Mesh none = square();
  none.faces.clear();
  CHECK_THROWS_WITH_AS(TriangleTree{none}, "surface: expected at least one face, got none", InputError);
  Mesh range = square();
  range.faces[1][2] = WedgeId(8u);
  CHECK_THROWS_WITH_AS(TriangleTree{range}, "surface: face 1 names a vertex that is not there", InputError);
  Mesh infinite = square();
  infinite.positions[2].z = std::numeric_limits<float>::infinity();
  CHECK_THROWS_WITH_AS(TriangleTree{infinite}, "surface: vertex 2: expected a finite position", InputError);
  const TriangleTree tree(square());
  CHECK_THROWS_AS((void)tree.nearest({0, 0, 0}, FaceId(2u)), InternalError);
}
