#include "gpu/exact_probe.h"

#include <bit>

#include <fmt/core.h>

#include "core/base/error.h"
#include "core/base/rng.h"
#include "gpu/exact_shaders.h"
#include "gpu/exact_target.h"
#include "gpu/exact_texture.h"

namespace etalon::gpu {

namespace {

constexpr int kSize = 64;
constexpr PixelFormat kWords{ChannelType::uint32, 4};

struct Pair {
  double a, b;
};

// Numbers as the exact shader has them: 53-bit mantissas, exponents far from overflow and underflow, both signs.
double operand(Rng& rng) {
  const std::uint64_t mantissa_and_sign = rng.next() & 0x800FFFFFFFFFFFFFull;
  return std::bit_cast<double>(mantissa_and_sign | static_cast<std::uint64_t>(rng.between(1023 - 90, 1023 + 90)) << 52);
}

std::vector<Pair> seeded_pairs() {
  Rng rng(2026);
  std::vector<Pair> pairs(static_cast<std::size_t>(kSize) * kSize);
  for (Pair& pair : pairs) {
    pair.a = operand(rng);
    pair.b = operand(rng);
    if (rng.below(4) == 0) pair.b = -pair.a * (1 + 0x1p-30 * rng.unit());  // a sum that cancels
  }
  return pairs;
}

// The high word of a, and a float32 in [2, 2^33) made of it.
std::int32_t high_word(double a) { return static_cast<std::int32_t>(std::bit_cast<std::uint64_t>(a) >> 32); }
float float_of(double a) { return std::bit_cast<float>((static_cast<std::uint32_t>(high_word(a)) >> 4) | 0x40000000u); }

std::string source(const DoubleOperation& operation) {
  return fmt::format(R"(#version 400 core
uniform usampler2D list;
layout(location = 0) out uvec4 stored;
void main() {{
  uvec4 pair = texelFetch(list, ivec2(gl_FragCoord.xy), 0);
  double a = packDouble2x32(pair.xy), b = packDouble2x32(pair.zw);
  precise double result = {};
  stored = uvec4(unpackDouble2x32(result), 0u, 0u);
}}
)",
                     operation.expression);
}

}  // namespace

std::vector<DoubleOperation> ieee_operations() {
  return {{"sum", "a + b", [](double a, double b) { return a + b; }},
          {"product", "a * b", [](double a, double b) { return a * b; }},
          {"quotient", "a / b", [](double a, double b) { return a / b; }},
          {"conversion to int and back", "double(int(double(int(unpackDouble2x32(a).y) >> 9) + 0.75lf))",
           [](double a, double) { return static_cast<double>(static_cast<std::int32_t>((high_word(a) >> 9) + 0.75)); }},
          {"conversion of a float", "double(uintBitsToFloat((unpackDouble2x32(a).y >> 4) | 0x40000000u))",
           [](double a, double) { return static_cast<double>(float_of(a)); }}};
}

void require_operations(const gl::Api& gl, const std::vector<DoubleOperation>& operations, int max_texture_size_texel) {
  const std::vector<Pair> pairs = seeded_pairs();
  const GlHandle vertex_array = make_vertex_array(gl);
  gl.bind_vertex_array(vertex_array.id());
  gl.active_texture(gl::kTexture0 + kListUnit);
  const GlHandle list = make_bits_texture(gl, kWords, kSize, kSize, pairs.data(), max_texture_size_texel, "the probe of doubles");
  const ValueTarget target(gl, kSize, kSize, kWords, false);
  gl.viewport(0, 0, kSize, kSize);
  for (const DoubleOperation& operation : operations) {
    const GlHandle program = make_program(gl, value_vertex_source(), source(operation));
    gl.use_program(program.id());
    gl.uniform_1i(gl.get_uniform_location(program.id(), "list"), kListUnit);
    gl.draw_arrays(gl::kTriangles, 0, 3);
    const Image image = target.read();
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const auto* words = image.channels<std::uint32_t>(static_cast<int>(i) % kSize, static_cast<int>(i) / kSize);
      const std::uint64_t bits = words[0] | static_cast<std::uint64_t>(words[1]) << 32;
      wrong += bits != std::bit_cast<std::uint64_t>(operation.expected(pairs[i].a, pairs[i].b)) ? 1 : 0;
    }
    if (wrong != 0) {
      throw UnavailableError(fmt::format("OpenGL: the exact shader needs IEEE doubles: this device's {} differs in {} of {} cases",
                                         operation.name, wrong, pairs.size()));
    }
  }
}

}  // namespace etalon::gpu
