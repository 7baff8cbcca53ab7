// The derived bounds against the arithmetic they are derived from, emulated in float32: Mesa's setup (lp_state_setup.c) and interpolation
// (lp_bld_interp.c), fused and not, from each start vertex. The emulation must stay inside the bound, and come near enough to show it is no blank cheque.
#include "validation/bounds.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/base/rng.h"

namespace etalon::validation {
namespace {

struct Plane {
  float a0, dadx, dady;
};

float fma_or_not(bool fused, float a, float b, float c) {
  return fused ? std::fma(a, b, c) : static_cast<float>(static_cast<float>(a * b) + c);
}

// emit_coef4 with the start vertex s; positions less half a texel, as pixel_center does.
Plane setup(const float* x, const float* y, const float* a, int s) {
  const int i1 = (s + 1) % 3, i2 = (s + 2) % 3;
  const float dx01 = x[s] - x[i1], dy01 = y[s] - y[i1], dx20 = x[i2] - x[s], dy20 = y[i2] - y[s];
  const float e = dx01 * dy20, f = dy01 * dx20;
  const float ooa = 1.0f / (e - f);
  const float da01 = a[s] - a[i1], da20 = a[i2] - a[s];
  const float dadx = da01 * (dy20 * ooa) - da20 * (dy01 * ooa);
  const float dady = da20 * (dx01 * ooa) - da01 * (dx20 * ooa);
  const float x0 = x[s] - 0.5f, y0 = y[s] - 0.5f;
  return {a[s] - (dadx * x0 + dady * y0), dadx, dady};
}

float evaluate(const Plane& p, int i, int j, bool fused) {
  const float a = fma_or_not(fused, p.dadx, static_cast<float>(i), p.a0);
  return fma_or_not(fused, p.dady, static_cast<float>(j), a);
}

struct Tally {
  long samples = 0, violations = 0, unbounded = 0;
  double largest = 0;
};

Tally run(bool perspective, int frame_size, int triangles) {
  Rng rng(perspective ? 11 : 7);
  Tally tally;
  const DeviceModel device = llvmpipe_model();
  for (int n = 0; n < triangles; ++n) {
    TriangleGeometry g;
    float x[3], y[3], a[3], oow[3];
    std::array<double, 3> value;
    const double size = frame_size * std::exp2(-10.0 * rng.unit());
    const double cx = rng.unit() * frame_size, cy = rng.unit() * frame_size;
    for (std::size_t k = 0; k < 3; ++k) {
      g.x[k] = std::round((cx + (rng.unit() - 0.5) * size) * 256) / 256;
      g.y[k] = std::round((cy + (rng.unit() - 0.5) * size) * 256) / 256;
      g.w[k] = perspective ? static_cast<double>(static_cast<float>(0.3 + 4.7 * rng.unit())) : 1.0;
      value[k] = static_cast<double>(static_cast<float>(4 * rng.unit() - 2));
    }
    g.center_x = g.center_y = frame_size / 2;
    g.exact_positions = !perspective;
    const double area = (g.x[1] - g.x[0]) * (g.y[2] - g.y[0]) - (g.x[2] - g.x[0]) * (g.y[1] - g.y[0]);
    if (area == 0) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      // Window positions as the device has them: three roundings of the offset from the centre, then one of the sum.
      const float w = static_cast<float>(g.w[k]), half = static_cast<float>(frame_size) / 2;
      const auto window = [&](double position) {
        const float clip = static_cast<float>((position - frame_size * 0.5) / (frame_size * 0.5) * g.w[k]);
        return static_cast<float>(static_cast<float>(clip * (1.0f / w)) * half + half);
      };
      x[k] = perspective ? window(g.x[k]) : static_cast<float>(g.x[k]);
      y[k] = perspective ? window(g.y[k]) : static_cast<float>(g.y[k]);
      oow[k] = 1.0f / w;
      a[k] = perspective ? static_cast<float>(value[k]) * oow[k] : static_cast<float>(value[k]);
    }
    std::array<double, 3> p, q;
    for (std::size_t k = 0; k < 3; ++k) {
      q[k] = 1 / g.w[k];
      p[k] = value[k] * q[k];
    }
    const auto largest = [](const std::array<double, 3>& v) { return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])}); };
    const PlaneBound plane_p(g, p, perspective ? 3 * kUnitRoundoff * largest(p) : 0, device);
    const PlaneBound plane_q(g, q, perspective ? 2 * kUnitRoundoff * largest(q) : 0, device);
    for (int m = 0; m < 12; ++m) {
      double b0 = rng.unit(), b1 = rng.unit();
      if (b0 + b1 > 1) {
        b0 = 1 - b0;
        b1 = 1 - b1;
      }
      const int i = static_cast<int>(g.x[0] + b0 * (g.x[1] - g.x[0]) + b1 * (g.x[2] - g.x[0]));
      const int j = static_cast<int>(g.y[0] + b0 * (g.y[1] - g.y[0]) + b1 * (g.y[2] - g.y[0]));
      const long double px = i + 0.5L, py = j + 0.5L;
      std::array<long double, 3> edge;
      bool inside = true;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
        edge[k] = ((g.x[v] - g.x[u]) * (py - g.y[u]) - (g.y[v] - g.y[u]) * (px - g.x[u])) / area;
        inside = inside && edge[k] >= 0;
      }
      if (!inside || i < 0 || j < 0) continue;
      const long double exact_p = edge[0] * p[0] + edge[1] * p[1] + edge[2] * p[2],
                        exact_q = edge[0] * q[0] + edge[1] * q[1] + edge[2] * q[2];
      const double exact =
          static_cast<double>(perspective ? exact_p / exact_q : edge[0] * value[0] + edge[1] * value[1] + edge[2] * value[2]);
      double bound = plane_p.at(i + 0.5, j + 0.5);
      if (perspective) bound = quotient_bound(bound, plane_q.at(i + 0.5, j + 0.5), exact, static_cast<double>(exact_q), device);
      ++tally.samples;
      if (!std::isfinite(bound)) {
        ++tally.unbounded;
        continue;
      }
      for (int s = 0; s < 3; ++s) {
        for (const bool fused : {false, true}) {
          float got = evaluate(setup(x, y, a, s), i, j, fused);
          if (perspective) got = got * (1.0f / evaluate(setup(x, y, oow, s), i, j, fused));
          const double share = std::abs(static_cast<double>(got) - exact) / bound;
          tally.violations += !(share <= 1);
          tally.largest = std::max(tally.largest, share);
        }
      }
    }
  }
  return tally;
}

TEST_CASE("affine interpolation in float32 stays within its bound and uses a good part of it") {
  for (const int size : {512, 1000, 8192}) {
    const Tally tally = run(false, size, 40000);
    CAPTURE(size);
    CHECK(tally.violations == 0);
    CHECK(tally.samples > 100000);
    CHECK(tally.unbounded < tally.samples / 1000);
    CHECK(tally.largest > 0.1);
    MESSAGE("affine, frame ", size, ": largest error / bound ", tally.largest);
  }
}

TEST_CASE("perspective interpolation in float32, displaced window positions included, stays within its bound") {
  for (const int size : {512, 1000, 8192}) {
    const Tally tally = run(true, size, 40000);
    CAPTURE(size);
    CHECK(tally.violations == 0);
    CHECK(tally.samples > 100000);
    CHECK(tally.unbounded < tally.samples / 100);
    CHECK(tally.largest > 0.1);
    MESSAGE("perspective, frame ", size, ": largest error / bound ", tally.largest);
  }
}

TEST_CASE("a sliver whose setup loses all digits has an infinite bound") {
  TriangleGeometry g{.x = {0, 4096, 2048}, .y = {0, 4095, 2047.5 + 1.0 / 256}};
  CHECK(
      std::isfinite(PlaneBound({.x = {0, 100, 0}, .y = {0, 0, 100}, .exact_positions = true}, {0, 1, 2}, 0, llvmpipe_model()).at(10, 10)));
  g.x[2] = 2048.5;
  g.y[2] = 2048;  // area of about a texel over edges of 4096: P/|A| about 2^24
  CHECK(std::isinf(PlaneBound(g, {0, 1, 2}, 0, llvmpipe_model()).at(1024.5, 1024.5)));
  CHECK(PlaneBound(g, {0, 1, 2}, 0, contract_model()).at(1024.5, 1024.5) == 0);
}

TEST_CASE("depth at a vertex: clip z and back in float32 stays within its bound") {
  Rng rng(3);
  const DeviceModel device = llvmpipe_model();
  double largest = 0;
  for (int n = 0; n < 2'000'000; ++n) {
    const double z = static_cast<double>(static_cast<float>(rng.unit()));
    const float w = rng.coin() ? 1.0f : static_cast<float>(std::exp2(40 * rng.unit() - 20));
    const float clip = static_cast<float>((2 * z - 1) * static_cast<double>(w));
    const float ndc = clip * (1.0f / w);
    for (const float back : {std::fma(ndc, 0.5f, 0.5f), ndc * 0.5f + 0.5f}) {
      largest = std::max(largest, std::abs(static_cast<double>(back) - z) / vertex_depth_error(z, device));
    }
  }
  CHECK(largest <= 1);
  CHECK(largest > 0.3);
  MESSAGE("vertex depth: largest error / bound ", largest);
}

TEST_CASE("useless means more than a quarter of the range, or of the size of nearly constant attributes") {
  CHECK(is_useless(HUGE_VAL, {0, 1, 2}));
  CHECK_FALSE(is_useless(0.49, {0, 1, 2}));
  CHECK(is_useless(0.51, {0, 1, 2}));
  CHECK_FALSE(is_useless(1e-6, {1, 1, 1}));
  CHECK(is_useless(1e-4, {1, 1, 1}));
}

TEST_CASE("the texel coordinate in float32 stays within its margin bound, wrapped by fraction or not") {
  Rng rng(9);
  const DeviceModel device = llvmpipe_model();
  for (int n = 0; n < 2'000'000; ++n) {
    const int size = static_cast<int>(rng.between(1, 4096));
    float u = rng.uniform(-3, 3);
    if (rng.below(4) == 0) u *= 0x1p-20f;
    const double exact = static_cast<double>(u) * size;
    const auto s = static_cast<float>(size);
    REQUIRE(std::abs(static_cast<double>(u * s) - exact) <= texel_margin_bound(static_cast<double>(u), 0, size, false, false, device));
    REQUIRE(std::abs(static_cast<double>(u * s - 0.5f) - (exact - 0.5)) <=
            texel_margin_bound(static_cast<double>(u), 0, size, false, true, device));
    const float fraction = u - std::floor(u);
    const double wrapped = static_cast<double>(fraction * s) - (exact - static_cast<double>(std::floor(u)) * size);
    REQUIRE(std::abs(wrapped) <= texel_margin_bound(static_cast<double>(u), 0, size, true, false, device));
  }
}

TEST_CASE("a specified device: the derived shape at another accuracy, texel coordinates on a grid, and no proof") {
  const DeviceModel device = specified_model("d", 5, 8, "somewhere");
  CHECK(to_string(device.origin) == "specified");
  CHECK(texel_margin_bound(0.5, 0, 64, false, false, device) ==
        texel_margin_bound(0.5, 0, 64, false, false, llvmpipe_model()) + 0x1p-8);  // a truncated coordinate is less than one step off
  CHECK(specified_model("d", 5, 0, "").coordinate_error_texel == 0);
  CHECK(vertex_depth_error(1, device) == 5 * vertex_depth_error(1, llvmpipe_model()));
}

}  // namespace
}  // namespace etalon::validation
