// Which coefficients are sent, and how much later than their size alone would have it: the view dependence of a texture's stream. Encoder and
// decoder derive the same delays from the same data (a view in a file's header); the stream carries only their checksum.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "core/wavelet/subbands.h"

namespace etalon::wavelet {

/// Delay of a coefficient that is never sent (outside the frustum); it decodes to 0.
inline constexpr std::int16_t kNeverSent = std::numeric_limits<std::int16_t>::max();
inline constexpr int kMaxDelay = 2048;

/// One delay for each coefficient of the plane, the same for all channels. A coefficient c of a subband with norm g and delay n is sent as if its
/// error weighed g·2^-n: its bits come n bit-planes later. Empty: no delays.
struct Delays {
  int width = 0, height = 0, levels = 0;
  std::vector<std::int16_t> planes;  ///< row by row, each 0..kMaxDelay or kNeverSent

  [[nodiscard]] bool empty() const { return planes.empty(); }
  [[nodiscard]] std::int16_t at(int x, int y) const {
    return planes[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
  /// CRC-32 (of IEEE 802.3) over the numbers as little-endian bytes: what the stream's header holds.
  [[nodiscard]] std::uint32_t checksum() const;
};

/// delay(band, x, y) for every coefficient, x and y within its subband: 0..kMaxDelay or kNeverSent, otherwise InternalError.
[[nodiscard]] Delays make_delays(int width, int height, int levels, const std::function<int(const Subband&, int, int)>& delay);

/// What a view does with a texture: for each texel the length in pixels that a step of one texel has on the screen, along its longer direction,
/// and the pixels that the texel covers; both 0 where it is not seen. Finite, >= 0; row by row.
struct TexelView {
  int width = 0, height = 0;
  std::vector<float> pixels_per_texel;
  std::vector<float> covered_pixels;
};

struct ViewDelayOptions {
  int levels = 0;  ///< of the transform, 1..kMaxLevels
  /// A coefficient of level l is resolvable where 2^l · pixels_per_texel >= this: 1 is where its shortest wave, 2^l texels, has one pixel, half of
  /// what the screen's own sampling could carry; 0 takes all that are seen.
  double least_pixels = 1;
};

/// Delays of one view: a coefficient has the weight of the texels under it (its 2^level × 2^level texels and one such block on each side), the
/// root of their greatest covered area relative to the greatest of all; its delay is that weight in bit-planes, rounded down. Coefficients
/// none of whose texels is seen, or which are not resolvable on any of them, are never sent; the coarsest low-pass band is, where seen.
[[nodiscard]] Delays view_delays(const TexelView& view, const ViewDelayOptions& options);

/// Bit-planes by which each step of a pyramid stays ahead of the next: more than all bit-planes of all bands have together.
inline constexpr int kPyramidStepPlanes = 48;
inline constexpr int kMaxPyramidSteps = kMaxDelay / kPyramidStepPlanes;

struct PyramidOptions {
  int levels = 0;                                ///< of the transform
  int steps = 31;                                ///< M: distances d_0 .. d_M, T_M being the coarsest; 0..kMaxPyramidSteps
  int per_octave_num = 93, per_octave_den = 10;  ///< k = num/den: d_i = d_0·2^(i/k)
  double least_pixels = 1;
};

/// [Horbelt, Balmelli & Vetterli, section 2.2] The pyramid T_0 … T_M of a texture seen at distance d_0 (`view`) and from d_i = d_0·2^(i/k): T_i has
/// the coefficients that are resolvable where every texel is 2^(i/k) times smaller. The delays put all coefficients of T_M before those that
/// T_(M−1) adds, and so on to T_0: what T_(M−n) adds has a delay of n·kPyramidStepPlanes; kNeverSent is what even T_0 lacks.
struct Pyramid {
  Delays delays;
  std::vector<std::size_t> coefficients;  ///< [i]: of T_i, per channel; i = 0 .. steps
};
[[nodiscard]] Pyramid distance_pyramid(const TexelView& view, const PyramidOptions& options);

/// 2^(num/den) in (+ − × ÷) only, num >= 0, den 1..1000: by bisection of x^den = 2^(num mod den), the same double everywhere, within 2^-40.
[[nodiscard]] double power_of_two(int num, int den);

}  // namespace etalon::wavelet
