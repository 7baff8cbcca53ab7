// Down to a level and up again [Chen & Chuang 2006, sec. 3.1, 3.3]: what an indexing map loses on the way, by format, filter and size.
#pragma once

#include <functional>
#include <vector>

#include "core/adapt/adapt_sequence.h"
#include "core/adapt/chart_borders.h"
#include "core/adapt/gutter.h"
#include "core/draw/renderer.h"

namespace etalon::validation {

/// Distances between where a map's texels point and where they should, in texels of the map.
struct TexelErrors {
  double median = 0, p99 = 0, largest = 0;
};

/// Over the texels that lie in charts, of the level that `charts` is at; `truth` in [0, 1]². All 0 where no texel does.
[[nodiscard]] TexelErrors texel_errors(const Image& map, const adapt::Gutter& charts, const std::function<Vec2d(int x, int y)>& truth);

struct ChenInverse {
  ChannelType type = ChannelType::float32;
  Filter filter = Filter::linear;
  int size = 0;             ///< side of the map
  std::size_t unnamed = 0;  ///< texels that its identity map does not name
  TexelErrors down;         ///< at the level, from where the exact chain leads
  TexelErrors back;         ///< at the finest level again, from the texels' own centres
};

/// Every format and filter at every size, from the finest level to `level` and back, with the gutter. `progress` is called before each size.
[[nodiscard]] std::vector<ChenInverse> adapt_there_and_back(Renderer& renderer, const adapt::AdaptSequence& sequence,
                                                            const adapt::ChartBorders& borders, std::size_t level,
                                                            const std::vector<int>& sizes, const std::function<void(int size)>& progress);

}  // namespace etalon::validation
