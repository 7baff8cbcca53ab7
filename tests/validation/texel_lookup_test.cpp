#include "validation/texel_lookup.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/base/rng.h"
#include "raster/cpu_renderer.h"
#include "tests/validation/scenes.h"

namespace etalon::validation {
namespace {

TEST_CASE("wraps are those of the contract, far out on both sides") {
  for (const int n : {1, 2, 3, 5, 8}) {
    for (std::int64_t i = -40; i <= 40; ++i) {
      CHECK(wrap_index(i, n, Wrap::clamp) == std::min<std::int64_t>(std::max<std::int64_t>(i, 0), n - 1));
      std::int64_t repeat = i;
      while (repeat < 0) repeat += n;
      while (repeat >= n) repeat -= n;
      CHECK(wrap_index(i, n, Wrap::repeat) == repeat);
      // Mirror: walk from 0 and turn round at the ends, each end texel twice.
      std::int64_t at = 0, step = 1;
      for (std::int64_t k = 0; k < std::abs(i < 0 ? i + 1 : i); ++k) {
        if (at + step < 0 || at + step >= n) {
          step = -step;
        } else {
          at += step;
        }
      }
      CHECK(wrap_index(i, n, Wrap::mirrored_repeat) == at);
    }
  }
}

TEST_CASE("nearest offers the texels within the bound and no other, the exact one first") {
  const auto image = test::busy_texture(16, 16);
  const DeviceModel device = llvmpipe_model();
  const auto offered = [&](double u, double v, double error) {
    std::vector<Choice> choices;
    const LookupPlan plan = plan_lookup(*image, {}, {u, v, error, error}, device);
    for_each_choice(plan, device, 0, [&](const Choice& c) {
      choices.push_back(c);
      return false;
    });
    return choices;
  };
  CHECK(offered(5.5 / 16, 7.5 / 16, 1e-6).size() == 1);
  const auto side = offered(6.00001 / 16, 7.5 / 16, 1e-6);
  REQUIRE(side.size() == 2);
  CHECK(side[0].is_exact);
  CHECK(side[0].value[0].value == doctest::Approx(texel_value(*image, 6, 7, 0)));
  CHECK_FALSE(side[1].is_exact);
  CHECK(side[1].value[0].value == doctest::Approx(texel_value(*image, 5, 7, 0)));
  CHECK(side[1].margin == doctest::Approx(0.00001).epsilon(0.01));
  CHECK(side[1].margin < side[1].margin_bound);
  CHECK(offered(6.0 / 16, 8.0 / 16, 1e-6).size() == 4);
  CHECK(offered(6.0 / 16, 8.0 / 16, 0.04).size() == 1);  // half a texel and more: useless, the exact choice only
  CHECK(plan_lookup(*image, {}, {0.3, 0.3, 0.04, 0}, device).useless);
}

TEST_CASE("the linear value is the renderer's, and its bound holds for moved coordinates") {
  Rng rng(12);
  for (const PixelFormat format : {kRgba8, PixelFormat{ChannelType::float32, 2}}) {
    const auto image = test::busy_texture(7, 5, format);
    for (const Wrap wrap : {Wrap::clamp, Wrap::repeat, Wrap::mirrored_repeat}) {
      const Sampler sampler{Filter::linear, wrap, wrap};
      // One texel whose coordinate is exact: a frame of one texel, uv equal at all vertices.
      for (int n = 0; n < 200; ++n) {
        const Vec2f uv(rng.uniform(-2, 2), rng.uniform(-2, 2));
        const DrawList list = test::quad(1, 1, uv, uv, image, sampler);
        const Frame frame = test::frame_of(1, 1, {{TargetContent::color, kRgba32f}});
        raster::CpuRenderer cpu;
        const auto drawn = cpu.render(list, frame);
        const Choice choice = linear_choice(
            plan_lookup(*image, sampler, {static_cast<double>(uv.x), static_cast<double>(uv.y), 0, 0}, contract_model()), contract_model());
        for (int c = 0; c < 4; ++c) {
          const double value = choice.value[static_cast<std::size_t>(c)].value;
          CHECK(std::abs(static_cast<double>(drawn[0].channels<float>(0, 0)[c]) - value) <= 0x1p-24 * std::abs(value) * 1.001 + 1e-15);
        }
        // A coordinate anywhere within the error gives a value within the bound.
        const double error = 0.02 * rng.unit();
        const Choice bounded = linear_choice(
            plan_lookup(*image, sampler, {static_cast<double>(uv.x), static_cast<double>(uv.y), error, error}, llvmpipe_model()),
            llvmpipe_model());
        for (int m = 0; m < 8; ++m) {
          const double u = static_cast<double>(uv.x) + error * (2 * rng.unit() - 1),
                       v = static_cast<double>(uv.y) + error * (2 * rng.unit() - 1);
          const Choice moved = linear_choice(plan_lookup(*image, sampler, {u, v, 0, 0}, contract_model()), contract_model());
          for (std::size_t c = 0; c < 4; ++c) CHECK(std::abs(moved.value[c].value - bounded.value[c].value) <= bounded.value[c].bound);
        }
      }
    }
  }
}

TEST_CASE("the fixed-point path stays within the bound that encloses it: 2 units and the slope over 1/512 texel") {
  Rng rng(13);
  const auto image = test::busy_texture(16, 16);
  const DeviceModel device = llvmpipe_model();
  const Sampler sampler{Filter::linear, Wrap::repeat, Wrap::repeat};
  double largest = 0;
  for (int n = 0; n < 20000; ++n) {
    const LookupPlan plan = plan_lookup(*image, sampler, {rng.unit(), rng.unit(), 1e-7, 1e-7}, device);
    REQUIRE(plan.fixed_point);
    const Choice enclosing = linear_choice(plan, device);
    int offered = 0;
    for_each_choice(plan, device, 0, [&](const Choice& choice) {
      ++offered;
      for (std::size_t c = 0; c < 4; ++c) {
        const double share = std::abs(choice.value[c].value - enclosing.value[c].value) / enclosing.value[c].bound;
        REQUIRE(share <= 1);
        largest = std::max(largest, share);
      }
      return false;
    });
    REQUIRE(offered >= 2);  // both kinds of lerp
  }
  CHECK(largest > 0.4);
}

TEST_CASE("srgb: gallivm's polynomial keeps every byte on its own side of the thresholds") {
  Image texel(1, 1, {ChannelType::srgb8, 4});
  for (int k = 0; k < 256; ++k) {
    texel.channels<std::uint8_t>(0, 0)[0] = static_cast<std::uint8_t>(k);
    const Bounded value = device_texel(texel, 0, 0, 0, llvmpipe_model());
    CHECK(std::abs(srgb_polynomial_decode(k) - value.value) <= value.bound);
    CHECK(value.bound < 0.004);
    CHECK(check_stored(reinterpret_cast<const std::byte*>(texel.texel(0, 0)), texel.format(), 0, HalfRounding::nearest_even,
                       {srgb_polynomial_decode(k), 0}, llvmpipe_model())
              .legal);
  }
}

}  // namespace
}  // namespace etalon::validation
