#include "gpu/gl_format.h"

#include <array>
#include <limits>

#include <fmt/core.h>

#include "core/base/error.h"

namespace etalon::gpu {

namespace {

constexpr std::array<gl::Enum, 4> kComponents{gl::kRed, gl::kRg, gl::kRgb, gl::kRgba};
constexpr std::array<gl::Enum, 4> kUnorm8{gl::kR8, gl::kRg8, gl::kRgb8, gl::kRgba8};
constexpr std::array<gl::Enum, 4> kUnorm16{gl::kR16, gl::kRg16, gl::kRgb16, gl::kRgba16};
constexpr std::array<gl::Enum, 4> kHalf{gl::kR16f, gl::kRg16f, gl::kRgb16f, gl::kRgba16f};
constexpr std::array<gl::Enum, 4> kFloat32{gl::kR32f, gl::kRg32f, gl::kRgb32f, gl::kRgba32f};
constexpr std::array<gl::Enum, 4> kIntegers{gl::kRedInteger, gl::kRgInteger, gl::kRgbInteger, gl::kRgbaInteger};
constexpr std::array<gl::Enum, 4> kBits8{gl::kR8ui, gl::kRg8ui, gl::kRgb8ui, gl::kRgba8ui};
constexpr std::array<gl::Enum, 4> kBits16{gl::kR16ui, gl::kRg16ui, gl::kRgb16ui, gl::kRgba16ui};
constexpr std::array<gl::Enum, 4> kBits32{gl::kR32ui, gl::kRg32ui, gl::kRgb32ui, gl::kRgba32ui};

}  // namespace

GlFormat texture_format(PixelFormat format) {
  ETALON_CHECK(format.channels >= 1 && format.channels <= 4, to_string(format));
  const auto i = static_cast<std::size_t>(format.channels - 1);
  switch (format.type) {
    case ChannelType::unorm8: return {kUnorm8[i], kComponents[i], gl::kUnsignedByte};
    case ChannelType::unorm16: return {kUnorm16[i], kComponents[i], gl::kUnsignedShort};
    case ChannelType::half: return {kHalf[i], kComponents[i], gl::kHalfFloat};
    case ChannelType::float32: return {kFloat32[i], kComponents[i], gl::kFloat};
    case ChannelType::srgb8:
    case ChannelType::uint32: break;
  }
  ETALON_CHECK(false, to_string(format));
  return {};
}

PixelFormat stored_target_format(PixelFormat format) { return {format.type, format.channels == 3 ? 4 : format.channels}; }

GlFormat target_format(PixelFormat format) {
  if (format == kR32ui) return {gl::kR32ui, gl::kRedInteger, gl::kUnsignedInt};
  return texture_format(stored_target_format(format));
}

GlFormat bits_format(PixelFormat format) {
  ETALON_CHECK(format.channels >= 1 && format.channels <= 4, to_string(format));
  const auto i = static_cast<std::size_t>(format.channels - 1);
  switch (bytes_per_channel(format.type)) {
    case 1: return {kBits8[i], kIntegers[i], gl::kUnsignedByte};
    case 2: return {kBits16[i], kIntegers[i], gl::kUnsignedShort};
    default: return {kBits32[i], kIntegers[i], gl::kUnsignedInt};
  }
}

void require_addressable(int width, int height, PixelFormat stored, const std::string& what) {
  const std::int64_t size_bytes = std::int64_t{width} * height * bytes_per_texel(stored);
  if (size_bytes > std::numeric_limits<std::int32_t>::max()) {
    throw UnavailableError(fmt::format("OpenGL: {}: {} bytes, and at most 2^31 - 1 can be addressed in one image", what, size_bytes));
  }
}

}  // namespace etalon::gpu
