// The monkey, the duck and the statue: the papers' sizes, soundness, colours that form does not explain, bytes.
#include <cmath>
#include <cstdlib>
#include <span>

#include <doctest/doctest.h>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/sha256.h"
#include "core/mesh/mesh_validation.h"
#include "core/procedural/duck.h"
#include "core/procedural/monkey.h"
#include "core/procedural/statue.h"
#include "tests/procedural/mesh_sha256.h"
#include "tests/support/skip.h"

using namespace etalon;
using namespace etalon::procedural;

namespace {

void check_sound(const Mesh& mesh, bool closed) {
  const MeshReport report = validate_mesh(mesh);
  CHECK(report.manifold());
  CHECK(report.oriented());
  CHECK(report.closed() == closed);
  CHECK(report.component_count == 1);
  CHECK(report.euler_characteristic == (closed ? 2 : 1));
  CHECK(report.duplicate_faces.count == 0);
  CHECK(report.degenerate_faces.count == 0);
  CHECK(report.unreferenced_vertices.count == 0);
  CHECK(report.non_finite_vertices.count == 0);
  CHECK(mesh.colors.size() == mesh.vertex_count());
}

std::string color_sha256(const Mesh& mesh) { return sha256_hex(std::as_bytes(std::span(mesh.colors))); }

/// Six times the signed volume.
double volume6(const Mesh& mesh) {
  double sum = 0;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    const Vec3d a(mesh.position(FaceId(f), 0)), b(mesh.position(FaceId(f), 1)), c(mesh.position(FaceId(f), 2));
    sum += a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
  }
  return sum;
}

/// Share of the edges whose ends differ by more than 0.2 in RGB while their faces' normals differ by less than about 8° (cosine 0.99): a
/// feature of colour and not of form.
double flat_color_edges(const Mesh& mesh) {
  std::vector<Vec3d> normals(mesh.vertex_count(), Vec3d(0, 0, 0));
  for (const auto& face : mesh.faces) {
    const std::uint32_t v[3] = {mesh.wedges[face[0].index].vertex.index, mesh.wedges[face[1].index].vertex.index,
                                mesh.wedges[face[2].index].vertex.index};
    const Vec3d a(mesh.positions[v[0]]), n = cross(Vec3d(mesh.positions[v[1]]) - a, Vec3d(mesh.positions[v[2]]) - a);
    for (const std::uint32_t i : v) normals[i] += n;
  }
  std::size_t edges = 0, found = 0;
  for (const auto& face : mesh.faces)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.wedges[face[k].index].vertex.index, b = mesh.wedges[face[(k + 1) % 3].index].vertex.index;
      const Vec4f d = mesh.colors[a] - mesh.colors[b];
      ++edges;
      if (d.x * d.x + d.y * d.y + d.z * d.z > 0.04f && dot(normalized(normals[a]), normalized(normals[b])) > 0.99) ++found;
    }
  return static_cast<double>(found) / static_cast<double>(edges);
}

}  // namespace

TEST_CASE("the monkey has the paper's size, is sound, and is painted beyond its form") {
  const Mesh monkey = make_monkey();
  CHECK(monkey.face_count() == 101'002);
  CHECK(monkey.vertex_count() == 50'503);
  check_sound(monkey, true);
  CHECK(volume6(monkey) > 0);
  CHECK(flat_color_edges(monkey) > 0.005);
  for (const Vec4f& c : monkey.colors)
    for (int k = 0; k < 3; ++k) REQUIRE((c[k] >= 0 && c[k] <= 1));
}

TEST_CASE("the duck has the papers' sizes, closed and open") {
  const Mesh closed = make_duck();
  CHECK(closed.vertex_count() == 83'141);
  CHECK(closed.face_count() == 166'278);
  check_sound(closed, true);
  CHECK(volume6(closed) > 0);
  CHECK(flat_color_edges(closed) > 0.005);

  const Mesh open = make_duck(duck_of_paper(true));
  CHECK(open.vertex_count() == 50'052);
  CHECK(open.face_count() == 99'997);
  check_sound(open, false);
  const MeshReport report = validate_mesh(open);
  CHECK(report.boundary_loop_count == 1);
  CHECK(report.boundary_edges.count == 105);
}

TEST_CASE("the duck by its number of faces, closed and open") {
  for (const int faces : {2'000, 31'337, 166'278, 1'000'000}) {
    CAPTURE(faces);
    for (const bool open : {false, true}) {
      CAPTURE(open);
      const DuckOptions o = duck_of_faces(faces, open);
      const int made = 2 * o.rings * o.segments - 2 * o.hole_rings * o.hole_segments - (open ? 1 : 0);
      CHECK(std::fabs(made - faces) < 0.04 * faces);
    }
  }
  check_sound(make_duck(duck_of_faces(2'000, true)), false);
  check_sound(make_duck(duck_of_faces(5'000, false)), true);
}

TEST_CASE("the statue is sound at every size tried") {
  for (const int faces : {40'000, 100'002}) {
    CAPTURE(faces);
    const Mesh statue = make_statue({.faces = faces, .progress = {}});
    CHECK(statue.face_count() == static_cast<std::size_t>(faces));
    check_sound(statue, true);
    CHECK(volume6(statue) > 0);
    CHECK(flat_color_edges(statue) > 0.005);
  }
}

TEST_CASE("the statue has the paper's size") {
  const char* full = std::getenv("ETALON_FULL");
  if (full == nullptr || std::string(full) != "1") {
    test::report_skip("the statue has the paper's size", "a minute; set ETALON_FULL=1");
    return;
  }
  const Mesh large = make_statue({.faces = 2'351'302, .progress = {}});
  CHECK(large.face_count() == 2'351'302);
  CHECK(large.vertex_count() == 1'175'653);
  check_sound(large, true);
}

TEST_CASE("the coloured models' bytes, for any thread count") {
  for (const int threads : {1, 3}) {
    CAPTURE(threads);
    set_thread_count(threads);
    const Mesh monkey = make_monkey({.faces = 20'000, .progress = {}}), duck = make_duck(duck_of_faces(6'000, true)),
               statue = make_statue({.faces = 40'000, .progress = {}});
    set_thread_count(0);
    CHECK(test::mesh_sha256(monkey) == "81c3d8248ad53e909d8f1545c60ddb78812a93a4b50dc6d44d9fc59d6d36add0");
    CHECK(color_sha256(monkey) == "060385b741b26ca180d450af0c6c41a9efa385fcd79aff623de7a9ef586505e9");
    CHECK(test::mesh_sha256(duck) == "4a6dabc400ba8aaebabca763c3b2f3c374790efce696aaf0f9a0c020b4e02e85");
    CHECK(color_sha256(duck) == "008601f2301df9be5a93a5fac5cd2efd36e1eedd20580da6050cac0b6de764e2");
    CHECK(test::mesh_sha256(statue) == "166760428a6e80097f5871d61e2291e55a148d6a7a0b920a99faa05d2b3c37cc");
    CHECK(color_sha256(statue) == "f139699cf91ec81ac7d651b7f95953f619d085e354e2be7c93096dc9a4c9f01f");
  }
}

TEST_CASE("the coloured models refuse sizes out of range") {
  CHECK_THROWS_WITH_AS((void)make_monkey({.faces = 19'998, .progress = {}}),
                       "monkey: faces: expected an even number, 20000 to 10000000, got 19998", InputError);
  CHECK_THROWS_AS((void)make_monkey({.faces = 20'001, .progress = {}}), InputError);
  CHECK_THROWS_AS((void)make_monkey({.faces = 10'000'002, .progress = {}}), InputError);
  CHECK_THROWS_WITH_AS((void)make_statue({.faces = 39'998, .progress = {}}),
                       "statue: faces: expected an even number, 40000 to 10000000, got 39998", InputError);
  CHECK_THROWS_AS((void)make_statue({.faces = 40'001, .progress = {}}), InputError);
  CHECK_THROWS_WITH_AS((void)make_duck({.rings = 23, .progress = {}}), "duck: rings: expected 24 to 8000, got 23", InputError);
  CHECK_THROWS_WITH_AS((void)make_duck({.segments = 8001, .progress = {}}), "duck: segments: expected 24 to 8000, got 8001", InputError);
  CHECK_THROWS_WITH_AS((void)make_duck({.rings = 40, .segments = 40, .hole_rings = 2, .hole_segments = 11, .progress = {}}),
                       "duck: hole: expected 2 to 10 rings and 2 to 10 segments, got 2 and 11", InputError);
  CHECK_THROWS_AS((void)make_duck({.hole_rings = 0, .hole_segments = 4, .progress = {}}), InputError);
  CHECK_THROWS_WITH_AS((void)duck_of_faces(1'999, true), "duck: faces: expected 2000 to 10000000, got 1999", InputError);
}
