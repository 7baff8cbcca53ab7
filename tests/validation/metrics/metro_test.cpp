#include "validation/metrics/metro.h"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/rng.h"
#include "tests/simplify/sample_meshes.h"
#include "validation/reference/surface_judge.h"

using namespace etalon;
using namespace etalon::test;
using namespace etalon::validation;

namespace {

reference::JudgedSurface judged(const Mesh& mesh) {
  reference::JudgedSurface surface;
  for (const Vec3f& p : mesh.positions) surface.positions.push_back({p.x, p.y, p.z});
  for (const Vec4f& c : mesh.colors) surface.colors.push_back({c.x, c.y, c.z});
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
    surface.faces.push_back({mesh.vertex(FaceId(f), 0).index, mesh.vertex(FaceId(f), 1).index, mesh.vertex(FaceId(f), 2).index});
  return surface;
}

bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

bool same_bits(const DirectedDistance& a, const DirectedDistance& b) {
  return a.samples == b.samples && same_bits(a.mean, b.mean) && same_bits(a.rms, b.rms) && same_bits(a.max, b.max) &&
         a.max_at == b.max_at && same_bits(a.colour_mean.value_or(-1), b.colour_mean.value_or(-1)) &&
         same_bits(a.colour_rms.value_or(-1), b.colour_rms.value_or(-1)) && same_bits(a.colour_max.value_or(-1), b.colour_max.value_or(-1));
}

/// Every figure, to the last bit.
void check_equal(const DirectedDistance& ours, const reference::JudgedDistance& judge) {
  CHECK(ours.samples == judge.samples);
  CHECK(ours.vertex_samples == judge.vertex_samples);
  CHECK(ours.edge_samples == judge.edge_samples);
  CHECK(ours.face_samples == judge.face_samples);
  CHECK(same_bits(ours.mean, judge.mean));
  CHECK(same_bits(ours.rms, judge.rms));
  CHECK(same_bits(ours.max, judge.max));
  for (std::size_t k = 0; k < 3; ++k) CHECK(same_bits(ours.max_at[static_cast<int>(k)], judge.max_at[k]));
  REQUIRE(ours.colour_rms.has_value() == judge.has_colors);
  if (!judge.has_colors) return;
  CHECK(same_bits(*ours.colour_mean, judge.colour_mean));
  CHECK(same_bits(*ours.colour_rms, judge.colour_rms));
  CHECK(same_bits(*ours.colour_max, judge.colour_max));
}

void check_against_judge(const Mesh& a, const Mesh& b, std::uint64_t samples) {
  const SurfaceDistance distance = measure_surfaces(a, b, {.samples = samples});
  check_equal(distance.forward, reference::judge_distance(judged(a), judged(b), samples));
  check_equal(distance.backward, reference::judge_distance(judged(b), judged(a), samples));
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

TEST_CASE("equal to the judge, which asks every face and shares no code, to the last bit") {
  const Mesh a = coloured(bumpy_sphere(5, 0.3f, 3)), b = coloured(bumpy_sphere(3, 0.1f, 4));
  check_against_judge(a, b, 10'000);  // three blocks
  for (const NamedMesh& sample : sample_meshes()) {
    CAPTURE(sample.name);
    check_against_judge(sample.mesh, b, 700);
    check_against_judge(coloured(sample.mesh), coloured(square()), 5000);
  }
}

TEST_CASE("equal to the judge where it is hard: slivers, faces of no area, huge and tiny units, far apart, far from the origin") {
  Rng rng(9);
  Mesh slivers = bumpy_grid(8, 0.3f, 5);
  for (Vec3f& p : slivers.positions) p.y *= 0x1p-16f * static_cast<float>(1 + rng.below(100));
  check_against_judge(slivers, bumpy_grid(7, 0.2f, 6), 3000);
  Mesh flat = square();
  for (std::uint32_t i = 0; i < 9; ++i) flat.faces.push_back({WedgeId(i % 4), WedgeId(i % 2), WedgeId(i % 4)});
  check_against_judge(flat, bumpy_sphere(3, 0.2f, 1), 2000);
  const Mesh ball = coloured(bumpy_sphere(4, 0.3f, 3));
  for (const auto& [scale, offset] : {std::pair(0x1p+100f, 0.0f), {0x1p-100f, 0.0f}, {1.0f, 1e6f}, {0x1p-20f, 1.0f}}) {
    const float captured = scale;
    CAPTURE(captured);
    Mesh moved = ball, other = coloured(bumpy_sphere(3, 0.1f, 7));
    for (Vec3f& p : moved.positions) p = p * scale + Vec3f(offset);
    for (Vec3f& p : other.positions) p = p * scale + Vec3f(offset);
    check_against_judge(moved, other, 2000);
    if (offset != 0) check_against_judge(moved, ball, 2000);
  }
}

TEST_CASE("the judge sees what is wrong: another face, another sample, another order of sums") {
  const Mesh a = coloured(bumpy_sphere(5, 0.3f, 3)), b = coloured(bumpy_sphere(3, 0.1f, 4));
  const reference::JudgedDistance judge = reference::judge_distance(judged(a), judged(b), 3000);
  const auto ask = [&](const Mesh& to, const auto& change) {
    const TriangleTree tree(to);
    return measure_direction(
        a, to,
        [&](std::span<const Vec3d> points, std::span<SurfacePoint> found) {
          tree.nearest(points, found);
          change(found);
        },
        3000);
  };
  const auto nothing = [](std::span<SurfacePoint>) {};
  check_equal(ask(b, nothing), judge);
  CHECK_FALSE(same_bits(ask(b, [](std::span<SurfacePoint> found) { found[7].distance2 *= 1 + 0x1p-40; }).rms, judge.rms));
  CHECK_FALSE(same_bits(*ask(b, [](std::span<SurfacePoint> found) { found[7].face = found[8].face; }).colour_rms, judge.colour_rms));
  Mesh fewer = b;
  fewer.faces.pop_back();
  CHECK_FALSE(same_bits(ask(fewer, nothing).rms, judge.rms));
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
