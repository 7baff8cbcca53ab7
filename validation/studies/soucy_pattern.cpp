// The test images and how far a rendered one is off.
#include "core/base/error.h"
#include "core/procedural/test_images.h"
#include "validation/studies/soucy_study.h"

namespace etalon::validation {

const char* to_string(SoucyPattern pattern) { return pattern == SoucyPattern::chessboard ? "chessboard" : "ramp"; }

Image soucy_pattern(SoucyPattern pattern, int width, int height) {
  return pattern == SoucyPattern::chessboard ? procedural::make_chessboard(width, height) : procedural::make_ramp(width, height);
}

double SoucyError::mse() const { return texels > 0 ? static_cast<double>(sse) / (static_cast<double>(texels) * channels) : 0; }

double SoucyError::mean_magnitude() const {
  std::uint64_t sum = 0;
  for (std::uint64_t n = 0; n < histogram.size(); ++n) sum += histogram[n] * (n < 255 ? 255 - n : n - 255);
  return texels > 0 ? static_cast<double>(sum) / (static_cast<double>(texels) * channels) : 0;
}

SoucyError measure_pattern_error(const DrawnView& original, const DrawnView& baked, const Image& pattern, SoucyPattern which) {
  ETALON_CHECK(original.id.width() == pattern.width() + 2 && baked.id.width() == pattern.width() + 2 &&
                   original.id.height() == pattern.height() + 2 && baked.id.height() == pattern.height() + 2,
               "pictures one texel wider than the pattern on each side");
  SoucyError error;
  error.channels = which == SoucyPattern::chessboard ? 1 : 2;
  const auto grey = [&](int x, int y) { return pattern.channels<std::uint8_t>(x, y)[0]; };
  const auto touches_edge = [&](int x, int y) {
    const std::uint8_t own = grey(x, y);
    return (x > 0 && grey(x - 1, y) != own) || (x + 1 < pattern.width() && grey(x + 1, y) != own) || (y > 0 && grey(x, y - 1) != own) ||
           (y + 1 < pattern.height() && grey(x, y + 1) != own);
  };
  for (int y = 0; y < pattern.height(); ++y)
    for (int x = 0; x < pattern.width(); ++x) {
      if (*original.id.channels<std::uint32_t>(x + 1, y + 1) == kNoTriangle) continue;
      if (*baked.id.channels<std::uint32_t>(x + 1, y + 1) == kNoTriangle) continue;
      const auto *wanted = pattern.channels<std::uint8_t>(x, y), *got = baked.color.channels<std::uint8_t>(x + 1, y + 1);
      std::uint64_t square = 0;
      for (int c = 0; c < error.channels; ++c) {
        const int d = got[c] - wanted[c];
        square += static_cast<std::uint64_t>(d * d);
        ++error.histogram[static_cast<std::size_t>(d + 255)];
      }
      ++error.texels;
      error.sse += square;
      if (which == SoucyPattern::chessboard && touches_edge(x, y)) ++error.edge_texels, error.edge_sse += square;
    }
  return error;
}

}  // namespace etalon::validation
