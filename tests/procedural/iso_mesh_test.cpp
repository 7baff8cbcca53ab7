#include "core/procedural/iso_mesh.h"

#include <cmath>

#include <doctest/doctest.h>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/mesh/mesh_validation.h"
#include "core/procedural/colored_mesh.h"

using namespace etalon;
using namespace etalon::procedural;

namespace {

double sphere(const Vec3d& p) { return length(p) - 1; }
double two_spheres(const Vec3d& p) { return std::fmin(length(p) - 0.5, length(p - Vec3d(1.5, 0, 0)) - 0.5); }
double torus(const Vec3d& p) { return length(Vec3d(std::sqrt(p.x * p.x + p.z * p.z) - 0.7, p.y, 0)) - 0.25; }

IsoLattice around(Field field, double spacing) {
  return {.field = field, .lo = {-2.3, -2.2, -2.1}, .hi = {2.3, 2.2, 2.1}, .seed = {0.01, 0.02, 0.03}, .spacing = spacing};
}

Mesh mesh_of(const IsoTriangles& surface) {
  return colored_mesh(surface.positions, surface.faces, [](const Vec3d&) { return Vec3d(0, 0, 0); });
}

double volume(const IsoTriangles& surface) {
  double sum = 0;
  for (const auto& f : surface.faces) sum += dot(surface.positions[f[0]], cross(surface.positions[f[1]], surface.positions[f[2]])) / 6;
  return sum;
}

}  // namespace

TEST_CASE("marching a sphere: closed, manifold, outward, on the sphere") {
  const IsoTriangles surface = march_lattice(around(sphere, 0.1));
  const MeshReport report = validate_mesh(mesh_of(surface));
  CHECK(report.closed());
  CHECK(report.manifold());
  CHECK(report.oriented());
  CHECK(report.genus == 0);
  CHECK(report.component_count == 1);
  // 6.46/spacing² vertices a unit of area, averaged over directions (iso_lattice.h): 4π·646 = 8118, and a sphere has all directions.
  CHECK(std::fabs(static_cast<double>(surface.positions.size()) - 8118) < 0.02 * 8118);
  for (const Vec3d& p : surface.positions) REQUIRE(std::fabs(sphere(p)) < 1e-4);  // the chord's sag below the last halving's (0.1/8)²
  CHECK(volume(surface) > 0.99 * 4.18879);
  CHECK(volume(surface) < 4.18879);  // inscribed
}

TEST_CASE("marching follows the component that the seed's ray meets first, and no other") {
  IsoLattice lattice = around(two_spheres, 0.05);
  const IsoTriangles first = march_lattice(lattice);
  for (const Vec3d& p : first.positions) REQUIRE(p.x < 0.6);
  lattice.seed = {1.5, 0, 0};
  const IsoTriangles second = march_lattice(lattice);
  for (const Vec3d& p : second.positions) REQUIRE(p.x > 0.9);
}

TEST_CASE("marching: what cannot be marched is refused") {
  IsoLattice lattice = around(sphere, 0.1);
  lattice.seed = {2, 2, 2};
  CHECK_THROWS_WITH_AS((void)march_lattice(lattice), "implicit mesh: no surface between the seed and the box", InputError);
  lattice = around(sphere, 0.1);
  lattice.lo = {-0.5, -2, -2};
  CHECK_THROWS_WITH_AS((void)march_lattice(lattice), "implicit mesh: the surface leaves its box", InputError);
  lattice = around(sphere, 1e-5);
  CHECK_THROWS_AS((void)march_lattice(lattice), InputError);
  lattice = around(sphere, 0.1);
  lattice.hi.x = lattice.lo.x;
  CHECK_THROWS_AS((void)march_lattice(lattice), InputError);
}

TEST_CASE("an implicit mesh has exactly the faces asked for, nearly equilateral, and the same bytes for any thread count") {
  IsoMeshOptions options;
  options.lattice = around(sphere, 1);
  int calls = 0, last = -1, total = 0;
  options.progress = [&](int done, int all) {
    ++calls;
    CHECK(done >= last);
    last = done;
    total = all;
  };
  for (const std::size_t faces : {1000u, 1002u, 5004u, 20'000u}) {
    CAPTURE(faces);
    options.faces = faces;
    last = -1;
    const IsoTriangles mesh = make_iso_mesh(options);
    CHECK(mesh.faces.size() == faces);
    CHECK(mesh.positions.size() == faces / 2 + 2);
    CHECK(last == total);
    double thinnest = 1;  // smallest ratio of a face's area to that of the equilateral one on its longest side
    double sum = 0;
    for (const auto& f : mesh.faces) {
      const Vec3d a = mesh.positions[f[1]] - mesh.positions[f[0]], b = mesh.positions[f[2]] - mesh.positions[f[0]];
      const double longest = std::fmax(dot(a, a), std::fmax(dot(b, b), dot(b - a, b - a)));
      const double quality = length(cross(a, b)) / (longest * std::sqrt(0.75));
      thinnest = std::fmin(thinnest, quality);
      sum += quality;
    }
    CHECK(thinnest > 0.02);  // no slivers
    CHECK(sum / static_cast<double>(mesh.faces.size()) > 0.7);
  }
  CHECK(calls > 0);
  options.progress = {};
  options.faces = 6000;
  set_thread_count(1);
  const IsoTriangles one = make_iso_mesh(options);
  set_thread_count(7);
  const IsoTriangles seven = make_iso_mesh(options);
  set_thread_count(0);
  CHECK(one.positions == seven.positions);
  CHECK(one.faces == seven.faces);
}

TEST_CASE("an implicit mesh: odd counts, too few faces and surfaces of another genus are refused") {
  IsoMeshOptions options;
  options.lattice = around(sphere, 1);
  options.faces = 1001;
  CHECK_THROWS_WITH_AS((void)make_iso_mesh(options), "implicit mesh: faces: expected an even number, 1000 to 20000000, got 1001",
                       InputError);
  options.faces = 998;
  CHECK_THROWS_AS((void)make_iso_mesh(options), InputError);
  options.faces = 4000;
  options.lattice.field = torus;
  options.lattice.seed = {0.7, 0, 0};
  CHECK_THROWS_WITH_AS((void)make_iso_mesh(options),
                       "implicit mesh: the surface is not of genus 0 at this size: 4004 faces of 2002 vertices", InputError);
}
