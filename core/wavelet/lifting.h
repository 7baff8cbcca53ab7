// The discrete wavelet transforms: 5/3 in integers, exactly reversible, and 9/7 in IEEE double in a written order. Any size, symmetric
// extension, dyadic levels in place in the arrangement of subbands.h. The same bytes for every thread count.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/wavelet/subbands.h"

namespace etalon::wavelet {

/// A plane of width × height numbers, row by row.
template <class T>
struct Plane {
  int width = 0, height = 0;
  std::vector<T> values;

  Plane() = default;
  Plane(int w, int h) : width(w), height(h), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  [[nodiscard]] T* row(int y) { return values.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width); }
  [[nodiscard]] const T* row(int y) const { return values.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width); }
  friend bool operator==(const Plane&, const Plane&) = default;
};

/// 5/3: d(n) = x(2n+1) − ⌊(x(2n) + x(2n+2))/2⌋, s(n) = x(2n) + ⌊(d(n−1) + d(n) + 2)/4⌋ [ISO 15444-1, F.4.8.1]; a line of one sample stays.
/// Rows after columns, finest level first. |values| < 2^28 never overflow: a level at most multiplies them by 4 and low-pass by 1.5.
void forward(Plane<std::int32_t>& plane, int levels);
/// The exact inverse of forward(); arithmetic wraps modulo 2^32, so any numbers are accepted.
void inverse(Plane<std::int32_t>& plane, int levels);

/// 9/7 by four lifting steps and a scaling, low-pass with gain 1 at zero frequency [Daubechies & Sweldens 1998; ISO 15444-1, F.4.8.2].
void forward(Plane<double>& plane, int levels);
void inverse(Plane<double>& plane, int levels);

/// By how much one exact line of 9/7 forwards, or back, enlarges the greatest absolute value at most.
inline constexpr double kAnalysisGain = 1.381, kSynthesisGain = 2.991;

/// A bound of |inverse(forward(x)) − x| for |x| <= magnitude, derived in lifting.cpp.
[[nodiscard]] double roundtrip_error_bound(int levels, double magnitude);

/// One level of the inverse on one line, low half then high half, as real numbers (5/3 without its roundings).
void inverse_line(std::span<double> line, Kernel kernel);

}  // namespace etalon::wavelet
