// Lookups: identity copies in every format, wraps, filters, the indexed lookup.
#include <bit>
#include <cmath>
#include <cstring>

#include <doctest/doctest.h>

#include "core/math/srgb.h"
#include "tests/gpu/gl_fixture.h"

using namespace etalon;
using namespace etalon::gpu;
using namespace etalon::gpu::test;

namespace {

Image draw_color(GlRenderer& renderer, const DrawList& list, int width, int height, PixelFormat format) {
  Frame frame = frame_of(renderer, width, height, 16, {{TargetContent::color, format, {}}});
  return renderer.render(list, frame).front();
}

/// The contract's wrap of an integer index.
int wrapped(int i, int n, Wrap wrap) {
  const auto modulo = [](int a, int m) { return ((a % m) + m) % m; };
  switch (wrap) {
    case Wrap::clamp: return std::min(std::max(i, 0), n - 1);
    case Wrap::repeat: return modulo(i, n);
    case Wrap::mirrored_repeat: {
      const int a = modulo(i, 2 * n) - n;
      return (n - 1) - (a >= 0 ? a : -(1 + a));
    }
  }
  return -1;
}

}  // namespace

TEST_CASE("a nearest copy at one texel per texel keeps every byte, in every format") {
  GlRenderer* renderer = renderer_or_skip("gpu identity copy");
  if (renderer == nullptr) return;
  Rng rng(11);
  for (const ChannelType type : {ChannelType::unorm8, ChannelType::unorm16, ChannelType::half, ChannelType::float32}) {
    for (int channels = 1; channels <= 4; ++channels) {
      for (const auto& [width, height] : {std::pair{64, 64}, std::pair{101, 37}}) {
        const PixelFormat format{type, channels};
        CAPTURE(to_string(format));
        const Image image = random_image(width, height, format, rng);
        CHECK(draw_color(*renderer, textured_quad(image, width, height), width, height, format) == image);
      }
    }
  }
}

TEST_CASE("absent channels read 0, 0, 1") {
  GlRenderer* renderer = renderer_or_skip("gpu absent channels");
  if (renderer == nullptr) return;
  Rng rng(12);
  for (int channels = 1; channels <= 4; ++channels) {
    const Image image = random_image(8, 8, {ChannelType::float32, channels}, rng);
    const Image drawn = draw_color(*renderer, textured_quad(image, 8, 8), 8, 8, kRgba32f);
    for (int c = 0; c < 4; ++c) {
      const float expected = c < channels ? image.channels<float>(5, 3)[c] : c == 3 ? 1.0f : 0.0f;
      CHECK(drawn.channels<float>(5, 3)[c] == expected);
    }
  }
}

TEST_CASE("zeros enter as plus zero, and what is tiny does where it is filtered") {
  GlRenderer* renderer = renderer_or_skip("gpu zeros");
  if (renderer == nullptr) return;
  Image image(4, 4, kR32f);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) *image.channels<float>(x, y) = (x + y) % 2 == 0 ? -0.0f : 0x1p-41f;
  }
  const Image nearest = draw_color(*renderer, textured_quad(image, 4, 4), 4, 4, kR32f);
  const Image linear = draw_color(*renderer, textured_quad(image, 4, 4, {.filter = Filter::linear}), 4, 4, kR32f);
  CHECK(std::bit_cast<std::uint32_t>(*nearest.channels<float>(0, 0)) == 0);
  CHECK(*nearest.channels<float>(1, 0) == 0x1p-41f);
  for (const std::byte byte : linear.bytes()) CHECK(byte == std::byte{0});

  Image half(4, 4, {ChannelType::half, 1});
  std::fill_n(half.channels<std::uint16_t>(0, 0), 16, std::uint16_t{0x8000});
  const Image half_zeros = draw_color(*renderer, textured_quad(half, 4, 4), 4, 4, half.format());
  for (const std::byte byte : half_zeros.bytes()) CHECK(byte == std::byte{0});
}

TEST_CASE("srgb8 textures decode by the contract's table") {
  GlRenderer* renderer = renderer_or_skip("gpu srgb texture");
  if (renderer == nullptr) return;
  Image image(16, 16, {ChannelType::srgb8, 4});
  for (std::size_t i = 0; i < image.bytes().size(); ++i) image.bytes()[i] = static_cast<std::byte>(i / 4);
  const Image drawn = draw_color(*renderer, textured_quad(image, 16, 16), 16, 16, kRgba32f);
  for (int i = 0; i < 256; ++i) {
    const auto* texel = drawn.channels<float>(i % 16, i / 16);
    CHECK(texel[0] == kSrgbDecode[i]);
    CHECK(texel[2] == kSrgbDecode[i]);
    CHECK(texel[3] == static_cast<float>(i / 255.0));
  }
}

TEST_CASE("wraps act on the texel index") {
  GlRenderer* renderer = renderer_or_skip("gpu wraps");
  if (renderer == nullptr) return;
  Rng rng(13);
  constexpr int kTextureWidth = 8;
  constexpr int kTextureHeight = 5;
  constexpr int kFrameSize = 40;
  const Image image = random_image(kTextureWidth, kTextureHeight, kRgba8, rng);
  for (const Wrap wrap_u : {Wrap::clamp, Wrap::repeat, Wrap::mirrored_repeat}) {
    for (const Wrap wrap_v : {Wrap::clamp, Wrap::repeat, Wrap::mirrored_repeat}) {
      DrawList list;
      list.images.push_back(std::make_shared<const Image>(image));
      // u from −2 to 3 is texel −16 to 24, v from −3 to 5 texel −15 to 25: one texel of the texture per texel of the frame.
      add_quad(list, {0, 0}, {kFrameSize, kFrameSize}, {-2, -3}, {3, 5},
               {.shading = Shading::texture, .texture = 0, .sampler = {Filter::nearest, wrap_u, wrap_v}});
      const Image drawn = draw_color(*renderer, list, kFrameSize, kFrameSize, kRgba8);
      int bad = 0;
      for (int y = 0; y < kFrameSize; ++y) {
        for (int x = 0; x < kFrameSize; ++x) {
          const std::byte* expected = image.texel(wrapped(x - 16, kTextureWidth, wrap_u), wrapped(y - 15, kTextureHeight, wrap_v));
          bad += std::memcmp(drawn.texel(x, y), expected, 4) != 0 ? 1 : 0;
        }
      }
      CHECK(bad == 0);
    }
  }
}

TEST_CASE("linear filtering weighs the four texels around the sample") {
  GlRenderer* renderer = renderer_or_skip("gpu linear");
  if (renderer == nullptr) return;
  // 4 × 2 texels on 32 × 16: uv, weights and products are dyadic with few bits, so float32 in any order of evaluation is exact.
  Image image(4, 2, kR32f);
  for (int i = 0; i < 8; ++i) image.channels<float>(0, 0)[i] = static_cast<float>(256 * (i * i % 7));
  const Image drawn = draw_color(*renderer, textured_quad(image, 32, 16, {.filter = Filter::linear}), 32, 16, kR32f);
  int bad = 0;
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 32; ++x) {
      const double u = (x + 0.5) / 8 - 0.5;
      const double v = (y + 0.5) / 8 - 0.5;
      const int i = static_cast<int>(std::floor(u));
      const int j = static_cast<int>(std::floor(v));
      const auto texel = [&](int a, int b) {
        return double{*image.channels<float>(wrapped(a, 4, Wrap::clamp), wrapped(b, 2, Wrap::clamp))};
      };
      const double f = u - i;
      const double g = v - j;
      const double expected =
          (1 - f) * (1 - g) * texel(i, j) + f * (1 - g) * texel(i + 1, j) + (1 - f) * g * texel(i, j + 1) + f * g * texel(i + 1, j + 1);
      bad += *drawn.channels<float>(x, y) != expected ? 1 : 0;
    }
  }
  CHECK(bad == 0);
}

TEST_CASE("an indexed lookup reads the texture where the map says") {
  GlRenderer* renderer = renderer_or_skip("gpu indexed");
  if (renderer == nullptr) return;
  Rng rng(14);
  constexpr int kWidth = 64;
  constexpr int kHeight = 32;
  const Image image = random_image(kWidth, kHeight, kRgba8, rng);
  for (const PixelFormat map_format : {kRg32f, PixelFormat{ChannelType::float32, 4}, PixelFormat{ChannelType::unorm16, 2}}) {
    Image map(kWidth, kHeight, map_format);
    Image expected(kWidth, kHeight, kRgba8);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const int column = static_cast<int>(rng.below(kWidth));
        const int row = static_cast<int>(rng.below(kHeight));
        const double u = (column + 0.5) / kWidth;
        const double v = (row + 0.5) / kHeight;
        if (map_format.type == ChannelType::float32) {
          map.channels<float>(x, y)[0] = static_cast<float>(u);
          map.channels<float>(x, y)[1] = static_cast<float>(v);
        } else {
          map.channels<std::uint16_t>(x, y)[0] = static_cast<std::uint16_t>(std::lround(u * 65535));
          map.channels<std::uint16_t>(x, y)[1] = static_cast<std::uint16_t>(std::lround(v * 65535));
        }
        std::memcpy(expected.texel(x, y), image.texel(column, row), 4);
      }
    }
    DrawList list;
    list.images = {std::make_shared<const Image>(image), std::make_shared<const Image>(map)};
    add_quad(list, {0, 0}, {kWidth, kHeight}, {0, 0}, {1, 1}, {.shading = Shading::indexed, .texture = 0, .indexing_map = 1});
    CHECK(draw_color(*renderer, list, kWidth, kHeight, kRgba8) == expected);
  }
}

TEST_CASE("draws of one list keep their own shading, texture and sampler") {
  GlRenderer* renderer = renderer_or_skip("gpu several draws");
  if (renderer == nullptr) return;
  Rng rng(15);
  const Image a = random_image(8, 8, kRgba8, rng);
  const Image b = random_image(8, 8, kRgba8, rng);
  DrawList list;
  list.images = {std::make_shared<const Image>(a), std::make_shared<const Image>(b)};
  add_quad(list, {0, 0}, {8, 8}, {0, 0}, {1, 1}, {.shading = Shading::texture, .texture = 0});
  add_quad(list, {8, 0}, {16, 8}, {0, 0}, {1, 1}, {.shading = Shading::texture, .texture = 1});
  add_quad(list, {16, 0}, {24, 8}, {0, 0}, {1, 1}, {.shading = Shading::vertex_color});
  add_quad(list, {24, 0}, {32, 8}, {1, 0}, {2, 1},
           {.shading = Shading::texture, .texture = 0, .sampler = {Filter::nearest, Wrap::repeat, Wrap::clamp}});
  add_quad(list, {32, 0}, {40, 8}, {1, 0}, {2, 1}, {.shading = Shading::texture, .texture = 0});
  const Image drawn = draw_color(*renderer, list, 40, 8, kRgba8);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      CHECK(std::memcmp(drawn.texel(x, y), a.texel(x, y), 4) == 0);
      CHECK(std::memcmp(drawn.texel(8 + x, y), b.texel(x, y), 4) == 0);
      const std::array<std::uint8_t, 4> black{0, 0, 0, 255};
      CHECK(std::memcmp(drawn.texel(16 + x, y), black.data(), 4) == 0);
      CHECK(std::memcmp(drawn.texel(24 + x, y), a.texel(x, y), 4) == 0);
      CHECK(std::memcmp(drawn.texel(32 + x, y), a.texel(7, y), 4) == 0);
    }
  }
}
