// Mesa's second rasterizer, in a process of its own: other sub-texel bits, another fill rule, the same renderer.
// Its edges are evaluated in float32, so no exact coverage is claimed for it.
#include <memory>
#include <utility>

#include <doctest/doctest.h>

#include "core/base/error.h"
#include "gpu/gl_renderer.h"
#include "tests/gpu/gl_fixture.h"
#include "tests/support/skip.h"

using namespace etalon;
using namespace etalon::gpu;
using namespace etalon::gpu::test;

namespace {

std::unique_ptr<GlRenderer> softpipe_or_skip(const std::string& test_case) {
  try {
    return std::make_unique<GlRenderer>(ContextOptions{.driver = Driver::softpipe});
  } catch (const UnavailableError& error) {
    etalon::test::report_skip(test_case, error.what());
    return nullptr;
  }
}

}  // namespace

TEST_CASE("softpipe has a state of its own and refuses llvmpipe's") {
  const std::unique_ptr<GlRenderer> renderer = softpipe_or_skip("softpipe state");
  if (!renderer) return;
  CHECK(renderer->device().renderer == "softpipe");
  CHECK_FALSE(renderer->device().snap.has_value());
  const RasterState state = renderer->supported_state({});
  CHECK(state.subtexel_bits == 4);
  Frame frame;
  frame.width = frame.height = 16;
  frame.guard = 16;
  frame.targets = {kColorTarget};
  CHECK_THROWS_AS(static_cast<void>(renderer->render({}, frame)), UnavailableError);
  frame.state = state;
  CHECK_NOTHROW(static_cast<void>(renderer->render({}, frame)));
}

TEST_CASE("softpipe has no doubles in shaders: no exact mode, in words") {
  if (!softpipe_or_skip("softpipe exact")) return;
  std::string line;
  try {
    const GlRenderer renderer(ContextOptions{.driver = Driver::softpipe}, ShaderMode::exact);
  } catch (const UnavailableError& error) {
    line = error.what();
  }
  CHECK(line.find("the exact shader needs version 4.0, for doubles in shaders") != std::string::npos);
  CHECK(line.find("gives 3.3") != std::string::npos);
}

TEST_CASE("softpipe copies a texture and fills all targets") {
  const std::unique_ptr<GlRenderer> renderer = softpipe_or_skip("softpipe copy");
  if (!renderer) return;
  Rng rng(41);
  const Image image = random_image(32, 32, kRgba8, rng);
  DrawList list = textured_quad(image, 32, 32);
  for (RasterVertex& v : list.vertices) {
    v.x /= 16;  // from 8 sub-texel bits to 4
    v.y /= 16;
    v.z = 0.5f;
  }
  const Frame frame = frame_of(*renderer, 32, 32, 16, {kColorTarget, kIdTarget, kDepthTarget});
  REQUIRE(frame.state.subtexel_bits == 4);
  const std::vector<Image> images = renderer->render(list, frame);
  CHECK(images[0] == image);
  CHECK(*images[1].channels<std::uint32_t>(20, 3) == 0);
  CHECK(*images[1].channels<std::uint32_t>(3, 20) == 1);
  CHECK(*images[2].channels<float>(20, 3) == 0.5f);
}

TEST_CASE("ids stay right beyond one batch of softpipe's vertices") {
  const std::unique_ptr<GlRenderer> renderer = softpipe_or_skip("softpipe ids");
  if (!renderer) return;
  // One triangle around each of 64 × 64 centres, in 4 sub-texel bits.
  DrawList list;
  for (std::int32_t n = 0; n < 64 * 64; ++n) {
    const std::int32_t x = n % 64 * 16, y = n / 64 * 16;
    const auto first = static_cast<std::uint32_t>(list.vertices.size());
    for (const auto& [dx, dy] : {std::pair{0, 0}, std::pair{16, 0}, std::pair{8, 16}}) {
      RasterVertex v;
      v.x = x + dx, v.y = y + dy, v.z = 0.5f;
      list.vertices.push_back(v);
    }
    list.triangles.push_back({first, first + 1, first + 2});
  }
  list.draws = {{.triangle_count = 64 * 64}};
  const Image ids = renderer->render(list, frame_of(*renderer, 64, 64, 16, {kIdTarget}))[0];
  std::uint32_t wrong = 0;
  for (std::uint32_t n = 0; n < 64 * 64; ++n) wrong += ids.channels<std::uint32_t>(0, 0)[n] != n ? 1 : 0;
  CHECK(wrong == 0);
}
