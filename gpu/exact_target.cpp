#include "gpu/exact_target.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include <fmt/core.h>

#include "core/base/error.h"
#include "core/math/half.h"
#include "core/math/srgb.h"
#include "gpu/exact_texture.h"
#include "gpu/gl_format.h"

namespace etalon::gpu {

namespace {

/// Ends the set-up of the bound framebuffer, whose colours are drawn into in order.
void complete_framebuffer(const gl::Api& gl, bool two_colors, int width, int height) {
  const std::array<gl::Enum, 2> attachments{gl::kColorAttachment0, gl::kColorAttachment0 + 1};
  gl.draw_buffers(two_colors ? 2 : 1, attachments.data());
  gl.read_buffer(gl::kColorAttachment0);
  gl::check_error(gl, "attaching the targets of the exact shader");
  if (const gl::Enum status = gl.check_framebuffer_status(gl::kFramebuffer); status != gl::kFramebufferComplete) {
    throw UnavailableError(
        fmt::format("OpenGL: the exact shader's framebuffer, {} x {}, is incomplete (0x{:04x}): the device's memory may be full", width,
                    height, status));
  }
}

void attach(const gl::Api& gl, gl::Enum attachment, const GlHandle& buffer) {
  gl.framebuffer_renderbuffer(gl::kFramebuffer, attachment, gl::kRenderbuffer, buffer.id());
}

GlHandle allocate(const gl::Api& gl, gl::Enum internal_format, PixelFormat stored, int width, int height, const std::string& name) {
  const std::string what = fmt::format("a {} x {} {} target", width, height, name);
  require_addressable(width, height, stored, what);
  GlHandle buffer = make_renderbuffer(gl);
  gl.bind_renderbuffer(gl::kRenderbuffer, buffer.id());
  gl.renderbuffer_storage(gl::kRenderbuffer, internal_format, width, height);
  gl::check_error(gl, "allocating " + what);
  return buffer;
}

// x · scale is exact in double: 24 + 16 bits.
std::uint32_t unorm_bits(double x, double scale) {
  const double scaled = std::clamp(x, 0.0, 1.0) * scale;
  const auto whole = static_cast<std::uint32_t>(scaled);
  const double rest = scaled - whole;
  return whole + (rest > 0.5 || (rest == 0.5 && (whole & 1) != 0) ? 1 : 0);
}

}  // namespace

std::uint32_t stored_bits(float value, ChannelType type, bool alpha, HalfRounding rounding) {
  switch (type) {
    case ChannelType::unorm8: return unorm_bits(static_cast<double>(value), 255);
    case ChannelType::unorm16: return unorm_bits(static_cast<double>(value), 65535);
    case ChannelType::srgb8:
      if (alpha) return unorm_bits(static_cast<double>(value), 255);
      return static_cast<std::uint32_t>(std::upper_bound(std::begin(kSrgbThreshold), std::end(kSrgbThreshold), value) -
                                        std::begin(kSrgbThreshold));
    case ChannelType::half: {
      const auto x = static_cast<double>(value);
      const std::uint16_t bits = rounding == HalfRounding::toward_zero ? half_toward_zero(x) : half_nearest_even(x);
      return bits == 0x8000 ? 0 : bits;
    }
    case ChannelType::float32: return value == 0 ? 0 : std::bit_cast<std::uint32_t>(value);
    case ChannelType::uint32: break;
  }
  ETALON_CHECK(false, to_string(type));
  return 0;
}

VisibilityTarget::VisibilityTarget(const gl::Api& gl, int width, int height, int max_size)
    : gl_(gl),
      width_(width),
      height_(height),
      ids_(make_bits_texture(gl, kR32ui, width, height, nullptr, max_size, fmt::format("a {} x {} id target", width, height))),
      depth_(allocate(gl, gl::kDepthComponent32f, kR32f, width, height, "depth")),
      framebuffer_(make_framebuffer(gl)) {
  gl.bind_framebuffer(gl::kFramebuffer, framebuffer_.id());
  gl.framebuffer_texture_2d(gl::kFramebuffer, gl::kColorAttachment0, gl::kTexture2d, ids_.id(), 0);
  attach(gl, gl::kDepthAttachment, depth_);
  complete_framebuffer(gl, false, width, height);
}

void VisibilityTarget::bind_and_clear() const {
  gl_.bind_framebuffer(gl::kFramebuffer, framebuffer_.id());
  const std::array<gl::Uint, 4> none{kNoTriangle, 0, 0, 0};
  gl_.clear_bufferuiv(gl::kColor, 0, none.data());
  const float far_depth = 1;
  gl_.clear_bufferfv(gl::kDepth, 0, &far_depth);
  gl::check_error(gl_, "clearing ids and depths");
}

Image VisibilityTarget::read_ids() const {
  Image image(width_, height_, kR32ui);
  gl_.bind_framebuffer(gl::kFramebuffer, framebuffer_.id());
  gl_.read_pixels(0, 0, width_, height_, gl::kRedInteger, gl::kUnsignedInt, image.bytes().data());
  gl::check_error(gl_, "reading back the ids");
  return image;
}

Image VisibilityTarget::read_depth() const {
  Image image(width_, height_, kR32f);
  gl_.bind_framebuffer(gl::kFramebuffer, framebuffer_.id());
  gl_.read_pixels(0, 0, width_, height_, gl::kDepthComponent, gl::kFloat, image.bytes().data());
  gl::check_error(gl_, "reading back the depths");
  return image;
}

ValueTarget::ValueTarget(const gl::Api& gl, int width, int height, PixelFormat format, bool flags)
    : gl_(gl), width_(width), height_(height), format_(format), framebuffer_(make_framebuffer(gl)) {
  const PixelFormat stored = stored_target_format(format);
  values_ = allocate(gl, bits_format(stored).internal, stored, width, height, to_string(format));
  if (flags) flags_ = allocate(gl, gl::kR32ui, kR32ui, width, height, "flag");
  gl.bind_framebuffer(gl::kFramebuffer, framebuffer_.id());
  attach(gl, gl::kColorAttachment0, values_);
  if (flags) attach(gl, gl::kColorAttachment0 + 1, flags_);
  complete_framebuffer(gl, flags, width, height);
}

void ValueTarget::bind_and_clear(const TargetSpec& spec, HalfRounding rounding) const {
  gl_.bind_framebuffer(gl::kFramebuffer, framebuffer_.id());
  std::array<gl::Uint, 4> clear{};
  for (std::size_t c = 0; c < 4; ++c) clear[c] = stored_bits(spec.clear[c], format_.type, c == 3, rounding);
  gl_.clear_bufferuiv(gl::kColor, 0, clear.data());
  const std::array<gl::Uint, 4> none{};
  if (flags_.id() != 0) gl_.clear_bufferuiv(gl::kColor, 1, none.data());
  gl::check_error(gl_, "clearing a target");
}

Image ValueTarget::read_flags() const {
  Image image(width_, height_, kR32ui);
  gl_.read_buffer(gl::kColorAttachment0 + 1);
  gl_.read_pixels(0, 0, width_, height_, gl::kRedInteger, gl::kUnsignedInt, image.bytes().data());
  gl_.read_buffer(gl::kColorAttachment0);
  gl::check_error(gl_, "reading back the flags");
  return image;
}

Image ValueTarget::read() const {
  Image image(width_, height_, format_);
  const PixelFormat stored = stored_target_format(format_);
  const GlFormat bits = bits_format(stored);
  if (stored == format_) {
    gl_.read_pixels(0, 0, width_, height_, bits.components, bits.type, image.bytes().data());
  } else {
    const auto stored_bytes = static_cast<std::size_t>(bytes_per_texel(stored)),
               texel_bytes = static_cast<std::size_t>(bytes_per_texel(format_));
    std::vector<std::byte> texels(image.texel_count() * stored_bytes);
    gl_.read_pixels(0, 0, width_, height_, bits.components, bits.type, texels.data());
    for (std::size_t i = 0; i < image.texel_count(); ++i)
      std::memcpy(image.bytes().data() + i * texel_bytes, texels.data() + i * stored_bytes, texel_bytes);
  }
  gl::check_error(gl_, fmt::format("reading back a {} target", to_string(format_)));
  return image;
}

}  // namespace etalon::gpu
