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
// |x_n| <= 1 is at most 8192·2^b steps of one sub-texel: with b <= 8 (2^21 steps) x_n itself is a float32 number.
// |x_c| <= w_c and |z_c| <= w_c since rounding keeps order: no vertex is clipped.
//
// The device then computes in float32 (Mesa, draw_llvm.c, generate_viewport: one division 1/w, a product, a multiply-add)
//   r = fl(1 / w_c), x_w = fma(fl(x_c·r), vw/2, vx + vw/2), z_w = fma(fl(z_c·r), ½, ½); without FMA the product is rounded before the sum.
// With u = 2^-24:
//   w_c = 1:  x_w = x / 2^b exactly, fused or not: every intermediate value is a float32 number. Displacement 0.
//             |z_w − z| <= u·|2z − 1|/2 + u/2: the rounding of z_c, then that of the sum (half an ulp below 1 is at most u/2).
//   w_c ≠ 1:  x_c, r and their product are rounded, a relative error of at most 3u(1 + 2u); then the sum:
//             |x_w − x| <= δ = 3u(1 + 2u)·vw/2 + ½u·2^⌈log2 max(|vx|, vx + vw)⌉ texels, + u·vw/2 where not fused. In sub-texels of 2^-8,
//             fused: at most 0.25 for vw = 8192 and 0.5 for vw = 16384, less than 0.5 in fact (at |x_n| = 1, x_c = ±w_c has no error,
//             elsewhere |x_n| <= 1 − 2^-21); so the device's own snap brings x back. Unfused that is proven up to vw = 8192.
//             |z_w − z| <= 3u(1 + 2u)·|2z − 1|/2 + u/2.
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
