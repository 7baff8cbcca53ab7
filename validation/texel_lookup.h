// A texture lookup with everything a device may legally return for it: the exact texels, and those of the other choices within the bound.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "core/draw/draw_list.h"
#include "validation/bounds.h"
#include "validation/storage_rounding.h"

namespace etalon::validation {

/// Channel `c` of texel (i, j) as a number (rounded once to double); absent channels are 0, 0, 1.
[[nodiscard]] double texel_value(const Image& image, int i, int j, int c);
/// The same with the device's decoding error.
[[nodiscard]] Bounded device_texel(const Image& image, int i, int j, int c, const DeviceModel& device);
/// Texel index after the wrap (docs/contract.md#values); i any integer.
[[nodiscard]] int wrap_index(std::int64_t i, int n, Wrap wrap);

/// A coordinate with how far the device's float32 may be from it.
struct Coordinate {
  double u = 0, v = 0;
  double error_u = 0, error_v = 0;
};

/// One thing the device may legally return.
struct Choice {
  std::array<Bounded, 4> value{};
  bool is_exact = true;     ///< the oracle's own decision; false: another texel
  double margin = 0;        ///< texels from the exact coordinate to the border that was crossed; 0 for the exact choice
  double margin_bound = 0;  ///< what that margin may be at most
};

/// How a lookup is done, with its coordinate in texels.
struct LookupPlan {
  const Image* image = nullptr;
  Sampler sampler;
  double x = 0, y = 0;              ///< u·width, v·height
  double bound_x = 0, bound_y = 0;  ///< texels
  bool fixed_point = false;         ///< the 8-bit linear path
  bool useless = false;             ///< a bound exceeds half a texel
};

[[nodiscard]] LookupPlan plan_lookup(const Image& image, const Sampler& sampler, const Coordinate& at, const DeviceModel& device);

[[nodiscard]] Choice nearest_choice(const LookupPlan& plan, std::int64_t i, std::int64_t j, const DeviceModel& device);
[[nodiscard]] Choice linear_choice(const LookupPlan& plan, const DeviceModel& device);
/// The AoS path for the coordinate S/256 (S after the shift by half a texel); `truncating`: the lerp of CPUs without pmulhrsw.
[[nodiscard]] Choice fixed_point_choice(const LookupPlan& plan, std::int64_t s, std::int64_t t, bool truncating);

/// Calls body(choice) for each legal choice, the exact one first, until it returns true; returns whether one did.
/// `widen`: texels added to the margin bound, to ask what lies beyond it. A useless plan offers its exact choice only.
template <class Body>
bool for_each_choice(const LookupPlan& plan, const DeviceModel& device, double widen, Body&& body) {
  if (plan.sampler.filter == Filter::nearest) {
    const auto i0 = static_cast<std::int64_t>(std::floor(plan.x)), j0 = static_cast<std::int64_t>(std::floor(plan.y));
    if (body(nearest_choice(plan, i0, j0, device))) return true;
    if (plan.useless) return false;
    const double reach_x = plan.bound_x + widen, reach_y = plan.bound_y + widen;
    const auto i_lo = static_cast<std::int64_t>(std::floor(plan.x - reach_x)),
               i_hi = static_cast<std::int64_t>(std::floor(plan.x + reach_x));
    const auto j_lo = static_cast<std::int64_t>(std::floor(plan.y - reach_y)),
               j_hi = static_cast<std::int64_t>(std::floor(plan.y + reach_y));
    // One border crossed before two: where a wrap maps both onto one texel, the nearer explanation is the one reported.
    for (std::int64_t i = i_lo; i <= i_hi; ++i) {
      if (i != i0 && body(nearest_choice(plan, i, j0, device))) return true;
    }
    for (std::int64_t j = j_lo; j <= j_hi; ++j) {
      if (j != j0 && body(nearest_choice(plan, i0, j, device))) return true;
    }
    for (std::int64_t j = j_lo; j <= j_hi; ++j) {
      for (std::int64_t i = i_lo; i <= i_hi; ++i) {
        if (i != i0 && j != j0 && body(nearest_choice(plan, i, j, device))) return true;
      }
    }
    return false;
  }
  if (!plan.fixed_point || plan.useless) return body(linear_choice(plan, device));
  const auto s_lo = static_cast<std::int64_t>(std::ceil((plan.x - plan.bound_x) * 256 - 0.5)) - 128;
  const auto s_hi = static_cast<std::int64_t>(std::floor((plan.x + plan.bound_x) * 256 + 0.5)) - 128;
  const auto t_lo = static_cast<std::int64_t>(std::ceil((plan.y - plan.bound_y) * 256 - 0.5)) - 128;
  const auto t_hi = static_cast<std::int64_t>(std::floor((plan.y + plan.bound_y) * 256 + 0.5)) - 128;
  // Beyond a handful of positions the enclosing bound is as good and cheaper.
  if ((s_hi - s_lo + 1) * (t_hi - t_lo + 1) > 16) return body(linear_choice(plan, device));
  for (const bool truncating : {false, true}) {
    for (std::int64_t t = t_lo; t <= t_hi; ++t) {
      for (std::int64_t s = s_lo; s <= s_hi; ++s) {
        if (body(fixed_point_choice(plan, s, t, truncating))) return true;
      }
    }
  }
  return false;
}

}  // namespace etalon::validation
