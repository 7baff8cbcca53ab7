// Integer textures for the exact mode: images by their stored bits, and the tables of the sRGB curve. Read by texelFetch only.
#pragma once

#include "core/image/image.h"
#include "gpu/gl_objects.h"

namespace etalon::gpu {

/// A new GL_TEXTURE_2D of one level, left bound to the active unit; `data` as `format`'s channels lie in memory, nullptr for undefined
/// texels. UnavailableError, naming `what`: larger than `max_size` a side, or the device's memory is full.
[[nodiscard]] GlHandle make_bits_texture(const gl::Api& gl, PixelFormat format, int width, int height, const void* data, int max_size,
                                         const std::string& what);

/// The image's stored bits, unchanged. UnavailableError as above.
[[nodiscard]] GlHandle upload_bits(const gl::Api& gl, const Image& image, int max_size);

/// 256 × 2 texels of float32 bits: row 0 what each sRGB byte means, row 1 the thresholds T_1 .. T_255, then 0.
[[nodiscard]] GlHandle upload_srgb_tables(const gl::Api& gl, int max_size);

}  // namespace etalon::gpu
