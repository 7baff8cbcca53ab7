#include "gpu/gl_texture.h"

#include <algorithm>
#include <bit>

#include <fmt/core.h>

#include "core/base/error.h"
#include "core/draw/draw_list.h"
#include "core/math/srgb.h"
#include "gpu/gl_format.h"

namespace etalon::gpu {

namespace {

gl::Int wrap_mode(Wrap wrap) {
  switch (wrap) {
    case Wrap::clamp: return static_cast<gl::Int>(gl::kClampToEdge);
    case Wrap::repeat: return static_cast<gl::Int>(gl::kRepeat);
    case Wrap::mirrored_repeat: return static_cast<gl::Int>(gl::kMirroredRepeat);
  }
  ETALON_CHECK(false, to_string(wrap));
  return 0;
}

bool has_negative_zero(const Image& image, std::size_t count) {
  if (image.format().type == ChannelType::half) {
    const auto* values = image.channels<std::uint16_t>(0, 0);
    return std::find(values, values + count, std::uint16_t{0x8000}) != values + count;
  }
  const auto* values = image.channels<float>(0, 0);
  return std::any_of(values, values + count, [](float a) { return std::bit_cast<std::uint32_t>(a) == 0x80000000u; });
}

/// Linear float32 texels by canonical(); elsewhere only −0 changes, to +0.
void canonicalise(Image& image, std::size_t count, Filter filter) {
  if (image.format().type == ChannelType::half) {
    auto* values = image.channels<std::uint16_t>(0, 0);
    std::replace(values, values + count, std::uint16_t{0x8000}, std::uint16_t{0});
    return;
  }
  auto* values = image.channels<float>(0, 0);
  for (std::size_t i = 0; i < count; ++i) {
    if (filter == Filter::linear) values[i] = canonical(values[i]);
    if (values[i] == 0) values[i] = 0;
  }
}

Image decoded_srgb(const Image& image) {
  const int channels = image.format().channels;
  Image decoded(image.width(), image.height(), {ChannelType::float32, channels});
  const auto* in = image.channels<std::uint8_t>(0, 0);
  auto* out = decoded.channels<float>(0, 0);
  const std::size_t count = image.texel_count() * static_cast<std::size_t>(channels);
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_alpha = channels == 4 && i % 4 == 3;
    out[i] = is_alpha ? static_cast<float>(in[i] / 255.0) : static_cast<float>(kSrgbDecode[in[i]]);
  }
  return decoded;
}

/// The image as OpenGL shall hold it: `image` itself, or `storage` filled with a changed copy.
const Image& image_for_device(const Image& image, Filter filter, Image& storage) {
  const PixelFormat format = image.format();
  if (format.type == ChannelType::srgb8) return storage = decoded_srgb(image);
  if (format.type != ChannelType::half && format.type != ChannelType::float32) return image;
  const std::size_t count = image.texel_count() * static_cast<std::size_t>(format.channels);
  const bool filtered = format.type == ChannelType::float32 && filter == Filter::linear;
  if (!filtered && !has_negative_zero(image, count)) return image;
  storage = image;
  canonicalise(storage, count, filter);
  return storage;
}

}  // namespace

GlHandle upload_texture(const gl::Api& gl, const Image& image, const Sampler& sampler, int max_size) {
  const std::string what = fmt::format("a {} x {} {} texture", image.width(), image.height(), to_string(image.format()));
  if (image.format().type == ChannelType::uint32) throw UnavailableError(fmt::format("OpenGL: {}: integers cannot be shaded with", what));
  if (image.width() > max_size || image.height() > max_size) {
    throw UnavailableError(fmt::format("OpenGL: {}: this device takes at most {} texels a side", what, max_size));
  }
  Image storage;
  const Image& source = image_for_device(image, sampler.filter, storage);
  require_addressable(source.width(), source.height(), source.format(), what);
  const GlFormat format = texture_format(source.format());

  GlHandle texture = make_texture(gl);
  gl.bind_texture(gl::kTexture2d, texture.id());
  gl.pixel_storei(gl::kUnpackAlignment, 1);
  gl.tex_image_2d(gl::kTexture2d, 0, static_cast<gl::Int>(format.internal), source.width(), source.height(), 0, format.components,
                  format.type, source.bytes().data());
  // The default minification filter wants mipmaps; without them the texture would be incomplete and read as black.
  const auto filter = static_cast<gl::Int>(sampler.filter == Filter::linear ? gl::kLinear : gl::kNearest);
  gl.tex_parameteri(gl::kTexture2d, gl::kTextureBaseLevel, 0);
  gl.tex_parameteri(gl::kTexture2d, gl::kTextureMaxLevel, 0);
  gl.tex_parameteri(gl::kTexture2d, gl::kTextureMinFilter, filter);
  gl.tex_parameteri(gl::kTexture2d, gl::kTextureMagFilter, filter);
  gl.tex_parameteri(gl::kTexture2d, gl::kTextureWrapS, wrap_mode(sampler.wrap_u));
  gl.tex_parameteri(gl::kTexture2d, gl::kTextureWrapT, wrap_mode(sampler.wrap_v));
  gl::check_error(gl, "uploading " + what);
  return texture;
}

}  // namespace etalon::gpu
