// Source images as OpenGL textures: one level, no mipmaps, stored exactly.
#pragma once

#include "core/draw/state.h"
#include "core/image/image.h"
#include "gpu/gl_objects.h"

namespace etalon::gpu {

/// Uploads `image` to a new GL_TEXTURE_2D, left bound to the active unit, with `sampler`'s filter (min = mag) and wraps.
/// Values are stored as they are, but zeros enter as +0, float32 texels to be filtered by canonical(), as the contract says, and
/// srgb8 as the float32 values of the contract's table (channel 4: float32(i/255)).
/// UnavailableError: uint32 images, sizes above `max_size`, the device's memory is full.
[[nodiscard]] GlHandle upload_texture(const gl::Api& gl, const Image& image, const Sampler& sampler, int max_size);

}  // namespace etalon::gpu
