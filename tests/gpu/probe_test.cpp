// The device describes itself, and drawing shows what it does not say.
#include "gpu/probe.h"

#include <doctest/doctest.h>

#include "tests/gpu/gl_fixture.h"

using namespace etalon;
using namespace etalon::gpu;
using namespace etalon::gpu::test;

TEST_CASE("what llvmpipe is and does") {
  GlRenderer* renderer = renderer_or_skip("gpu probe");
  if (renderer == nullptr) return;
  const DeviceInfo& device = renderer->device();
  CHECK(device.renderer.rfind("llvmpipe", 0) == 0);
  CHECK_FALSE(device.vendor.empty());
  CHECK_FALSE(device.mesa_version.empty());
  CHECK(device.version.find(device.mesa_version) != std::string::npos);
  CHECK(renderer->name() == device.renderer + ", Mesa " + device.mesa_version);
  CHECK(device.subtexel_bits == 8);
  CHECK(device.fill_rule == FillRule::left_ymin);
  CHECK(device.snap == SnapRounding::nearest_even);
  CHECK(device.limits.max_target_size_texel >= 16384);
  CHECK(device.limits.max_viewport_width_texel >= 16384);
  CHECK(device.limits.max_color_targets >= 8);
}

TEST_CASE("the probed half rounding is the one that storing shows") {
  GlRenderer* renderer = renderer_or_skip("gpu half rounding");
  if (renderer == nullptr) return;
  // A quarter and three quarters of the step above 2048: 2 per step, so 2048.5 and 2049.5.
  const Frame frame = frame_of(*renderer, 4, 4, 4, {{TargetContent::color, {ChannelType::half, 2}, {}}});
  const Vec4f color{2048.5f, 2049.5f, 0, 0};
  const DrawList list = triangle_list({vertex_at(0, 0, {0, 0}, color), vertex_at(8, 0, {0, 0}, color), vertex_at(0, 8, {0, 0}, color)});
  const Image image = renderer->render(list, frame).front();
  constexpr std::uint16_t kHalf2048 = 0x6800;
  CHECK(image.channels<std::uint16_t>(1, 1)[0] == kHalf2048);
  const bool rounds_up = image.channels<std::uint16_t>(1, 1)[1] == kHalf2048 + 1;
  CHECK(rounds_up == (renderer->device().half_rounding == HalfRounding::nearest_even));
}

TEST_CASE("a probe of its own finds the same") {
  GlRenderer* renderer = renderer_or_skip("gpu second probe");
  if (renderer == nullptr) return;
  const std::unique_ptr<Context> context = make_context();
  const DeviceInfo again = probe(*context);
  CHECK(again.name() == renderer->name());
  CHECK(again.fill_rule == renderer->device().fill_rule);
  CHECK(again.half_rounding == renderer->device().half_rounding);
}
