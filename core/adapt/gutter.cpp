#include "core/adapt/gutter.h"

#include <algorithm>
#include <array>

#include "core/adapt/texel_spans.h"
#include "core/base/error.h"

namespace etalon::adapt {
namespace {

struct Offset {
  int dx, dy;
};

// Around a texel, the nearest first, then by rows.
constexpr auto kAround = [] {
  std::array<Offset, (2 * kGutterTexels + 1) * (2 * kGutterTexels + 1) - 1> around{};
  std::size_t count = 0;
  for (int distance2 = 1; distance2 <= 2 * kGutterTexels * kGutterTexels; ++distance2)
    for (int dy = -kGutterTexels; dy <= kGutterTexels; ++dy)
      for (int dx = -kGutterTexels; dx <= kGutterTexels; ++dx)
        if (dx * dx + dy * dy == distance2) around[count++] = {dx, dy};
  return around;
}();

int squared(const Offset& o) { return o.dx * o.dx + o.dy * o.dy; }

// Texels of a map, begins included and ends not.
struct TexelBox {
  int x0, x1, y0, y1;
  [[nodiscard]] bool holds(int x, int y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - y0) * static_cast<std::size_t>(x1 - x0) + static_cast<std::size_t>(x - x0);
  }
  [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(x1 - x0) * static_cast<std::size_t>(y1 - y0); }
};

TexelBox box_around(const std::vector<GridPoint>& points, int width, int height) {
  std::int64_t x0 = points[0].x, x1 = x0, y0 = points[0].y, y1 = y0;
  for (const GridPoint& p : points) x0 = std::min(x0, p.x), x1 = std::max(x1, p.x), y0 = std::min(y0, p.y), y1 = std::max(y1, p.y);
  const auto texel = [](std::int64_t at, int size) {
    return static_cast<int>(std::clamp<std::int64_t>(at >> 8, -1, size));  // floor
  };
  return {std::max(0, texel(x0, width) - kGutterTexels), std::min(width, texel(x1, width) + kGutterTexels + 1),
          std::max(0, texel(y0, height) - kGutterTexels), std::min(height, texel(y1, height) + kGutterTexels + 1)};
}

// The outline of the cells as directed edges of nodes: those that no cell has the other way.
std::vector<std::array<std::uint16_t, 2>> outline_of(const RingCells& cells) {
  std::vector<std::array<std::uint16_t, 2>> edges, outline;
  for (const auto& cell : cells.cells)
    for (std::size_t k = 0; k < 3; ++k) edges.push_back({cell[k], cell[(k + 1) % 3]});
  std::sort(edges.begin(), edges.end());
  for (const auto& edge : edges)
    if (!std::binary_search(edges.begin(), edges.end(), std::array<std::uint16_t, 2>{edge[1], edge[0]})) outline.push_back(edge);
  return outline;
}

// The cells' affine maps, from the texture drawn to the one looked up.
class CellLookup {
 public:
  CellLookup(const RingCells& cells, AdaptDirection direction, int width, int height)
      : cells_(cells), to_before_(direction == AdaptDirection::to_before), width_(width), height_(height) {
    for (const CellNode& node : cells.nodes) {
      const Vec2f& p = to_before_ ? node.before : node.after;
      low_.x = std::min(low_.x, p.x), high_.x = std::max(high_.x, p.x);
      low_.y = std::min(low_.y, p.y), high_.y = std::max(high_.y, p.y);
    }
  }

  // Where the texel's centre is looked up; no further from what the cells look up than the gutter is wide: a sliver's affine map may lead
  // anywhere beyond it.
  [[nodiscard]] Vec2f at(std::size_t cell, int x, int y) const {
    const auto& corner = cells_.cells[cell];
    const auto drawn = [&](std::size_t k) { return Vec2d(to_before_ ? cells_.nodes[corner[k]].after : cells_.nodes[corner[k]].before); };
    const auto shown = [&](std::size_t k) { return Vec2d(to_before_ ? cells_.nodes[corner[k]].before : cells_.nodes[corner[k]].after); };
    const Vec2d a = drawn(0), ab = drawn(1) - a, ac = drawn(2) - a, ap = Vec2d((x + 0.5) / width_, (y + 0.5) / height_) - a;
    const double area = ab.x * ac.y - ab.y * ac.x;
    const double v = (ap.x * ac.y - ap.y * ac.x) / area, w = (ab.x * ap.y - ab.y * ap.x) / area;
    const Vec2d p = shown(0) + v * (shown(1) - shown(0)) + w * (shown(2) - shown(0));
    const auto limited = [](double value, float low, float high, double reach) {
      return static_cast<float>(std::max(low - reach, std::min(high + reach, value)));  // what is no number becomes high + reach
    };
    return {limited(p.x, low_.x, high_.x, static_cast<double>(kGutterTexels) / width_),
            limited(p.y, low_.y, high_.y, static_cast<double>(kGutterTexels) / height_)};
  }

 private:
  const RingCells& cells_;
  bool to_before_;
  int width_, height_;
  Vec2f low_{1e30f, 1e30f}, high_{-1e30f, -1e30f};
};

}  // namespace

struct Gutter::Nearest {
  bool found = false, contested = false;
  int x = 0, y = 0;
};

Gutter::Gutter(const ChartBorders& borders, int width, int height)
    : borders_(borders), width_(width), height_(height), level_(borders.split_count()) {
  ETALON_CHECK(width > 0 && height > 0 && width <= 16384 && height <= 16384, "gutter: size of the map");
  const std::size_t texels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  faces_.assign(texels, 0), charts_.assign(texels, 0);
  for (const ChartBorders::Face& face : borders.finest_faces()) add_faces(face.uv, face.chart, 1);
}

void Gutter::add_faces(const std::array<Vec2f, 3>& triangle, std::uint32_t chart, int count) {
  const auto p = [&](std::size_t k) { return on_grid(triangle[k], width_, height_); };
  for_texel_spans({p(0), p(1), p(2)}, width_, height_, [&](int y, int begin, int end) {
    for (std::size_t n = index(begin, y); n < index(begin, y) + static_cast<std::size_t>(end - begin); ++n) {
      faces_[n] = static_cast<std::uint32_t>(static_cast<std::int64_t>(faces_[n]) + count);
      if (count > 0) charts_[n] = static_cast<std::uint16_t>(chart);
    }
  });
}

void Gutter::bend(std::size_t split, bool down) {
  for (const ChartBorders::Bend& bend : borders_.bends(split)) add_faces(bend.uv, bend.chart, bend.lost == down ? -1 : 1);
}

// The nearest texel in a chart, of those the one of the lowest chart, then of the lowest row and column.
Gutter::Nearest Gutter::nearest_in_chart(int x, int y) const {
  Nearest nearest;
  int distance2 = 0;
  std::uint16_t chart = 0;
  for (const Offset& o : kAround) {
    const int i = x + o.dx, j = y + o.dy;
    if (i < 0 || j < 0 || i >= width_ || j >= height_ || faces_[index(i, j)] == 0) continue;
    const std::uint16_t here = charts_[index(i, j)];
    if (nearest.found && here != chart) nearest.contested = true;
    if (nearest.found && (squared(o) > distance2 || here >= chart)) continue;
    nearest.found = true, nearest.x = i, nearest.y = j, distance2 = squared(o), chart = here;
  }
  return nearest;
}

void Gutter::plan_side(const RingCells& cells, AdaptDirection direction, GutterPlan& plan) {
  const bool to_before = direction == AdaptDirection::to_before;
  std::vector<GridPoint> points;
  for (const CellNode& node : cells.nodes) points.push_back(on_grid(to_before ? node.after : node.before, width_, height_));
  const TexelBox box = box_around(points, width_, height_);
  if (box.x0 >= box.x1 || box.y0 >= box.y1) return;
  writer_.assign(box.count(), 0), winding_.assign(box.count(), 0);
  const auto for_span = [&](const std::array<GridPoint, 3>& triangle, const auto& visit) {
    for_texel_spans(triangle, width_, height_, [&](int y, int begin, int end) {
      const std::size_t row = box.index(begin, y);
      for (std::size_t n = row; n < row + static_cast<std::size_t>(end - begin); ++n) visit(n);
    });
  };
  for (std::size_t k = 0; k < cells.cells.size(); ++k) {
    const auto& cell = cells.cells[k];
    for_span({points[cell[0]], points[cell[1]], points[cell[2]]}, [&](std::size_t n) {
      plan.doubled += writer_[n] != 0 ? 1 : 0;
      if (writer_[n] == 0) writer_[n] = static_cast<std::uint16_t>(k + 1);
    });
  }
  // The ring as a fan around v. On a curve u is on the edge from v to the last corner after the collapse, up to rounding: without it that edge
  // is the mesh's own.
  for (const auto& [a, b] : outline_of(cells)) {
    if (to_before && (a == 0 || b == 0)) continue;
    const std::array<GridPoint, 3> triangle = {points[1], points[a], points[b]};
    const int turn = doubled_area(triangle[0], triangle[1], triangle[2]) > 0 ? 1 : -1;
    for_span(triangle, [&](std::size_t n) { winding_[n] = static_cast<std::int16_t>(winding_[n] + turn); });
  }
  const CellLookup lookup(cells, direction, width_, height_);
  const auto add = [&](int x, int y, std::size_t from) { plan.texels.push_back({x, y, lookup.at(std::size_t{writer_[from]} - 1, x, y)}); };
  for (int y = box.y0; y < box.y1; ++y)
    for (int x = box.x0; x < box.x1; ++x) {
      const std::size_t n = box.index(x, y);
      if (writer_[n] != 0) continue;
      if (winding_[n] != 0) {
        ++plan.uncovered;
        for (const Offset& o : kAround)
          if (box.holds(x + o.dx, y + o.dy) && writer_[box.index(x + o.dx, y + o.dy)] != 0) {
            add(x, y, box.index(x + o.dx, y + o.dy));
            break;
          }
      } else if (!in_chart(x, y)) {
        const Nearest nearest = nearest_in_chart(x, y);
        if (nearest.found && box.holds(nearest.x, nearest.y) && writer_[box.index(nearest.x, nearest.y)] != 0)
          add(x, y, box.index(nearest.x, nearest.y));
      }
    }
}

GutterPlan Gutter::go_to(const AdaptSequence& sequence, std::size_t level) {
  ETALON_CHECK(sequence.size() == borders_.split_count() && level <= sequence.size(), "gutter: another mesh, or no such level");
  const bool down = level < level_;
  const std::size_t low = std::min(level, level_), high = std::max(level, level_);
  GutterPlan plan;
  plan.first_split = low;
  std::vector<std::size_t> counts;  // in the order of work
  std::vector<ChartCells> charts;
  for (std::size_t k = 0; k < high - low; ++k) {
    const std::size_t split = down ? high - 1 - k : low + k, before = plan.texels.size();
    bend(split, down);
    sequence.read(split, charts);
    for (const ChartCells& chart : charts)
      if (!chart.cells.cells.empty()) plan_side(chart.cells, down ? AdaptDirection::to_before : AdaptDirection::to_after, plan);
    counts.push_back(plan.texels.size() - before);
  }
  level_ = level;
  if (down) {  // from the order of work to that of splits
    std::vector<GutterTexel> ordered;
    ordered.reserve(plan.texels.size());
    auto end = plan.texels.end();
    for (std::size_t k = counts.size(); k-- > 0;) {
      const auto begin = end - static_cast<std::ptrdiff_t>(counts[k]);
      ordered.insert(ordered.end(), begin, end);
      end = begin;
    }
    plan.texels = std::move(ordered);
    std::reverse(counts.begin(), counts.end());
  }
  plan.first_texel.assign(1, 0);
  for (const std::size_t count : counts) plan.first_texel.push_back(plan.first_texel.back() + count);
  return plan;
}

void Gutter::follow_borders(std::size_t level) {
  ETALON_CHECK(level <= borders_.split_count(), "gutter: no such level");
  for (; level_ > level; --level_) bend(level_ - 1, true);
  for (; level_ < level; ++level_) bend(level_, false);
}

Gutter::Size Gutter::size() const {
  Size size;
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      if (in_chart(x, y)) continue;
      const Nearest nearest = nearest_in_chart(x, y);
      size.texels += nearest.found ? 1 : 0, size.contested += nearest.contested ? 1 : 0;
    }
  return size;
}

}  // namespace etalon::adapt
