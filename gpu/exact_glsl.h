// The GLSL of the exact mode, in parts that exact_shaders.cpp puts together (docs/exact-shader.md derives what they compute).
// Each part says which names it needs from before it.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace etalon::gpu {

/// Version, the macros LIMBS, HALF_LIMBS and RECORD_WIDTH, the uniform subtexel_bits: the beginning of a fragment shader.
[[nodiscard]] std::string exact_shader_head(int limbs);
[[nodiscard]] std::string joined(std::initializer_list<std::string_view> parts);

/// Signed integers of LIMBS · 32 bits and the leading 32 bits of their quotient. Needs the macros LIMBS, and HALF_LIMBS: the largest
/// power of two below LIMBS. Integer operations only.
extern const std::string_view kGlslIntegers;

/// The sample of a texel, the corners of its triangle, exact edge values; weights and interpolated numbers as enclosures in double and
/// as quotients of integers. Needs kGlslIntegers and the uniform subtexel_bits.
extern const std::string_view kGlslNumbers;

/// The bits of doubles, floats and halves, rounded and taken apart by integer operations.
extern const std::string_view kGlslBits;

/// try_float32(), float32_code(): rounding to float32. Needs kGlslBits, kGlslNumbers.
extern const std::string_view kGlslFloat32;

/// try_store(lo, hi, alpha, code), code_of(double, alpha), code_of(Leading, alpha) and store_scale(alpha) of one target type each.
/// Need kGlslBits, kGlslNumbers; float32: kGlslFloat32; half: the uniform toward_zero; unorm and srgb: kGlslUnorm; srgb: the sampler `tables`.
extern const std::string_view kGlslStoreFloat32;
extern const std::string_view kGlslStoreHalf;
extern const std::string_view kGlslStoreUnorm;
extern const std::string_view kGlslStoreSrgb;

/// Rounding to multiples of 1/SCALE, a macro: 255u or 65535u.
extern const std::string_view kGlslUnorm;

/// try_index(), exact_index(): the texel that holds an interpolated coordinate; wrapped(). Needs kGlslNumbers.
extern const std::string_view kGlslTexelChoice;

/// Linear filtering by doubles: fractions and values enclosed. Needs kGlslTexelChoice.
extern const std::string_view kGlslLinear;

/// Linear filtering by integers: fractions and values as quotients. Needs kGlslTexelChoice and kGlslBits.
extern const std::string_view kGlslExactLinear;

/// Needs the samplers vertices, triangles: fetches the corners of a triangle. Needs kGlslNumbers.
extern const std::string_view kGlslRecords;

}  // namespace etalon::gpu
