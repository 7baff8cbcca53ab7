// The measuring code against devices whose answers are known, one freedom changed at a time; then against Mesa's two rasterizers.
#include "validation/probe/device_probe.h"

#include <cmath>

#include <doctest/doctest.h>

#include "tests/validation/probe/simulated_device.h"

using namespace etalon;
using namespace etalon::validation;
using namespace etalon::test;

TEST_CASE("probe: every grid and rounding of a simulated device is found out") {
  for (const int bits : {1, 4, 8, 12, 15}) {
    for (const SnapRounding snap :
         {SnapRounding::nearest_even, SnapRounding::half_up, SnapRounding::half_away, SnapRounding::toward_zero, SnapRounding::floor}) {
      if (bits != 8 && bits != 4 && snap != SnapRounding::half_up) continue;
      CAPTURE(bits);
      CAPTURE(to_string(snap));
      SimulatedDevice device({.subtexel_bits = bits, .snap = snap});
      const CoverageFinding found = probe_coverage(device, {});
      CHECK(found.exact());
      CHECK(found.subtexel_bits == bits);
      CHECK(found.snap == snap);
      CHECK(found.fill_rule == FillRule::left_ymin);
    }
  }
}

TEST_CASE("probe: fill rules, a grid too fine to be seen, and coverage that no rule gives") {
  for (const FillRule rule : {FillRule::left_ymax, FillRule::right_ymin, FillRule::right_ymax}) {
    SimulatedDevice device({.subtexel_bits = 4, .snap = SnapRounding::half_up, .fill_rule = rule});
    const CoverageFinding found = probe_coverage(device, {});
    CHECK(found.fill_rule == rule);
    CHECK(found.subtexel_bits == 4);
    CHECK(found.snap == SnapRounding::half_up);
  }
  SimulatedDevice fine({.subtexel_bits = 16});
  const CoverageFinding unseen = probe_coverage(fine, {});
  CHECK(unseen.subtexel_bits == 16);
  CHECK_FALSE(unseen.snap.has_value());
  SimulatedDevice broken({.subtexel_bits = 8, .dropped_edge_texel = true});
  const CoverageFinding none = probe_coverage(broken, {});
  CHECK_FALSE(none.exact());
  CHECK_FALSE(none.subtexel_bits.has_value());
  CHECK_FALSE(none.fill_rule.has_value());
  CHECK(none.nearest_bits == 8);
  CHECK(none.differing == 24);  // one texel a frame
}

TEST_CASE("probe: the exact rasterizer has hardly any interpolation error, a planted one is measured") {
  SimulatedDevice exact({});
  const InterpolationFinding none = probe_interpolation(exact, {}, 8);
  CHECK(none.samples > 500'000);
  // Storing a float32 is one rounding u; the bound's smallest part is 6u of the value.
  CHECK(none.largest() <= 1.0 / 6);
  SimulatedDevice erring({.interpolation_error = 3});
  const InterpolationFinding three = probe_interpolation(erring, {.interpolation_frames = 4}, 8);
  CHECK(three.affine > 3 - 1.0 / 6);
  CHECK(three.affine < 3 + 1.0 / 6);
  CHECK(three.perspective > 3 - 1.0 / 6);
  CHECK(three.perspective < 3 + 1.0 / 6);
  CHECK(three.depth <= 1.0 / 6);
}

TEST_CASE("probe: nearest lookups with coordinates in fixed point") {
  SimulatedDevice exact({});
  const NearestFinding borders = probe_nearest(exact);
  CHECK(borders.steps);
  CHECK(borders.earliest_texel == 0);
  CHECK(borders.latest_texel == 0);
  CHECK_FALSE(borders.fixed_bits.has_value());
  for (const int bits : {4, 6, 8, 10}) {
    SimulatedDevice device({.coordinate_bits = bits});
    const NearestFinding found = probe_nearest(device);
    CHECK(found.fixed_bits == bits);
    CHECK(found.earliest_texel == -std::ldexp(1.0, -bits - 1));
  }
}

TEST_CASE("probe: the linear filter's weights, rounded and truncated, and results of bytes") {
  for (const ChannelType type : {ChannelType::unorm8, ChannelType::float32}) {
    SimulatedDevice exact({});
    const LinearFinding fine = probe_linear(exact, type);
    CHECK_FALSE(fine.weight_bits.has_value());
    CHECK(fine.largest_weight_error <= 0x1p-24);
    CHECK(fine.value_error_over_model == 0);
    for (const int bits : {4, 8, 9}) {
      for (const bool rounded : {false, true}) {
        CAPTURE(bits);
        SimulatedDevice device({.weight_bits = bits, .weights_rounded = rounded});
        const LinearFinding found = probe_linear(device, type);
        CHECK(found.weight_bits == bits);
        CHECK(found.weights_rounded == rounded);
        CHECK(found.largest_weight_error == doctest::Approx(std::ldexp(1.0, rounded ? -bits - 1 : -bits)).epsilon(0.01));
        CHECK(found.value_error_over_model == 0);
      }
    }
  }
  SimulatedDevice bytes({.weight_bits = 8, .byte_results = true});
  const LinearFinding stepped = probe_linear(bytes, ChannelType::unorm8);
  CHECK(stepped.levels_of_small_step == 2);
  CHECK(stepped.value_error_over_model > 0);
  CHECK(stepped.value_error_over_model <= 0.5 / 255);
  SimulatedDevice fine_results({.weight_bits = 8});
  CHECK(probe_linear(fine_results, ChannelType::unorm8).levels_of_small_step == 257);
}

TEST_CASE("probe: storage") {
  SimulatedDevice nearest({.half_rounding = HalfRounding::nearest_even});
  CHECK(probe_storage(nearest).half == HalfRounding::nearest_even);
  CHECK(probe_storage(nearest).unorm8_nearest == true);
  SimulatedDevice truncating({.half_rounding = HalfRounding::toward_zero});
  CHECK(probe_storage(truncating).half == HalfRounding::toward_zero);
  SimulatedDevice neither({.half_up_halves = true});
  CHECK_FALSE(probe_storage(neither).half.has_value());
}
