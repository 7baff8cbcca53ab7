#include "core/wavelet/delays.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/wavelet/checksum.h"

namespace etalon::wavelet {
namespace {

// Greatest values of both maps over blocks of 2^l × 2^l texels, level by level.
struct BlockMaxima {
  int width, height;
  std::vector<float> pixels, area;
};

std::vector<BlockMaxima> block_maxima(const TexelView& view, int levels) {
  std::vector<BlockMaxima> maxima = {{view.width, view.height, view.pixels_per_texel, view.covered_pixels}};
  for (int l = 1; l <= levels; ++l) {
    const BlockMaxima& fine = maxima.back();
    BlockMaxima next{(fine.width + 1) / 2, (fine.height + 1) / 2, {}, {}};
    next.pixels.resize(static_cast<std::size_t>(next.width) * static_cast<std::size_t>(next.height));
    next.area.resize(next.pixels.size());
    for (int y = 0; y < fine.height; ++y) {
      for (int x = 0; x < fine.width; ++x) {
        const auto from = static_cast<std::size_t>(y) * static_cast<std::size_t>(fine.width) + static_cast<std::size_t>(x);
        const auto to = static_cast<std::size_t>(y / 2) * static_cast<std::size_t>(next.width) + static_cast<std::size_t>(x / 2);
        next.pixels[to] = std::max(next.pixels[to], fine.pixels[from]);
        next.area[to] = std::max(next.area[to], fine.area[from]);
      }
    }
    maxima.push_back(std::move(next));
  }
  return maxima;
}

struct Seen {
  float pixels = 0, area = 0;
};

// Over the block of a coefficient and its eight neighbours.
Seen seen_by(const BlockMaxima& maxima, int x, int y) {
  Seen seen;
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, maxima.height - 1); ++j) {
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, maxima.width - 1); ++i) {
      const auto at = static_cast<std::size_t>(j) * static_cast<std::size_t>(maxima.width) + static_cast<std::size_t>(i);
      seen.pixels = std::max(seen.pixels, maxima.pixels[at]);
      seen.area = std::max(seen.area, maxima.area[at]);
    }
  }
  return seen;
}

void require_view(const TexelView& view, int levels) {
  const auto count = static_cast<std::size_t>(std::max(view.width, 0)) * static_cast<std::size_t>(std::max(view.height, 0));
  const auto is_weight = [](float x) { return std::isfinite(x) && x >= 0; };
  if (count == 0 || view.pixels_per_texel.size() != count || view.covered_pixels.size() != count)
    throw InputError(fmt::format("texel view: expected two maps of {} x {} texels, got {} and {} values", view.width, view.height,
                                 view.pixels_per_texel.size(), view.covered_pixels.size()));
  if (!std::ranges::all_of(view.pixels_per_texel, is_weight) || !std::ranges::all_of(view.covered_pixels, is_weight))
    throw InputError("texel view: expected finite numbers >= 0");
  if (levels < 1 || levels > kMaxLevels) throw InputError(fmt::format("texel view: expected 1 to {} levels, got {}", kMaxLevels, levels));
}

// The pixels of a coefficient's shortest wave, 2^level texels.
double wave_pixels(const Subband& band, const Seen& seen) {
  return static_cast<double>(seen.pixels) * static_cast<double>(1 << band.level);
}

// Bit-planes by which sqrt(area) lags behind sqrt(greatest): n = ⌊log2(greatest/area)/2⌋.
int lag(double area, double greatest) {
  int n = 0;
  while (n < kMaxDelay && area * 4 <= greatest) {
    area *= 4;
    ++n;
  }
  return n;
}

}  // namespace

std::uint32_t Delays::checksum() const {
  Crc32 crc;
  for (const std::int16_t d : planes) {
    crc.add(static_cast<std::uint8_t>(d & 0xFF));
    crc.add(static_cast<std::uint8_t>((d >> 8) & 0xFF));
  }
  return crc.value();
}

Delays make_delays(int width, int height, int levels, const std::function<int(const Subband&, int, int)>& delay) {
  Delays delays{width, height, levels, std::vector<std::int16_t>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height))};
  for (const Subband& band : make_subbands(width, height, levels, Kernel::reversible_5_3)) {
    parallel_for(static_cast<std::size_t>(band.height), [&](std::size_t row) {
      const int y = static_cast<int>(row);
      std::int16_t* out = delays.planes.data() + static_cast<std::size_t>(band.y0 + y) * static_cast<std::size_t>(width) + band.x0;
      for (int x = 0; x < band.width; ++x) {
        const int n = delay(band, x, y);
        ETALON_CHECK(n == kNeverSent || (n >= 0 && n <= kMaxDelay), fmt::to_string(n));
        out[x] = static_cast<std::int16_t>(n);
      }
    });
  }
  return delays;
}

Delays view_delays(const TexelView& view, const ViewDelayOptions& options) {
  require_view(view, options.levels);
  const std::vector<BlockMaxima> maxima = block_maxima(view, options.levels);
  const float greatest = *std::ranges::max_element(view.covered_pixels);
  return make_delays(view.width, view.height, options.levels, [&](const Subband& band, int x, int y) -> int {
    const Seen seen = seen_by(maxima[static_cast<std::size_t>(band.level)], x, y);
    if (seen.pixels == 0 || seen.area == 0) return kNeverSent;
    if (band.orientation != Orientation::ll && wave_pixels(band, seen) < options.least_pixels) return kNeverSent;
    return lag(seen.area, greatest);
  });
}

Pyramid distance_pyramid(const TexelView& view, const PyramidOptions& options) {
  require_view(view, options.levels);
  if (options.steps < 0 || options.steps > kMaxPyramidSteps || options.per_octave_num < 1 || options.per_octave_num > 1000 ||
      options.per_octave_den < 1 || options.per_octave_den > 1000)
    throw InputError(fmt::format("pyramid: expected 0 to {} steps and k of two numbers in 1..1000, got {} and {}/{}", kMaxPyramidSteps,
                                 options.steps, options.per_octave_num, options.per_octave_den));
  const std::vector<BlockMaxima> maxima = block_maxima(view, options.levels);
  std::vector<double> least;  // pixels that a wave must have at d_0 to be resolvable at d_i
  for (int i = 0; i <= options.steps; ++i)
    least.push_back(options.least_pixels * power_of_two(i * options.per_octave_den, options.per_octave_num));

  Pyramid pyramid;
  pyramid.delays = make_delays(view.width, view.height, options.levels, [&](const Subband& band, int x, int y) -> int {
    const Seen seen = seen_by(maxima[static_cast<std::size_t>(band.level)], x, y);
    if (seen.pixels == 0 || seen.area == 0) return kNeverSent;
    if (band.orientation == Orientation::ll) return 0;
    const auto beyond = std::ranges::upper_bound(least, wave_pixels(band, seen));
    if (beyond == least.begin()) return kNeverSent;
    return static_cast<int>(least.end() - beyond) * kPyramidStepPlanes;
  });
  pyramid.coefficients.resize(static_cast<std::size_t>(options.steps) + 1);
  for (const std::int16_t delay : pyramid.delays.planes) {
    if (delay == kNeverSent) continue;
    const int coarsest = options.steps - delay / kPyramidStepPlanes;
    for (int i = 0; i <= coarsest; ++i) ++pyramid.coefficients[static_cast<std::size_t>(i)];
  }
  return pyramid;
}

double power_of_two(int num, int den) {
  ETALON_CHECK(num >= 0 && den >= 1 && den <= 1000, fmt::format("{}/{}", num, den));
  // x^den in doubles errs by less than den·2^-53 relatively, hence x by about 2^-53; (2 − 2^-53)^1000 stays below the largest double.
  double low = 1, high = 2;
  for (int step = 0; step < 53; ++step) {
    const double middle = (low + high) / 2;
    // Divided by two whenever it passes 2, so that the product stays in range; halvings are exact.
    double power = 1;
    int halvings = 0;
    for (int i = 0; i < den; ++i) {
      power *= middle;
      if (power >= 2) {
        power /= 2;
        ++halvings;
      }
    }
    (halvings >= num % den ? high : low) = middle;
  }
  double result = num % den == 0 ? 1 : high;
  for (int i = 0; i < num / den; ++i) result *= 2;
  return result;
}

}  // namespace etalon::wavelet
