#include "core/adapt/chain_index.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/error.h"

namespace etalon::adapt {
namespace {

constexpr int kBuckets = 256;  // along [0, 1]; what lies outside is in the buckets at the border

int bucket_along(double x) { return static_cast<int>(std::floor(std::clamp(x * kBuckets, 0.0, kBuckets - 1.0))); }

struct Box {
  double x0 = 1e300, x1 = -1e300, y0 = 1e300, y1 = -1e300;
  void add(const Vec2d& p, double margin = 0) {
    x0 = std::min(x0, p.x - margin), x1 = std::max(x1, p.x + margin);
    y0 = std::min(y0, p.y - margin), y1 = std::max(y1, p.y + margin);
  }
  [[nodiscard]] double diagonal() const { return std::sqrt((x1 - x0) * (x1 - x0) + (y1 - y0) * (y1 - y0)); }
};

Vec2d corner(const CellNode& node, AdaptDirection direction) {
  return Vec2d(direction == AdaptDirection::to_before ? node.after : node.before);
}

// All points for which map_point() may find a cell. It takes p where its three weights, which sum to 1, are at least −r with
// r = 2^-50 (|ab|² + |ac|² + |ap|²)/|area|; such a p is outside of the cell's box by at most 2r times its longest side e. |ap| is at most
// `widest` to begin with, which bounds r, which bounds |ap| by e(1 + 2r), which bounds r again. Doubled for the roundings of all this and of
// the weights themselves.
void add_reach(std::span<const CellNode> nodes, std::span<const std::array<std::uint16_t, 3>> cells, AdaptDirection direction,
               double widest, Box& box) {
  for (const auto& cell : cells) {
    const Vec2d a = corner(nodes[cell[0]], direction), b = corner(nodes[cell[1]], direction), c = corner(nodes[cell[2]], direction);
    const Vec2d ab = b - a, ac = c - a, bc = c - b;
    const double area = std::abs(ab.x * ac.y - ab.y * ac.x), sides2 = ab.x * ab.x + ab.y * ab.y + ac.x * ac.x + ac.y * ac.y;
    const double e = std::sqrt(std::max(sides2, bc.x * bc.x + bc.y * bc.y));
    double farthest = widest, rounding = 0;
    for (int n = 0; n < 2; ++n) {
      rounding = 0x1p-49 * (sides2 + farthest * farthest) / area;
      farthest = std::min(farthest, e * (1 + 2 * rounding));
    }
    const double margin = 4 * rounding * e;
    box.add(a, margin), box.add(b, margin), box.add(c, margin);
  }
}

}  // namespace

ChainIndex::ChainIndex(const AdaptSequence& sequence, std::size_t from, std::size_t to)
    : direction_(from < to ? AdaptDirection::to_before : AdaptDirection::to_after), bucket_begin_(kBuckets * kBuckets + 1, 0) {
  ETALON_CHECK(from <= sequence.size() && to <= sequence.size(), "chain of cells: levels");
  const std::size_t steps = from < to ? to - from : from - to;
  const auto split_at = [&](std::size_t step) { return from < to ? from + step : from - 1 - step; };
  Box all;
  all.add({0, 0}), all.add({1, 1});
  for (std::size_t step = 0; step < steps; ++step)
    for (const ChartCells& chart : sequence.split(split_at(step))) {
      for (const CellNode& node : chart.cells.nodes) all.add(Vec2d(node.before)), all.add(Vec2d(node.after));
      if (chart.cells.cells.empty()) continue;
      ETALON_CHECK(nodes_.size() <= 0xFFFF'FFFFu, "chain of cells: more than 2^32 corners");
      sides_.push_back({0, 0, 0, 0, static_cast<std::uint32_t>(step), static_cast<std::uint32_t>(nodes_.size()), cells_.size()});
      nodes_.insert(nodes_.end(), chart.cells.nodes.begin(), chart.cells.nodes.end());
      cells_.insert(cells_.end(), chart.cells.cells.begin(), chart.cells.cells.end());
    }
  sides_.push_back({0, 0, 0, 0, static_cast<std::uint32_t>(steps), static_cast<std::uint32_t>(nodes_.size()), cells_.size()});
  for (std::size_t n = 0; n + 1 < sides_.size(); ++n) {
    Box box;
    add_reach(nodes_of(n), cells_of(n), direction_, 4 * all.diagonal(), box);
    sides_[n].x0 = box.x0, sides_[n].x1 = box.x1, sides_[n].y0 = box.y0, sides_[n].y1 = box.y1;
  }
  const auto for_buckets = [](const Side& side, const auto& visit) {
    for (int y = bucket_along(side.y0); y <= bucket_along(side.y1); ++y)
      for (int x = bucket_along(side.x0); x <= bucket_along(side.x1); ++x) visit(static_cast<std::size_t>(y * kBuckets + x));
  };
  const std::size_t side_count = sides_.size() - 1;
  for (std::size_t n = 0; n < side_count; ++n) for_buckets(sides_[n], [&](std::size_t bucket) { ++bucket_begin_[bucket + 1]; });
  for (std::size_t bucket = 0; bucket + 1 < bucket_begin_.size(); ++bucket) bucket_begin_[bucket + 1] += bucket_begin_[bucket];
  side_of_.resize(bucket_begin_.back());
  std::vector<std::uint32_t> next(bucket_begin_.begin(), bucket_begin_.end() - 1);
  for (std::uint32_t n = 0; n < side_count; ++n) for_buckets(sides_[n], [&](std::size_t bucket) { side_of_[next[bucket]++] = n; });
}

std::span<const CellNode> ChainIndex::nodes_of(std::size_t side) const {
  return std::span(nodes_).subspan(sides_[side].first_node, sides_[side + 1].first_node - sides_[side].first_node);
}

std::span<const std::array<std::uint16_t, 3>> ChainIndex::cells_of(std::size_t side) const {
  return std::span(cells_).subspan(sides_[side].first_cell, sides_[side + 1].first_cell - sides_[side].first_cell);
}

std::size_t ChainIndex::bucket_of(const Vec2d& p) const {
  return static_cast<std::size_t>(bucket_along(p.y)) * kBuckets + static_cast<std::size_t>(bucket_along(p.x));
}

Vec2d ChainIndex::follow(Vec2d p) const {
  std::uint32_t done = 0;  // steps before this one are behind
  for (;;) {
    const std::size_t bucket = bucket_of(p);
    const std::uint32_t* const end = side_of_.data() + bucket_begin_[bucket + 1];
    const std::uint32_t* at = std::lower_bound(side_of_.data() + bucket_begin_[bucket], end, done,
                                               [&](std::uint32_t side, std::uint32_t step) { return sides_[side].step < step; });
    bool moved_away = false;
    for (; at != end && !moved_away; ++at) {
      const Side& side = sides_[*at];
      if (side.step < done || p.x < side.x0 || p.x > side.x1 || p.y < side.y0 || p.y > side.y1) continue;
      const std::optional<Vec2d> q = map_point(nodes_of(*at), cells_of(*at), direction_, p);
      if (!q) continue;
      p = *q, done = side.step + 1;
      moved_away = bucket_of(p) != bucket;
    }
    if (!moved_away) return p;
  }
}

}  // namespace etalon::adapt
