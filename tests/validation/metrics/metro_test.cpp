#include "validation/metrics/metro.h"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "tests/simplify/sample_meshes.h"

using namespace etalon;
using namespace etalon::test;
using namespace etalon::validation;

namespace {

/// Asks every face, in face order.
NearestQuery judge_of(const Mesh& mesh) {
  return [&mesh](const Vec3d& p, FaceId) {
    SurfacePoint best;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
      const FaceId id(f);
      const NearestOnTriangle found =
          nearest_on_triangle(p, to_double(mesh.position(id, 0)), to_double(mesh.position(id, 1)), to_double(mesh.position(id, 2)));
      if (found.distance2 < best.distance2) best = {id, found.weights, found.point, found.distance2};
    }
    return best;
  };
}

bool same_bits(const DirectedDistance& a, const DirectedDistance& b) {
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
  return a.samples == b.samples && bits(a.mean) == bits(b.mean) && bits(a.rms) == bits(b.rms) && bits(a.max) == bits(b.max) &&
         a.max_at == b.max_at && bits(a.colour_mean.value_or(-1)) == bits(b.colour_mean.value_or(-1)) &&
         bits(a.colour_rms.value_or(-1)) == bits(b.colour_rms.value_or(-1)) &&
         bits(a.colour_max.value_or(-1)) == bits(b.colour_max.value_or(-1));
}

Mesh coloured(Mesh mesh) {
  for (const Vec3f& p : mesh.positions) mesh.colors.push_back({0.5f + 0.5f * p.x / 2, 0.5f, 0.5f - 0.5f * p.z / 2, 1});
  return mesh;
}

}  // namespace

TEST_CASE("a surface and itself") {
  const Mesh mesh = bumpy_grid(6, 0.3f, 1);
  const SurfaceDistance distance = measure_surfaces(mesh, mesh, {.samples = 3000});
  // Samples are off the surface by their rounding alone: 2^-52 of coordinates up to 1.
  CHECK(distance.max() < 0x1p-50);
  CHECK(distance.forward.samples == 3000);
}

TEST_CASE("parallel squares; a smaller one: forward and backward differ") {
  Mesh above = square(), small = square();
  for (Vec3f& p : above.positions) p.z = 1;
  const SurfaceDistance parallel = measure_surfaces(square(), above, {.samples = 1000});
  CHECK(parallel.forward.mean == 1);
  CHECK(parallel.backward.rms == 1);
  CHECK(parallel.max() == 1);
  CHECK(parallel.diagonal == doctest::Approx(std::sqrt(2.0)).epsilon(1e-15));
  for (Vec3f& p : small.positions) p = p * 0.5f;
  const SurfaceDistance inside = measure_surfaces(square(), small, {.samples = 1000});
  CHECK(inside.forward.max == std::sqrt(0.5));
  CHECK(inside.forward.max_at == Vec3d(1, 1, 0));
  CHECK(inside.backward.max < 0x1p-50);
  CHECK(inside.mean() == inside.forward.mean);
}

TEST_CASE("colour: the distance at the nearest points, where both have colours") {
  Mesh dark = square(), light = square();
  dark.colors.assign(4, {0, 0, 0, 1});
  light.colors.assign(4, {1, 1, 1, 0});
  const SurfaceDistance distance = measure_surfaces(dark, light, {.samples = 500});
  REQUIRE(distance.colour_rms().has_value());
  CHECK(*distance.colour_rms() == doctest::Approx(std::sqrt(3.0)).epsilon(1e-15));  // alpha does not count
  CHECK(*distance.forward.colour_max == doctest::Approx(std::sqrt(3.0)).epsilon(1e-15));
  CHECK_FALSE(measure_surfaces(dark, square(), {.samples = 500}).colour_rms().has_value());
}

TEST_CASE("equal to the judge that asks every face, to the last bit") {
  const std::vector<NamedMesh> meshes = sample_meshes();
  const Mesh a = coloured(bumpy_sphere(5, 0.3f, 3)), b = coloured(bumpy_sphere(3, 0.1f, 4));
  const SurfaceDistance distance = measure_surfaces(a, b, {.samples = 2000});
  CHECK(same_bits(distance.forward, measure_direction(a, b, judge_of(b), 2000)));
  CHECK(same_bits(distance.backward, measure_direction(b, a, judge_of(a), 2000)));
  for (const NamedMesh& sample : meshes) {
    CAPTURE(sample.name);
    CHECK(same_bits(measure_surfaces(sample.mesh, b, {.samples = 700}).forward, measure_direction(sample.mesh, b, judge_of(b), 700)));
    CHECK(same_bits(measure_surfaces(b, sample.mesh, {.samples = 700}).forward,
                    measure_direction(b, sample.mesh, judge_of(sample.mesh), 700)));
  }
}

TEST_CASE("the same bytes for every thread count") {
  const Mesh a = coloured(bumpy_sphere(9, 0.3f, 3)), b = coloured(bumpy_sphere(4, 0.1f, 4));
  const SurfaceDistance first = measure_surfaces(a, b, {.samples = 20000});
  for (const int threads : {1, 2, 7}) {
    set_thread_count(threads);
    const SurfaceDistance again = measure_surfaces(a, b, {.samples = 20000});
    CHECK(same_bits(again.forward, first.forward));
    CHECK(same_bits(again.backward, first.backward));
  }
  set_thread_count(0);
}

TEST_CASE("samples out of range; progress") {
  CHECK_THROWS_AS((void)measure_surfaces(square(), square(), {.samples = 0}), InputError);
  CHECK_THROWS_AS((void)measure_surfaces(square(), square(), {.samples = std::uint64_t{1} << 41}), InputError);
  std::size_t last = 0, calls = 0;
  (void)measure_surfaces(square(), square(), {.samples = 10, .progress = [&](std::size_t done, std::size_t total) {
                                                ++calls;
                                                CHECK(done >= last);
                                                CHECK(done < total);
                                                last = done;
                                              }});
  CHECK(calls == 2);
}
