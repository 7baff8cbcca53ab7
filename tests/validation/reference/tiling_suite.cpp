#include "tests/validation/reference/tiling_suite.h"

#include <fmt/format.h>

#include <algorithm>

#include "tests/validation/reference/tiling.h"

namespace etalon::validation::reference {

namespace {

Tally check_tiling(const Scene& scene, const std::string& label, Renderer& renderer) {
  DrawList reversed = scene.list;
  std::reverse(reversed.triangles.begin(), reversed.triangles.end());
  const Image last = renderer.render(scene.list, scene.frame).at(0);
  const Image first = renderer.render(reversed, scene.frame).at(0);
  const auto count = static_cast<std::uint32_t>(scene.list.triangles.size());
  Tally tally;
  tally.triangles = count;
  for (int j = 0; j < scene.frame.height; ++j)
    for (int i = 0; i < scene.frame.width; ++i) {
      const std::uint32_t a = *last.channels<std::uint32_t>(i, j), b = *first.channels<std::uint32_t>(i, j);
      ++tally.samples;
      if (a == kNoTriangle || b == kNoTriangle) {
        tally.mismatch(fmt::format("{}, texel ({}, {}): covered by no triangle", label, i, j));
      } else if (a != count - 1 - b) {
        tally.mismatch(fmt::format("{}, texel ({}, {}): covered by triangles {} and {}", label, i, j, count - 1 - b, a));
      } else {
        ++tally.covered;
      }
    }
  return tally;
}

}  // namespace

Tally run_tilings(const TilingOptions& options, Renderer& renderer) {
  Tally sum;
  for (std::uint64_t seed = options.first_seed; seed < options.first_seed + options.seeds; ++seed)
    for (const TilingKind kind : {TilingKind::fan, TilingKind::strip, TilingKind::grid, TilingKind::subdivision}) {
      Scene scene = random_tiling(seed, kind, options.size);
      for (const FillRule rule : {FillRule::left_ymin, FillRule::left_ymax, FillRule::right_ymin, FillRule::right_ymax}) {
        scene.frame.state.fill_rule = rule;
        sum += check_tiling(scene, fmt::format("tiling {} {} {}", seed, to_string(kind), to_string(rule)), renderer);
      }
    }
  return sum;
}

}  // namespace etalon::validation::reference
