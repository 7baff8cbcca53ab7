// Whether a device's doubles are what the exact shader's bounds assume: asked of the device before it draws anything.
#pragma once

#include <string>
#include <vector>

#include "gpu/gl_objects.h"

namespace etalon::gpu {

/// An operation on doubles: in GLSL, of the names a and b, and what it shall give.
struct DoubleOperation {
  std::string name;
  std::string expression;
  double (*expected)(double a, double b);
};

/// Sum, product, quotient, truncation to int and back, and conversion of a float32, as IEEE 754 has them.
[[nodiscard]] std::vector<DoubleOperation> ieee_operations();

/// Computes each operation for 4096 seeded pairs in a fragment shader and compares the bits. UnavailableError, naming the operation and how
/// often it differed, where one does once, or where the shader is refused.
/// Leaves program, textures, viewport, vertex array and framebuffer bindings changed.
void require_operations(const gl::Api& gl, const std::vector<DoubleOperation>& operations, int max_texture_size_texel);

}  // namespace etalon::gpu
