#include "core/wavelet/subbands.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/wavelet/lifting.h"

namespace etalon::wavelet {
namespace {

struct Norms {
  double low, high;
};

double norm_of(std::span<const double> x) {
  double sum = 0;
  for (const double v : x) sum += v * v;
  return std::sqrt(sum);
}

// The norms of the one-dimensional basis functions of each level, from the inverse transform of a unit coefficient in the middle of a line so
// long that none of its borders is reached: support at level l is below 10·2^l samples for either kernel.
std::vector<Norms> line_norms(int levels, Kernel kernel) {
  std::vector<Norms> norms(static_cast<std::size_t>(levels) + 1, {1, 1});
  for (int level = 1; level <= levels; ++level) {
    const int length = 32 << level;
    const auto picture_norm = [&](int index) {
      std::vector<double> line(static_cast<std::size_t>(length));
      line[static_cast<std::size_t>(index)] = 1;
      for (int l = level - 1; l >= 0; --l) inverse_line(std::span(line).first(static_cast<std::size_t>(length >> l)), kernel);
      return norm_of(line);
    };
    norms[static_cast<std::size_t>(level)] = {picture_norm(16), picture_norm(32 + 16)};
  }
  return norms;
}

}  // namespace

int default_levels(int width, int height) {
  int levels = 1;
  while (levels < kMaxLevels && low_size(std::min(width, height), levels + 1) >= 8) ++levels;
  return levels;
}

std::vector<Subband> make_subbands(int width, int height, int levels, Kernel kernel) {
  const std::vector<Norms> norms = line_norms(levels, kernel);
  std::vector<Subband> bands;
  const int w = low_size(width, levels), h = low_size(height, levels);
  const double coarsest = norms[static_cast<std::size_t>(levels)].low;
  bands.push_back({levels, Orientation::ll, 0, 0, w, h, coarsest * coarsest});
  for (int level = levels; level >= 1; --level) {
    const int outer_w = low_size(width, level - 1), outer_h = low_size(height, level - 1);
    const int low_w = low_size(width, level), low_h = low_size(height, level);
    const auto [low, high] = norms[static_cast<std::size_t>(level)];
    bands.push_back({level, Orientation::hl, low_w, 0, outer_w - low_w, low_h, high * low});
    bands.push_back({level, Orientation::lh, 0, low_h, low_w, outer_h - low_h, low * high});
    bands.push_back({level, Orientation::hh, low_w, low_h, outer_w - low_w, outer_h - low_h, high * high});
  }
  return bands;
}

}  // namespace etalon::wavelet
