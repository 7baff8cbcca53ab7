#include "validation/studies/chen_inverse.h"

#include <algorithm>
#include <cmath>

#include "core/adapt/adapt_map.h"
#include "core/adapt/analytic_map.h"
#include "core/adapt/map_format.h"

namespace etalon::validation {

TexelErrors texel_errors(const Image& map, const adapt::Gutter& charts, const std::function<Vec2d(int, int)>& truth) {
  std::vector<double> errors;
  errors.reserve(map.texel_count());
  for (int y = 0; y < map.height(); ++y)
    for (int x = 0; x < map.width(); ++x) {
      if (!charts.in_chart(x, y)) continue;
      const Vec2d d = adapt::map_coordinate(map, x, y) - truth(x, y);
      const double dx = d.x * map.width(), dy = d.y * map.height();
      errors.push_back(std::sqrt(dx * dx + dy * dy));
    }
  if (errors.empty()) return {};
  std::sort(errors.begin(), errors.end());
  return {errors[errors.size() / 2], errors[errors.size() * 99 / 100], errors.back()};
}

std::vector<ChenInverse> adapt_there_and_back(Renderer& renderer, const adapt::AdaptSequence& sequence, const adapt::ChartBorders& borders,
                                              std::size_t level, const std::vector<int>& sizes, const std::function<void(int)>& progress) {
  std::vector<ChenInverse> results;
  for (const int size : sizes) {
    if (progress) progress(size);
    const Image exact = adapt::analytic_map(sequence, level, size, size, ChannelType::float32);
    for (const ChannelType type : {ChannelType::float32, ChannelType::half, ChannelType::unorm16, ChannelType::unorm8})
      for (const Filter filter : {Filter::linear, Filter::nearest}) {
        ChenInverse result{
            .type = type, .filter = filter, .size = size, .unnamed = adapt::unnamed_texels(size, size, type), .down = {}, .back = {}};
        Image map = adapt::identity_map(size, size, type);
        adapt::Gutter gutter(borders, size, size);
        (void)adapt::adapt_map(renderer, sequence, sequence.size(), level, map, {.filter = filter, .gutter = &gutter});
        result.down = texel_errors(map, gutter, [&](int x, int y) { return adapt::map_coordinate(exact, x, y); });
        (void)adapt::adapt_map(renderer, sequence, level, sequence.size(), map, {.filter = filter, .gutter = &gutter});
        result.back = texel_errors(map, gutter, [&](int x, int y) { return Vec2d((x + 0.5) / size, (y + 0.5) / size); });
        results.push_back(result);
      }
  }
  return results;
}

}  // namespace etalon::validation
