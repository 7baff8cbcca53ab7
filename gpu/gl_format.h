// Pixel formats in OpenGL's words, for textures (sources) and renderbuffers (targets).
#pragma once

#include <string>

#include "core/image/pixel_format.h"
#include "gpu/gl_api.h"

namespace etalon::gpu {

/// How OpenGL stores a format and how client memory holds it.
struct GlFormat {
  gl::Enum internal = gl::kNone;
  gl::Enum components = gl::kNone;  ///< GL_RED .. GL_RGBA
  gl::Enum type = gl::kNone;        ///< GL_UNSIGNED_BYTE ..
};

/// Exact storage of a source: unorm8, unorm16, half, float32 with 1..4 channels. Other types are an InternalError: callers convert
/// or refuse them.
[[nodiscard]] GlFormat texture_format(PixelFormat format);

/// A format that OpenGL 3.3 must be able to draw into and that holds `format`'s channels: as above, R uint32 too; three channels
/// are stored as four, since RGB need not be renderable.
[[nodiscard]] PixelFormat stored_target_format(PixelFormat format);
[[nodiscard]] GlFormat target_format(PixelFormat format);

/// The bits of each channel as an unsigned integer of its size, for sources and targets; targets of three channels are stored as four.
[[nodiscard]] GlFormat bits_format(PixelFormat format);

/// UnavailableError, naming `what`, where an image takes 2^31 bytes or more on the device: Mesa 22.3 computes offsets into an image as int,
/// and glReadPixels of a 16384 x 16384 RG32F target (2^31 bytes) was seen to crash instead of reporting an error.
void require_addressable(int width, int height, PixelFormat stored, const std::string& what);

}  // namespace etalon::gpu
