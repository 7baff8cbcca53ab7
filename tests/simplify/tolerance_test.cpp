// The guaranteed one-sided distance: every vertex of the input within the tolerance of the result.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/simplify/simplify.h"
#include "tests/simplify/sample_meshes.h"

using namespace etalon;
using namespace etalon::simplify;
using namespace etalon::test;

namespace {

/// By asking every face for every vertex.
double distance_of(const Mesh& source, const Mesh& result) {
  double largest = 0;
  for (const Vec3f& at : source.positions) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::uint32_t f = 0; f < result.face_count(); ++f) {
      const auto corner = [&](int k) { return to_double(result.position(FaceId(f), k)); };
      nearest = std::min(nearest, nearest_on_triangle(to_double(at), corner(0), corner(1), corner(2)).distance2);
    }
    largest = std::max(largest, nearest);
  }
  return std::sqrt(largest);
}

}  // namespace

TEST_CASE("every vertex stays within the tolerance; the audit is the true distance") {
  for (const NamedMesh& sample : sample_meshes()) {
    CAPTURE(sample.name);
    for (const CollapseKind collapse : {CollapseKind::half, CollapseKind::full}) {
      for (const double tolerance : {0.001, 0.02, 0.1, 0.5}) {
        CAPTURE(tolerance);
        const SimplifyResult result = simplify_mesh(sample.mesh, {.collapse = collapse, .tolerance = tolerance});
        const double distance = distance_of(sample.mesh, result.mesh);
        REQUIRE(distance <= tolerance);
        REQUIRE(*result.distance_audited == distance);
        REQUIRE(*result.distance_max >= distance * (1 - 0x1p-40));
        REQUIRE(*result.distance_max <= tolerance);
        REQUIRE(result.stop != StopReason::faces);
        const bool refused = result.refusals[static_cast<std::size_t>(Refusal::tolerance)] > 0;
        REQUIRE((result.stop == StopReason::tolerance) == refused);
      }
    }
  }
}

TEST_CASE("a larger tolerance leaves fewer faces; none keeps what is not flat") {
  const Mesh sphere = bumpy_sphere(8, 0.2f, 3);
  std::size_t before = sphere.face_count();
  for (const double tolerance : {0.01, 0.05, 0.2}) {
    const SimplifyResult result = simplify_mesh(sphere, {.tolerance = tolerance});
    CHECK(result.stop == StopReason::tolerance);
    CHECK(result.mesh.face_count() < before);
    before = result.mesh.face_count();
  }
  CHECK(before < sphere.face_count() / 4);
  CHECK(simplify_mesh(sphere, {.tolerance = 0.0}).mesh == sphere);
  CHECK(simplify_mesh(bumpy_grid(8, 0, 1), {.tolerance = 1e-6}).mesh.face_count() == 2);
}

TEST_CASE("with a face count as well: whichever comes first") {
  const Mesh sphere = bumpy_sphere(8, 0.2f, 3);
  const SimplifyResult by_faces = simplify_mesh(sphere, {.target_faces = 400, .tolerance = 0.2});
  CHECK(by_faces.stop == StopReason::faces);
  CHECK(by_faces.mesh.face_count() == 400);
  const SimplifyResult by_distance = simplify_mesh(sphere, {.target_faces = 4, .tolerance = 0.02});
  CHECK(by_distance.stop == StopReason::tolerance);
  CHECK(by_distance.mesh.face_count() > 4);
  CHECK_THROWS_AS((void)simplify_mesh(sphere, {.tolerance = -1.0}), InputError);
  CHECK_THROWS_AS((void)simplify_mesh(sphere, {.tolerance = std::numeric_limits<double>::quiet_NaN()}), InputError);
}
