#include "validation/bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace etalon::validation {

namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
// The bounds themselves are evaluated in double; cancellation in a gradient costs at most 2^-52·P/|A| <= 2^-30 where ρ < 1/2.
constexpr double kEvaluationSlack = 1 + 0x1p-16;

}  // namespace

DeviceModel contract_model() {
  return {.name = "contract", .origin = BoundOrigin::exact, .valid_for = "docs/contract.md, version 1", .factor = 0};
}

DeviceModel llvmpipe_model() {
  return {.name = "llvmpipe",
          .origin = BoundOrigin::derived,
          .valid_for = "llvmpipe of Mesa 22.x to 23.x, checked on 22.3.6 (LLVM 15)",
          .factor = 1,
          .fixed_point_linear8 = true,
          .srgb_polynomial = true};
}

DeviceModel measured_model(const std::string& name, double factor, const std::string& valid_for) {
  return {.name = name, .origin = BoundOrigin::measured, .valid_for = valid_for, .factor = factor};
}

DeviceModel specified_model(const std::string& name, double unit_roundoffs, int coordinate_bits, const std::string& section) {
  DeviceModel model{.name = name, .origin = BoundOrigin::specified, .valid_for = section, .factor = unit_roundoffs};
  // Rounded or truncated to the grid: less than one step of it.
  if (coordinate_bits > 0) model.coordinate_error_texel = std::ldexp(1.0, -coordinate_bits);
  return model;
}

std::string to_string(BoundOrigin origin) {
  switch (origin) {
    case BoundOrigin::exact: return "exact";
    case BoundOrigin::derived: return "derived";
    case BoundOrigin::measured: return "measured";
    case BoundOrigin::specified: return "specified";
  }
  return "?";
}

double displacement(const TriangleGeometry& g) {
  if (g.exact_positions) return 0;
  // x_w = fl(fl(x_c·rcp(w))·W/2 + centre), W a power of two: three relative errors of u (x_c, the reciprocal, their product) of
  // x_c/w·W/2 = x − centre, then the rounding of x itself. Fused or not, the product with W/2 is exact.
  double worst = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    worst = std::max(worst, 3 * std::abs(g.x[i] - g.center_x) + std::abs(g.x[i]));
    worst = std::max(worst, 3 * std::abs(g.y[i] - g.center_y) + std::abs(g.y[i]));
  }
  return kUnitRoundoff * worst * kEvaluationSlack;
}

PlaneBound::PlaneBound(const TriangleGeometry& g, const std::array<double, 3>& a, double vertex_error, const DeviceModel& device) {
  factor_ = device.factor * kEvaluationSlack;
  if (device.factor == 0) {
    unbounded_ = false;
    constant_ = 0;
    factor_ = 0;
    return;
  }
  const double area = (g.x[0] - g.x[1]) * (g.y[2] - g.y[0]) - (g.x[2] - g.x[0]) * (g.y[0] - g.y[1]);
  const double abs_area = std::abs(area);
  {
    const double dx01 = g.x[0] - g.x[1], dy01 = g.y[0] - g.y[1], dx20 = g.x[2] - g.x[0], dy20 = g.y[2] - g.y[0];
    gx_ = std::abs(((a[0] - a[1]) * dy20 - (a[2] - a[0]) * dy01) / area);
    gy_ = std::abs(((a[2] - a[0]) * dx01 - (a[0] - a[1]) * dx20) / area);
  }
  const double delta = displacement(g);
  const double box = (std::max({g.x[0], g.x[1], g.x[2]}) - std::min({g.x[0], g.x[1], g.x[2]})) +
                     (std::max({g.y[0], g.y[1], g.y[2]}) - std::min({g.y[0], g.y[1], g.y[2]}));
  // 2·area of a triangle whose vertices move by δ changes by at most 2δ(W + H) + 6δ².
  const double rho_delta = (2 * delta * box + 6 * delta * delta) / abs_area;

  unbounded_ = false;
  double largest_rho = 0;
  for (std::size_t s = 0; s < 3; ++s) {
    const std::size_t i1 = (s + 1) % 3, i2 = (s + 2) % 3;
    const double dx01 = g.x[s] - g.x[i1], dy01 = g.y[s] - g.y[i1], dx20 = g.x[i2] - g.x[s], dy20 = g.y[i2] - g.y[s];
    const double p = std::abs(dx01 * dy20) + std::abs(dx20 * dy01);
    const double rho = 2 * kUnitRoundoff * p / abs_area + rho_delta;
    if (!(rho < 0.5)) {
      unbounded_ = true;
      return;
    }
    largest_rho = std::max(largest_rho, rho);
    const double da01 = std::abs(a[s] - a[i1]), da20 = std::abs(a[i2] - a[s]);
    // The vertex errors enter the differences; the plane through erroneous vertices is a convex combination, added once below.
    start_[s].dx = (5 * kUnitRoundoff * (da01 * std::abs(dy20) + da20 * std::abs(dy01)) / abs_area + rho * gx_) / (1 - rho);
    start_[s].dy = (5 * kUnitRoundoff * (da20 * std::abs(dx01) + da01 * std::abs(dx20)) / abs_area + rho * gy_) / (1 - rho);
    start_[s].a = std::abs(a[s]);
    start_[s].x = g.x[s];
    start_[s].y = g.y[s];
  }
  // Inside the triangle the plane of displaced vertices differs by at most (|gx| + |gy|)·δ/(1 − ρ), that of erroneous values by their error.
  constant_ = (gx_ + gy_) * delta / (1 - largest_rho) + vertex_error / (1 - largest_rho);
}

double PlaneBound::at(double x, double y) const {
  if (unbounded_) return kInf;
  if (factor_ == 0) return 0;
  double worst = 0;
  for (const Start& s : start_) {
    const double slope = s.dx * std::abs(x - s.x) + s.dy * std::abs(y - s.y);
    // The device measures from the frame's origin with sample and vertex both moved by half a texel: |x_s − ½| <= |x_s| + ½.
    const double round =
        6 * kUnitRoundoff * (s.a + (gx_ + s.dx) * (std::abs(x) + std::abs(s.x) + 0.5) + (gy_ + s.dy) * (std::abs(y) + std::abs(s.y) + 0.5));
    worst = std::max(worst, slope + round);
  }
  return (worst + constant_) * factor_;
}

double quotient_bound(double bound_p, double bound_q, double value, double q, const DeviceModel& device) {
  if (device.factor == 0) return 0;
  if (!(bound_q < q / 2) || !std::isfinite(bound_p)) return kInf;
  return ((bound_p + std::abs(value) * bound_q) / (q - bound_q) + 2 * kUnitRoundoff * std::abs(value) * device.factor) * kEvaluationSlack;
}

double vertex_depth_error(double z, const DeviceModel& device) {
  if (device.factor == 0) return 0;
  const double ndc = std::abs(2 * z - 1);
  // fl((2z−1)·w), rcp(w), product: 3u of ndc, halved; then the sum's rounding, half an ulp of a number of at most 1.
  return (1.5 * kUnitRoundoff * ndc + 0.5 * kUnitRoundoff) * device.factor * kEvaluationSlack;
}

bool is_useless(double bound, const std::array<double, 3>& a) {
  if (!std::isfinite(bound)) return true;
  const double range = std::max({a[0], a[1], a[2]}) - std::min({a[0], a[1], a[2]});
  const double largest = std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
  return bound > std::max(range / 4, 0x1p-16 * largest);
}

double texel_margin_bound(double u, double error_u, int size, bool wraps_by_fraction, bool linear, const DeviceModel& device) {
  if (device.factor == 0) return 0;
  const double n = size;
  double bound = n * (error_u + kUnitRoundoff * std::abs(u));  // fl(u·n)
  // x − floor(x) of a small negative x rounds near 1 (u/2), and the product is then that of a number up to 1.
  if (wraps_by_fraction) bound += n * (kUnitRoundoff * std::max(0.0, 1 - std::abs(u)) + 0.5 * kUnitRoundoff);
  if (linear) bound += kUnitRoundoff * (std::abs(u) * n + 0.5);  // fl(u·n − ½)
  return bound * kEvaluationSlack + device.coordinate_error_texel;
}

double srgb_polynomial_decode(int c) {
  const double x = c;
  if (c <= 15) return x / (12.6 * 255.0);
  const double c0 = static_cast<double>(0.0023f), c1 = static_cast<double>(0.0030f / 255.0f);
  const double c2 = static_cast<double>(0.6935f / (255.0f * 255.0f)), c3 = static_cast<double>(0.3012f / (255.0f * 255.0f * 255.0f));
  return ((x * c3 + c2) * x + c1) * x + c0;
}

}  // namespace etalon::validation
