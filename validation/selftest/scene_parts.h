// What the scenes of the self-test are put together from: images of noise, random vertices, draws, rectangles.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "core/base/rng.h"
#include "validation/selftest/fixed_scenes.h"

namespace etalon::validation {

inline constexpr std::array kNumberTypes{ChannelType::unorm8, ChannelType::srgb8, ChannelType::unorm16, ChannelType::half,
                                         ChannelType::float32};

/// width × height texels of noise: integers over their whole range, half and float32 uniform in [-1/4, 5/4).
[[nodiscard]] std::shared_ptr<const Image> noise_image(int width, int height, PixelFormat format, Rng& rng);

/// What the numbers of a random vertex are drawn from.
struct VertexRange {
  enum class W : std::uint8_t {
    one,          ///< affine
    equal,        ///< affine, but not 1: the same for all vertices of a triangle
    perspective,  ///< [1/4, 4)
    mixed,        ///< one or perspective, vertex by vertex
    wild,         ///< 2^-20 to 2^20
  };
  W w = W::mixed;
  int reach_texel = 16;     ///< how far outside the frame vertices may lie
  bool on_lattice = false;  ///< whole and half texels only: samples on edges and vertices
  float uv_low = -1.5f, uv_high = 2.5f;
  float color_low = 0, color_high = 1;
};

/// A vertex within the range; `equal_w` is taken where the range says equal.
[[nodiscard]] RasterVertex random_vertex(Rng& rng, const Frame& frame, const VertexRange& range, float equal_w = 1);

/// A new draw without triangles at the end of the list; images are appended before.
Draw& open_draw(DrawList& list, Shading shading);

/// Appends a triangle to the last draw. Vertices are its own.
void add_triangle(DrawList& list, const RasterVertex& a, const RasterVertex& b, const RasterVertex& c);
/// Two triangles with a common diagonal, corners in order around.
void add_rectangle(DrawList& list, const std::array<RasterVertex, 4>& corners);
/// `count` triangles of random vertices.
void add_random_triangles(DrawList& list, Rng& rng, const Frame& frame, const VertexRange& range, int count);
/// A rectangle that covers the frame and more, with random numbers at its corners.
void add_cover(DrawList& list, Rng& rng, const Frame& frame, const VertexRange& range);

/// A position in texels, in the frame's sub-texels; x·2^bits must be an integer.
[[nodiscard]] std::int32_t subtexels(double x_texel, const Frame& frame);

std::uint32_t add_image(DrawList& list, std::shared_ptr<const Image> image);

[[nodiscard]] Sampler random_sampler(Rng& rng);
[[nodiscard]] Sampler random_sampler(Rng& rng, Filter filter);

/// Every content a target can have, colours in all formats.
[[nodiscard]] std::vector<TargetSpec> all_targets();

}  // namespace etalon::validation
