// What the GPU tests share: one renderer for the process (or a reported skip), small draw lists, and an integer reference of coverage.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/base/rng.h"
#include "core/draw/draw_list.h"
#include "gpu/gl_renderer.h"

namespace etalon::gpu::test {

/// The process's llvmpipe renderer, from OSMesa or (suite gpu_egl) EGL; nullptr, after a reported skip, where OpenGL is not to be had.
[[nodiscard]] GlRenderer* renderer_or_skip(const std::string& test_case);

/// A frame with the device's own state, one target unless more are added.
[[nodiscard]] Frame frame_of(const GlRenderer& renderer, int width, int height, int guard, std::vector<TargetSpec> targets);

/// A vertex at (x, y) texels; x and y multiples of 2^-8.
[[nodiscard]] RasterVertex vertex_at(double x_texel, double y_texel, Vec2f uv = {0, 0}, Vec4f color = {0, 0, 0, 1}, float z = 0);

/// Unindexed triangles in one draw without textures.
[[nodiscard]] DrawList triangle_list(std::vector<RasterVertex> vertices);

/// Appends two triangles for the rectangle [x0, x1) × [y0, y1), uv linear from uv0 to uv1, as a draw of its own.
void add_quad(DrawList& list, Vec2d lo_texel, Vec2d hi_texel, Vec2f uv_lo, Vec2f uv_hi, Draw shading);

/// A list of one quad that covers the frame and looks `texture` up with uv from 0 to 1.
[[nodiscard]] DrawList textured_quad(const Image& texture, int width, int height, const Sampler& sampler = {});

/// Random numbers of the format: any byte for unorm, finite values without −0 and without subnormals else.
[[nodiscard]] Image random_image(int width, int height, PixelFormat format, Rng& rng);

/// What the contract says of ids when later triangles win: the last triangle in the list that covers the texel. int64 edge functions, rule left_ymin.
[[nodiscard]] std::vector<std::uint32_t> reference_ids(const DrawList& list, const Frame& frame);

/// How many texels of the id image differ from `expected`.
[[nodiscard]] std::size_t count_different(const Image& ids, const std::vector<std::uint32_t>& expected);

inline constexpr TargetSpec kIdTarget{TargetContent::triangle_id, kR32ui, {}};
inline constexpr TargetSpec kDepthTarget{TargetContent::depth, kR32f, {}};
inline constexpr TargetSpec kColorTarget{TargetContent::color, kRgba8, {}};

}  // namespace etalon::gpu::test
