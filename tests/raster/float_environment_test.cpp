// The bytes do not depend on the floating-point environment of whoever calls, nor on when the worker threads were started.
#include <doctest/doctest.h>

#include <cfenv>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include "raster/sample_query.h"
#include "tests/raster/draw_helpers.h"

using namespace etalon;
using namespace etalon::test;

namespace {

// Numbers that rounding modes and flushed subnormals would change: thirds, and a texel of 2^-130.
DrawList make_sensitive_list() {
  DrawList list = list_of(quad(0, 0, 3, 3), Shading::texture);
  for (std::size_t n = 0; n < list.vertices.size(); ++n) list.vertices[n].z = 0.1f + 0.07f * static_cast<float>(n);
  auto texture = std::make_shared<Image>(1, 1, kR32f);
  texture->channels<float>(0, 0)[0] = 0x1p-130f;
  list.images = {texture};
  list.draws[0].texture = 0;
  return list;
}

// Made once, in the default environment.
const DrawList& sensitive_list() {
  static const DrawList kList = make_sensitive_list();
  return kList;
}

const Frame& sensitive_frame() {
  static const Frame kFrame = frame_of(3, 3,
                                       {{TargetContent::color, kR32f},
                                        {TargetContent::depth, kR32f},
                                        {TargetContent::coordinate, kRg32f},
                                        {TargetContent::barycentrics, {ChannelType::float32, 3}}});
  return kFrame;
}

std::vector<Image> rendered() {
  raster::CpuRenderer renderer;
  return renderer.render(sensitive_list(), sensitive_frame());
}

std::vector<Image> queried() {
  const raster::SampleQuery query(sensitive_list(), sensitive_frame());
  std::vector<Image> images;
  for (const TargetSpec& target : sensitive_frame().targets) images.emplace_back(3, 3, target.format);
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) {
      std::vector<std::byte*> texels;
      for (Image& image : images) texels.push_back(image.texel(i, j));
      query.store(query.covers(0, i, j) ? 0 : 1, i, j, texels.data());
    }
  return images;
}

}  // namespace

TEST_CASE("rounding modes of the caller change no byte, and are still there afterwards") {
  const std::vector<Image> expected = rendered();
  CHECK(*expected[0].channels<std::uint32_t>(0, 0) == 0x00080000u);
  CHECK(queried() == expected);
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    REQUIRE(std::fesetround(mode) == 0);
    const std::vector<Image> images = rendered(), samples = queried();
    const int after = std::fegetround();
    std::fesetround(FE_TONEAREST);
    CHECK(after == mode);
    CHECK(images == expected);
    CHECK(samples == expected);
  }
}

#if defined(__SSE2__)
TEST_CASE("flushed subnormals, as -Ofast sets them at start, change no byte") {
  const std::vector<Image> expected = rendered();
  const unsigned before = _mm_getcsr();
  _mm_setcsr(before | 0x8040);  // FTZ and DAZ
  const std::vector<Image> images = rendered(), samples = queried();
  _mm_setcsr(before);
  CHECK(images == expected);
  CHECK(samples == expected);
}
#endif
