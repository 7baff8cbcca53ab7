#include "core/adapt/analytic_map.h"

#include <algorithm>

#include "core/adapt/chain_index.h"
#include "core/base/error.h"
#include "core/base/parallel.h"

namespace etalon::adapt {

Image analytic_map(const AdaptSequence& sequence, std::size_t level, int width, int height, ChannelType type,
                   const std::function<void(int, int)>& progress) {
  Image map = identity_map(width, height, type);
  const ChainIndex chain(sequence, level, sequence.size());
  constexpr int kRowsBetweenReports = 64;
  for (int begin = 0; begin < height; begin += kRowsBetweenReports) {
    const int rows = std::min(kRowsBetweenReports, height - begin);
    parallel_for(static_cast<std::size_t>(rows), [&](std::size_t row) {
      const int y = begin + static_cast<int>(row);
      for (int x = 0; x < width; ++x) {
        const Vec2d centre((x + 0.5) / width, (y + 0.5) / height), p = chain.follow(centre);
        if (p.x != centre.x || p.y != centre.y) set_map_coordinate(map, x, y, p);
      }
    });
    if (progress) progress(begin + rows, height);
  }
  return map;
}

Image analytic_with_gutter(const AdaptSequence& sequence, std::size_t level, const Image& adapted, const Gutter& gutter,
                           const std::function<void(int, int)>& progress) {
  ETALON_CHECK(gutter.level() == level && gutter.width() == adapted.width() && gutter.height() == adapted.height(),
               "a gutter of the level and of the map's size");
  Image map = analytic_map(sequence, level, adapted.width(), adapted.height(), adapted.format().type, progress);
  for (int y = 0; y < map.height(); ++y)
    for (int x = 0; x < map.width(); ++x)
      if (!gutter.in_chart(x, y)) set_map_coordinate(map, x, y, map_coordinate(adapted, x, y));
  return map;
}

}  // namespace etalon::adapt
