// The input of the rasterizers: triangles already in raster space, with everything their texels depend on.
// Made by core/draw/scene (from meshes), by adapt and bake (texture-space triangles), or read from FILE.draws.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/draw/state.h"
#include "core/image/image.h"
#include "core/math/vec.h"

namespace etalon {

/// A vertex as the rasterizers take it. Ranges are those of docs/contract.md#input, checked by validate().
struct RasterVertex {
  std::int32_t x = 0;  ///< sub-texels: texel (i, j) covers [i·2^b, (i+1)·2^b) × …, b = RasterState::subtexel_bits
  std::int32_t y = 0;  ///< sub-texels, up with the rows: row 0 is at the bottom of an OpenGL window
  float z = 0;         ///< window depth in [0, 1], interpolated affinely
  float w = 1;         ///< clip w in [2^-20, 2^20]; equal w on a triangle = affine
  Vec2f uv{0, 0};      ///< |uv| <= 2^40 and |uv|·size < 2^30
  Vec4f color{0, 0, 0, 1};
  friend bool operator==(const RasterVertex&, const RasterVertex&) = default;
};

enum class Shading : std::uint8_t {
  vertex_color,  ///< the interpolated colour
  texture,       ///< `texture` looked up at uv; absent channels read 0, 0, 1
  indexed,       ///< `texture` looked up at the first two channels of `indexing_map` looked up at uv
};

inline constexpr std::uint32_t kNoImage = 0xFFFFFFFFu;

/// A range of consecutive triangles drawn with one shading.
struct Draw {
  std::uint32_t first_triangle = 0;
  std::uint32_t triangle_count = 0;
  Shading shading = Shading::vertex_color;
  std::uint32_t texture = kNoImage;       ///< index into DrawList::images
  Sampler sampler;                        ///< of `texture`
  std::uint32_t indexing_map = kNoImage;  ///< index into DrawList::images
  Sampler map_sampler;                    ///< of `indexing_map`
  friend bool operator==(const Draw&, const Draw&) = default;
};

/// Triangles in submission order: the index of a triangle here is its id everywhere.
struct DrawList {
  std::vector<RasterVertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< #T by 3, indices into vertices, either orientation
  std::vector<Draw> draws;                              ///< cover the triangles in order, without gap or overlap
  std::vector<std::shared_ptr<const Image>> images;
  std::vector<std::uint32_t> source_faces;  ///< #T or empty: the mesh face each triangle was clipped from

  /// The draw that triangle `t` belongs to (binary search; t < triangles.size()).
  [[nodiscard]] const Draw& draw_of(std::uint32_t t) const;
};

/// Throws InputError where the frame's size, guard, sub-texel bits or targets break docs/contract.md#input.
void validate(const Frame& frame);

/// Throws InputError naming the first primitive (and what, expected, got) that breaks docs/contract.md#input for this frame.
void validate(const DrawList& list, const Frame& frame);

/// The same but for what needs a look at every texel of the images: for lists whose images are known to be good.
void validate_geometry(const DrawList& list, const Frame& frame);

/// The oracle's and OpenGL's common view of tiny numbers and zeros: |a| < 2^-40 becomes +0, and so does −0.
[[nodiscard]] constexpr float canonical(float a) { return (a < 0x1p-40f && a > -0x1p-40f) ? 0.0f : a; }

}  // namespace etalon
