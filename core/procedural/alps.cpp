#include "core/procedural/alps.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/procedural/alps_paint.h"
#include "core/procedural/texture_bytes.h"

namespace etalon::procedural {

namespace {

void check(const AlpsOptions& options) {
  bool is_grid = false;
  for (int k = 5; k <= 12; ++k) is_grid = is_grid || options.size == (1 << k) + 1;
  if (!is_grid)
    throw InputError(fmt::format("terrain: size: expected 2^k+1 with k 5 to 12 (33, 65, 129, 257 … 4097), got {}", options.size));
  if (options.texture_size < 64 || options.texture_size > 8192)
    throw InputError(fmt::format("terrain: texture size: expected 64 to 8192, got {}", options.texture_size));
}

}  // namespace

Alps make_alps(const AlpsOptions& options) {
  check(options);
  constexpr int kReliefShare = 25, kWhole = 100;
  const AlpsGround ground(make_relief(options.seed,
                                      [&](int done, int total) {
                                        if (options.progress) options.progress(done * kReliefShare / total, kWhole);
                                      }),
                          options.seed);
  Alps alps;
  const double cells_per_sample = static_cast<double>(kReliefInner - 1) / (options.size - 1);
  alps.spacing = kReliefSpacing_m * cells_per_sample;
  alps.dem = Image(options.size, options.size, kR32f);
  parallel_for(static_cast<std::size_t>(options.size), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < options.size; ++x)
      *alps.dem.channels<float>(x, y) = static_cast<float>(ground.height_m(x * cells_per_sample, y * cells_per_sample));
  });
  alps.texture = Image(options.texture_size, options.texture_size, kRgb8);
  const double cells_per_texel = cells_per_sample * options.size / options.texture_size;
  constexpr int kBands = 32;
  for (int band = 0; band < kBands; ++band) {
    if (options.progress) options.progress(kReliefShare + band * (kWhole - kReliefShare) / kBands, kWhole);
    const int first = options.texture_size * band / kBands, end = options.texture_size * (band + 1) / kBands;
    parallel_for(static_cast<std::size_t>(end - first), [&](std::size_t row) {
      const int y = first + static_cast<int>(row);
      const auto place = [&](int texel) { return (texel + 0.5) * cells_per_texel - 0.5 * cells_per_sample; };
      for (int x = 0; x < options.texture_size; ++x)
        store_rgb8(alps.texture, x, y, alps_color(ground, place(x), place(y), cells_per_texel, options.seed));
    });
  }
  if (options.progress) options.progress(kWhole, kWhole);
  return alps;
}

}  // namespace etalon::procedural
