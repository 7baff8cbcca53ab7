// The gutter: texels beside a chart that no cell covers, and that linear lookups near its border read all the same. Each takes, whenever the
// nearest texel of a chart is written, what the affine map of the cell that writes it says at its own centre. Decided in integers and
// once for all renderers (docs/decisions/0006-gutter.md).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/adapt/adapt_sequence.h"
#include "core/adapt/chart_borders.h"

namespace etalon::adapt {

/// How far from a chart a texel belongs to its gutter, along either axis.
inline constexpr int kGutterTexels = 2;

/// One texel that is looked up at a coordinate of its own.
struct GutterTexel {
  std::int32_t x = 0, y = 0;
  Vec2f uv{0, 0};  ///< in the map before
};

/// What the splits between two levels do to texels besides drawing their cells.
struct GutterPlan {
  std::size_t first_split = 0;
  std::vector<GutterTexel> texels;       ///< split by split
  std::vector<std::size_t> first_texel;  ///< of split first_split + k, and one more
  /// On the 1/256 grid, summed over the splits: texels in no cell though inside the ring (they are written like the gutter's), and in more than
  /// one (the lowest cell's).
  std::size_t uncovered = 0, doubled = 0;

  [[nodiscard]] std::span<const GutterTexel> of_split(std::size_t split) const {
    const std::size_t k = split - first_split;
    return std::span<const GutterTexel>(texels).subspan(first_texel[k], first_texel[k + 1] - first_texel[k]);
  }
};

/// Which texels of a map of one size lie in charts, level by level. A texel whose centre is in several faces is in all of them.
class Gutter {
 public:
  /// At the finest level. `borders` must outlive it. Sizes 1..16384. Memory: 6 bytes a texel.
  Gutter(const ChartBorders& borders, int width, int height);

  [[nodiscard]] std::size_t level() const { return level_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

  /// Goes to another level, split by split, and says what each does to the gutter. `sequence`: of the same mesh (ETALON_CHECK).
  [[nodiscard]] GutterPlan go_to(const AdaptSequence& sequence, std::size_t level);

  /// Goes there without a plan: only where charts are.
  void follow_borders(std::size_t level);

  [[nodiscard]] bool in_chart(int x, int y) const { return faces_[index(x, y)] > 0; }

  /// Of this level: texels in the gutter of some chart, and those of them near two.
  struct Size {
    std::size_t texels = 0, contested = 0;
  };
  [[nodiscard]] Size size() const;

 private:
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  void add_faces(const std::array<Vec2f, 3>& triangle, std::uint32_t chart, int count);
  void bend(std::size_t split, bool down);
  struct Nearest;
  [[nodiscard]] Nearest nearest_in_chart(int x, int y) const;
  void plan_side(const RingCells& cells, AdaptDirection direction, GutterPlan& plan);

  const ChartBorders& borders_;
  int width_, height_;
  std::size_t level_;
  std::vector<std::uint32_t> faces_;   // over each texel's centre
  std::vector<std::uint16_t> charts_;  // the last one that came, modulo 2^16: ties are broken by it
  // Of one side of a split, over its box: kept for their memory.
  std::vector<std::uint16_t> writer_;  // 1 + cell
  std::vector<std::int16_t> winding_;
};

}  // namespace etalon::adapt
