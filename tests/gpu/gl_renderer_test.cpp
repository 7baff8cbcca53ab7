// What GlRenderer promises beside the pictures: what it supports, what it refuses, and that it gives the same bytes again.
#include "gpu/gl_renderer.h"

#include <doctest/doctest.h>

#include "core/base/error.h"
#include "tests/gpu/gl_fixture.h"

using namespace etalon;
using namespace etalon::gpu;
using namespace etalon::gpu::test;

namespace {

template <class ErrorType>
std::string refusal(GlRenderer& renderer, const DrawList& list, const Frame& frame) {
  try {
    static_cast<void>(renderer.render(list, frame));
  } catch (const ErrorType& error) {
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

DrawList random_scene(Rng& rng) {
  DrawList list;
  list.images = {std::make_shared<const Image>(random_image(32, 32, kRgba8, rng))};
  for (int i = 0; i < 300; ++i) {
    RasterVertex v;
    v.x = static_cast<std::int32_t>(rng.between(-32 * 256, 160 * 256));
    v.y = static_cast<std::int32_t>(rng.between(-32 * 256, 160 * 256));
    v.z = rng.uniform(0, 1);
    v.w = rng.uniform(0.5f, 2);
    v.uv = {rng.uniform(0, 1), rng.uniform(0, 1)};
    v.color = {rng.uniform(0, 1), rng.uniform(0, 1), rng.uniform(0, 1), 1};
    list.vertices.push_back(v);
  }
  for (std::uint32_t i = 0; i < 300; i += 3) list.triangles.push_back({i, i + 1, i + 2});
  list.draws = {{.first_triangle = 0, .triangle_count = 50, .shading = Shading::vertex_color},
                {.first_triangle = 50, .triangle_count = 50, .shading = Shading::texture, .texture = 0, .sampler = {Filter::linear}}};
  return list;
}

}  // namespace

TEST_CASE("the supported state is the device's own") {
  GlRenderer* renderer = renderer_or_skip("gpu supported state");
  if (renderer == nullptr) return;
  RasterState wanted;
  wanted.subtexel_bits = 12;
  wanted.fill_rule = FillRule::right_ymax;
  wanted.snap = SnapRounding::floor;
  wanted.cull = CullMode::clockwise;
  wanted.depth_test = false;
  const RasterState state = renderer->supported_state(wanted);
  CHECK(state.subtexel_bits == 8);
  CHECK(state.fill_rule == FillRule::left_ymin);
  CHECK(state.half_rounding == renderer->device().half_rounding);
  CHECK(state.snap == SnapRounding::floor);
  CHECK(state.cull == CullMode::clockwise);
  CHECK_FALSE(state.depth_test);
  wanted.subtexel_bits = 4;
  CHECK(renderer->supported_state(wanted).subtexel_bits == 4);
  CHECK(renderer->supported_state(state) == state);
}

TEST_CASE("targets it draws and targets it does not") {
  GlRenderer* renderer = renderer_or_skip("gpu supports");
  if (renderer == nullptr) return;
  for (int channels = 1; channels <= 4; ++channels) {
    for (const ChannelType type : {ChannelType::unorm8, ChannelType::unorm16, ChannelType::half, ChannelType::float32}) {
      CHECK(renderer->supports({TargetContent::color, {type, channels}, {}}));
      CHECK(renderer->supports({TargetContent::coordinate, {type, channels}, {}}) == (channels == 2));
      CHECK(renderer->supports({TargetContent::barycentrics, {type, channels}, {}}) == (channels == 3));
    }
    CHECK_FALSE(renderer->supports({TargetContent::color, {ChannelType::srgb8, channels}, {}}));
    CHECK_FALSE(renderer->supports({TargetContent::color, {ChannelType::uint32, channels}, {}}));
  }
  CHECK(renderer->supports(kIdTarget));
  CHECK(renderer->supports(kDepthTarget));
  CHECK_FALSE(renderer->supports({TargetContent::margins, kRgba32f, {}}));
  CHECK_FALSE(renderer->supports({TargetContent::bound_terms, kRg32f, {}}));
}

TEST_CASE("unsupported targets and states are refused in one line") {
  GlRenderer* renderer = renderer_or_skip("gpu refusals");
  if (renderer == nullptr) return;
  const DrawList list = triangle_list({vertex_at(0, 0), vertex_at(8, 0), vertex_at(0, 8)});
  const Frame good = frame_of(*renderer, 16, 16, 16, {kColorTarget});
  CHECK(refusal<Error>(*renderer, list, good).empty());

  const auto refused = [&](const auto& change) {
    Frame frame = good;
    change(frame);
    const std::string line = refusal<UnavailableError>(*renderer, list, frame);
    CHECK_FALSE(contains(line, "\n"));
    return line;
  };
  CHECK(contains(refused([](Frame& f) {
                   f.targets = {{TargetContent::color, {ChannelType::srgb8, 3}, {}}};
                 }),
                 "does not draw color into rgb srgb8"));
  CHECK(contains(refused([](Frame& f) { f.targets = {{TargetContent::margins, kRgba32f, {}}}; }), "does not draw margins"));
  CHECK(contains(refused([](Frame& f) { f.targets = {{TargetContent::bound_terms, kRg32f, {}}}; }), "does not draw bound_terms"));
  CHECK(contains(refused([](Frame& f) { f.state.subtexel_bits = 9; }), "has 8 sub-texel bits, the frame asks for 9"));
  CHECK(contains(refused([](Frame& f) { f.state.fill_rule = FillRule::left_ymax; }), "the frame asks for left_ymax"));
  CHECK(contains(refused([](Frame& f) { f.targets.assign(9, kColorTarget); }), "at most 8"));

  // Half rounding counts where halves are stored.
  const HalfRounding other =
      renderer->device().half_rounding == HalfRounding::toward_zero ? HalfRounding::nearest_even : HalfRounding::toward_zero;
  Frame half = good;
  half.state.half_rounding = other;
  CHECK(refusal<Error>(*renderer, list, half).empty());
  half.targets = {{TargetContent::color, {ChannelType::half, 4}, {}}};
  CHECK(contains(refusal<UnavailableError>(*renderer, list, half), "rounds halves"));
}

TEST_CASE("what the contract refuses is an InputError before OpenGL sees it") {
  GlRenderer* renderer = renderer_or_skip("gpu input errors");
  if (renderer == nullptr) return;
  const DrawList list = triangle_list({vertex_at(0, 0), vertex_at(8, 0), vertex_at(0, 8)});
  Frame frame = frame_of(*renderer, 16, 16, 16, {kColorTarget});
  frame.width = 16385;
  CHECK_FALSE(refusal<InputError>(*renderer, list, frame).empty());
  frame.width = 0;
  CHECK_FALSE(refusal<InputError>(*renderer, list, frame).empty());
  frame.width = 16;
  frame.guard = 2;
  DrawList outside = list;
  outside.vertices[1].x = 19 * 256;
  CHECK_FALSE(refusal<InputError>(*renderer, outside, frame).empty());
  DrawList no_image = list;
  no_image.draws[0].shading = Shading::texture;
  CHECK_FALSE(refusal<InputError>(*renderer, no_image, frame).empty());
}

TEST_CASE("sizes beyond the device are refused, and drawing goes on after that") {
  GlRenderer* renderer = renderer_or_skip("gpu sizes");
  if (renderer == nullptr) return;
  const int too_wide = renderer->device().limits.max_texture_size_texel + 1;
  REQUIRE(too_wide <= kMaxImageSize);
  const DrawList wide = textured_quad(Image(too_wide, 1, {ChannelType::unorm8, 1}), 16, 16);
  const Frame small = frame_of(*renderer, 16, 16, 16, {kColorTarget});
  CHECK(contains(refusal<UnavailableError>(*renderer, wide, small), "at most 16384 texels a side"));

  for (const PixelFormat format : {kRg32f, kRgba32f}) {
    const Frame huge = frame_of(*renderer, 16384, 16384, 0, {{TargetContent::color, format, {}}});
    CHECK(contains(refusal<UnavailableError>(*renderer, {}, huge), "at most 2^31 - 1 can be addressed"));
  }

  Rng rng(31);
  const Image image = random_image(16, 16, kRgba8, rng);
  CHECK(renderer->render(textured_quad(image, 16, 16), small).front() == image);
}

TEST_CASE("the same list gives the same bytes, again and from a second renderer") {
  GlRenderer* renderer = renderer_or_skip("gpu repeated");
  if (renderer == nullptr) return;
  Rng rng(32);
  const Frame frame =
      frame_of(*renderer, 128, 100, 64,
               {kColorTarget, kIdTarget, kDepthTarget, {TargetContent::color, kRgba32f, {}}, {TargetContent::coordinate, kRg32f, {}}});
  const DrawList list = random_scene(rng);
  const DrawList other = random_scene(rng);
  const std::vector<Image> first = renderer->render(list, frame);
  GlRenderer second;
  CHECK(second.render(other, frame) != first);
  CHECK(renderer->render(list, frame) == first);
  CHECK(second.render(list, frame) == first);
  {
    GlRenderer third;
    CHECK(third.render(list, frame) == first);
  }
  CHECK(renderer->render(list, frame) == first);
}
