#include "core/procedural/knot.h"

#include <cstdlib>
#include <span>

#include <doctest/doctest.h>

#include "core/base/error.h"
#include "core/base/sha256.h"
#include "core/mesh/mesh_validation.h"
#include "tests/procedural/mesh_sha256.h"

using namespace etalon;
using namespace etalon::procedural;

namespace {

/// Six times the signed volume: positive where faces are counter-clockwise seen from outside.
double volume6(const Mesh& mesh) {
  double sum = 0;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    const Vec3d a(mesh.position(FaceId(f), 0)), b(mesh.position(FaceId(f), 1)), c(mesh.position(FaceId(f), 2));
    sum += a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
  }
  return sum;
}

}  // namespace

TEST_CASE("the knot is one closed manifold surface") {
  const Mesh knot = make_knot();
  CHECK(knot.vertex_count() == 50'000);
  CHECK(knot.face_count() == 100'000);
  CHECK(knot.colors.size() == knot.vertex_count());
  const MeshReport report = validate_mesh(knot);
  CHECK(report.manifold());
  CHECK(report.oriented());
  CHECK(report.component_count == 1);
  CHECK(report.boundary_loop_count == 0);
  CHECK(report.degenerate_faces.count == 0);
}

TEST_CASE("the knot is about as thick as its tube, and its faces look outward") {
  // Length of the knot: ∫√(9 + 4(2 + cos 3t)²) dt over 2π is about 32; times π·0.45² is 20.3; noise moves that by some percent.
  const double volume = volume6(make_knot()) / 6;
  CHECK(volume > 17);
  CHECK(volume < 25);
  const Mesh knot = make_knot({.rings = 60, .around = 12});
  for (const Vec4f& c : knot.colors)
    for (int k = 0; k < 3; ++k) REQUIRE((c[k] >= 0 && c[k] <= 1));
}

TEST_CASE("the knot by its number of faces") {
  CHECK(knot_of_faces(100'000).rings == 500);
  CHECK(knot_of_faces(100'000).around == 100);
  for (const int faces : {250, 999, 31'337, 2'360'000, 10'000'000}) {
    CAPTURE(faces);
    const KnotOptions options = knot_of_faces(faces);
    // Rounding the rings moves the count by at most `around` faces each way.
    CHECK(std::abs(2 * options.rings * options.around - faces) <= options.around);
  }
  CHECK(make_knot(knot_of_faces(250)).face_count() == 250);
}

TEST_CASE("the knot's bytes") {
  const Mesh knot = make_knot({.rings = 100, .around = 20});
  CHECK(test::mesh_sha256(knot) == "e47030f96435a39394b5ffacabb6d2f8cf3cd061234e14bfb1e747d3d702cf80");
  CHECK(sha256_hex(std::as_bytes(std::span(knot.colors))) == "2aed7356e1eaa606e63b9c7ba0751d1cff41d5ea4eca69f7e1f78aed77adec5a");
}

TEST_CASE("the knot refuses sizes out of range") {
  CHECK_THROWS_WITH_AS((void)make_knot({.rings = 11}), "knot: rings: expected 12 to 20000, got 11", InputError);
  CHECK_THROWS_AS((void)make_knot({.rings = 20'001}), InputError);
  CHECK_THROWS_WITH_AS((void)make_knot({.around = 2}), "knot: vertices around: expected 3 to 4000, got 2", InputError);
  CHECK_THROWS_AS((void)make_knot({.around = 4'001}), InputError);
  CHECK_THROWS_WITH_AS((void)knot_of_faces(249), "knot: faces: expected 250 to 10000000, got 249", InputError);
  CHECK_THROWS_AS((void)knot_of_faces(10'000'001), InputError);
}
