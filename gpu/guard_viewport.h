// Where positions go on their way to OpenGL: a viewport around frame and guard, and clip coordinates that bring a vertex back onto its
// sub-texel. The arithmetic is part of the promise: validation derives its bounds from it.
//
// A device clips at its viewport, and clipping makes vertices of its own; so the viewport is the smallest power-of-two square or rectangle
// that holds frame and guard, with its centre on a texel corner, and nothing ever crosses it. For a vertex (x, y in sub-texels, z, w):
//
//   w_c   = 1 where the triangle's three w are equal (affine), else w
//   x_n   = (x / 2^b − (vx + vw/2)) / (vw/2)   in double; exact: all three steps are on powers of two
//   x_c   = float32(x_n · w_c)                 the product is exact in double (24 + 24 bits); one rounding
//   z_n   = 2·z − 1                            in double; exact for z = 0 or z >= 2^-29 (below, one rounding of 2^-53)
//   z_c   = float32(z_n · w_c)                 in double, then one rounding
//
// With b <= 8, |x_n| < 1 holds at most 8192·2^8 = 2^21 steps of one sub-texel: x_n itself is a float32.
// The device computes x_w = x_c/w_c · vw/2 + (vx + vw/2) and z_w = z_c/w_c · ½ + ½ in float32. With u = 2^-24:
//   w_c = 1:  x_w is exact, fused or not (all intermediate values are float32 numbers); no displacement;
//             |z_w − z| <= u·|2z − 1|/2 + u/2 (rounding of z_c, then of the sum, z_w < 1 having half an ulp of at most u/2).
//   w_c ≠ 1:  three relative errors of u (x_c, the reciprocal, their product) and the rounding of the window position:
//             |x_w − x| <= δ = 3u(1 + 2u)·vw/2 + u·max(|vx|, vx + vw) texels (unfused: + u·vw/2); below half a sub-texel of 2^-8 the
//             device's snap restores x. |z_w − z| <= 3u(1 + 2u)·|2z − 1|/2 + u/2.
#pragma once

#include <array>

#include "core/draw/draw_list.h"

namespace etalon::gpu {

/// In texels of the frame; width and height are powers of two, x and y not positive.
struct GuardViewport {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
  friend bool operator==(const GuardViewport&, const GuardViewport&) = default;
};

/// The viewport for a frame: smallest powers of two >= frame + 2·guard, the frame in its middle (to the texel). frame + 2·guard <= 16384.
[[nodiscard]] GuardViewport guard_viewport(const Frame& frame);

/// Clip coordinates (x, y, z, w) of the three vertices of a triangle by the formulas above; every vertex inside frame ± guard.
[[nodiscard]] std::array<Vec4f, 3> clip_positions(const std::array<RasterVertex, 3>& triangle, const GuardViewport& viewport,
                                                  int subtexel_bits);

}  // namespace etalon::gpu
