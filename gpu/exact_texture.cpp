#include "gpu/exact_texture.h"

#include <algorithm>
#include <array>
#include <bit>

#include <fmt/core.h>

#include "core/base/error.h"
#include "core/math/srgb.h"
#include "gpu/gl_format.h"

namespace etalon::gpu {

GlHandle make_bits_texture(const gl::Api& gl, PixelFormat format, int width, int height, const void* data, int max_size,
                           const std::string& what) {
  if (width > max_size || height > max_size)
    throw UnavailableError(fmt::format("OpenGL: {}: this device takes at most {} texels a side", what, max_size));
  require_addressable(width, height, format, what);
  const GlFormat bits = bits_format(format);
  GlHandle texture = make_texture(gl);
  gl.bind_texture(gl::kTexture2d, texture.id());
  gl.pixel_storei(gl::kUnpackAlignment, 1);
  gl.tex_image_2d(gl::kTexture2d, 0, static_cast<gl::Int>(bits.internal), width, height, 0, bits.components, bits.type, data);
  // Integer textures are incomplete with any other filter, and with levels they do not have.
  gl.tex_parameteri(gl::kTexture2d, gl::kTextureBaseLevel, 0);
  gl.tex_parameteri(gl::kTexture2d, gl::kTextureMaxLevel, 0);
  gl.tex_parameteri(gl::kTexture2d, gl::kTextureMinFilter, static_cast<gl::Int>(gl::kNearest));
  gl.tex_parameteri(gl::kTexture2d, gl::kTextureMagFilter, static_cast<gl::Int>(gl::kNearest));
  gl::check_error(gl, "uploading " + what);
  return texture;
}

GlHandle upload_bits(const gl::Api& gl, const Image& image, int max_size) {
  const std::string what = fmt::format("a {} x {} {} texture", image.width(), image.height(), to_string(image.format()));
  return make_bits_texture(gl, image.format(), image.width(), image.height(), image.bytes().data(), max_size, what);
}

GlHandle upload_srgb_tables(const gl::Api& gl, int max_size) {
  std::array<std::uint32_t, 512> tables{};
  const auto bits = [](float value) { return std::bit_cast<std::uint32_t>(value); };
  std::transform(std::begin(kSrgbDecode), std::end(kSrgbDecode), tables.begin(), bits);
  std::transform(std::begin(kSrgbThreshold), std::end(kSrgbThreshold), tables.begin() + 256, bits);
  return make_bits_texture(gl, kR32ui, 256, 2, tables.data(), max_size, "the sRGB tables");
}

}  // namespace etalon::gpu
