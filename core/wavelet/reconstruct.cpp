#include "core/wavelet/reconstruct.h"

#include <cstdint>

#include "core/base/parallel.h"
#include "core/wavelet/color.h"
#include "core/wavelet/lifting.h"
#include "core/wavelet/stream_header.h"

namespace etalon::wavelet {
namespace {

// What is left of a coefficient below its lowest known bit 2^q is taken to be this share of 2^q: a little under the middle, as small values are
// more frequent than large ones.
constexpr std::uint32_t kRestEighths = 3;

template <class T, class Value>
std::vector<Plane<T>> known_planes(const TextureHeader& header, const std::vector<BandState>& states, const Value& value) {
  std::vector<Plane<T>> planes(static_cast<std::size_t>(header.format.channels), {header.width, header.height});
  parallel_for(states.size(), [&](std::size_t b) {
    const BandState& s = states[b];
    if (s.grids.empty()) return;
    const double step = quantisation_step(header, s.band, s.channel);
    for (int y = 0; y < s.band.height; ++y) {
      T* row = planes[static_cast<std::size_t>(s.channel)].row(s.band.y0 + y) + s.band.x0;
      const std::uint32_t* known = s.known.data() + s.grids[0].bordered(make_place(0, y));
      const std::uint8_t* plane = s.known_plane.data() + s.grids[0].index(make_place(0, y));
      for (int x = 0; x < s.band.width; ++x)
        if (known[x] != 0) row[x] = value(known[x] & ~kSignBit, plane[x], (known[x] & kSignBit) != 0, step);
    }
  });
  return planes;
}

}  // namespace

Image reconstruct(const TextureHeader& header, const std::vector<BandState>& states) {
  if (header.kernel == Kernel::reversible_5_3) {
    auto planes = known_planes<std::int32_t>(header, states, [](std::uint32_t magnitude, int lowest, bool negative, double) {
      const auto rest = static_cast<std::uint32_t>((std::uint64_t{kRestEighths} << lowest) >> 3);
      const auto v = static_cast<std::int32_t>(magnitude + rest);
      return negative ? -v : v;
    });
    for (Plane<std::int32_t>& plane : planes) inverse(plane, header.levels);
    return reversible_image(planes, header.format);
  }
  auto planes = known_planes<double>(header, states, [](std::uint32_t magnitude, int lowest, bool negative, double step) {
    const double v = (static_cast<double>(magnitude) + static_cast<double>(std::uint64_t{kRestEighths} << lowest) / 8.0) * step;
    return negative ? -v : v;
  });
  for (Plane<double>& plane : planes) inverse(plane, header.levels);
  return irreversible_image(planes, header.format);
}

}  // namespace etalon::wavelet
