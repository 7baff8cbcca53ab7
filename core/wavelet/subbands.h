// Where the coefficients of a dyadic wavelet transform lie, and how much a unit error of each costs in the picture.
#pragma once

#include <cstdint>
#include <vector>

namespace etalon::wavelet {

inline constexpr int kMaxLevels = 12;

enum class Kernel : std::uint8_t {
  reversible_5_3 = 0,    ///< LeGall 5/3 in integers with the reversible colour transform: lossless [ISO 15444-1, annexes F and G]
  irreversible_9_7 = 1,  ///< Cohen-Daubechies-Feauveau 9/7 by lifting in IEEE double with the irreversible colour transform
};

enum class Orientation : std::uint8_t { ll = 0, hl = 1, lh = 2, hh = 3 };  ///< first letter: along x; h: high-pass

/// One subband, a rectangle of the plane of coefficients, which has the size of the image.
struct Subband {
  int level = 0;  ///< 1: the finest; a coefficient stands for about 2^level × 2^level texels
  Orientation orientation = Orientation::ll;
  int x0 = 0, y0 = 0;         ///< first coefficient, in the plane
  int width = 0, height = 0;  ///< coefficients; may be 0 for images of one row or column
  double norm = 1;            ///< Euclidean norm of the picture of one unit coefficient (of the infinite, linear transform)
};

/// ceil(n / 2^level): low-pass samples of n after `level` steps.
[[nodiscard]] constexpr int low_size(int n, int level) {
  for (int l = 0; l < level; ++l) n = (n + 1) / 2;
  return n;
}

/// The most levels that still divide both sides, so that the coarsest subband has at least 8 × 8 coefficients where the image has; at least 1.
[[nodiscard]] int default_levels(int width, int height);

/// The 3·levels + 1 subbands, coarse to fine: ll, then hl, lh, hh of each level. width, height >= 1, levels 0..kMaxLevels.
[[nodiscard]] std::vector<Subband> make_subbands(int width, int height, int levels, Kernel kernel);

}  // namespace etalon::wavelet
