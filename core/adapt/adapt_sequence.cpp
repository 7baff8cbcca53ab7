#include "core/adapt/adapt_sequence.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace etalon::adapt {
namespace {

// Texels, both ends included.
struct Region {
  int x0, x1, y0, y1;
};

// Regions by blocks of texels: what overlaps in a texel overlaps in a block.
constexpr int kBlock = 8;

Region region_of(const std::vector<ChartCells>& charts, int width, int height, int reach) {
  double x0 = 1, x1 = 0, y0 = 1, y1 = 0;
  for (const ChartCells& chart : charts)
    for (const CellNode& node : chart.cells.nodes)
      for (const Vec2f& p : {node.before, node.after}) {
        x0 = std::min<double>(x0, p.x), x1 = std::max<double>(x1, p.x);
        y0 = std::min<double>(y0, p.y), y1 = std::max<double>(y1, p.y);
      }
  const auto first = [&](double a, int size) { return std::clamp(static_cast<int>(std::floor(a * size)) - reach, 0, size - 1) / kBlock; };
  const auto last = [&](double a, int size) { return std::clamp(static_cast<int>(std::floor(a * size)) + reach, 0, size - 1) / kBlock; };
  return {first(x0, width), last(x1, width), first(y0, height), last(y1, height)};
}

bool has_cells(const std::vector<ChartCells>& charts) {
  return std::any_of(charts.begin(), charts.end(), [](const ChartCells& chart) { return !chart.cells.cells.empty(); });
}

// Blocks taken in the pack at hand.
class Taken {
 public:
  Taken(int width, int height)
      : columns_((width + kBlock - 1) / kBlock),
        pack_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>((height + kBlock - 1) / kBlock), 0) {}

  [[nodiscard]] bool is_free(const Region& region, std::uint32_t pack) const {
    for (int y = region.y0; y <= region.y1; ++y)
      for (int x = region.x0; x <= region.x1; ++x)
        if (pack_[block(x, y)] == pack) return false;
    return true;
  }
  void take(const Region& region, std::uint32_t pack) {
    for (int y = region.y0; y <= region.y1; ++y)
      for (int x = region.x0; x <= region.x1; ++x) pack_[block(x, y)] = pack;
  }

 private:
  [[nodiscard]] std::size_t block(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x);
  }
  int columns_;
  std::vector<std::uint32_t> pack_;
};

enum class PackRule : std::uint8_t { safe, printed };

std::vector<std::vector<std::uint32_t>> packs_by(PackRule rule, const AdaptSequence& sequence, std::size_t from, std::size_t to, int width,
                                                 int height, int reach) {
  ETALON_CHECK(from <= sequence.size() && to <= sequence.size() && width > 0 && height > 0, "packing: levels and size");
  struct Waiting {
    std::uint32_t split;
    Region region;
  };
  std::vector<Waiting> waiting, later;
  std::vector<ChartCells> charts;
  const std::size_t low = std::min(from, to), high = std::max(from, to);
  for (std::size_t n = 0; n < high - low; ++n) {
    const std::size_t split = from < to ? low + n : high - 1 - n;
    sequence.read(split, charts);
    if (has_cells(charts)) waiting.push_back({static_cast<std::uint32_t>(split), region_of(charts, width, height, reach)});
  }
  Taken taken(width, height);
  std::vector<std::vector<std::uint32_t>> packs;
  while (!waiting.empty()) {
    std::vector<std::uint32_t>& pack = packs.emplace_back();
    const auto number = static_cast<std::uint32_t>(packs.size());
    later.clear();
    for (const Waiting& w : waiting) {
      const bool free = taken.is_free(w.region, number);
      if (free || rule == PackRule::safe) taken.take(w.region, number);
      if (free) {
        pack.push_back(w.split);
      } else {
        later.push_back(w);
      }
    }
    std::swap(waiting, later);
  }
  return packs;
}

}  // namespace

AdaptSequence::AdaptSequence(progressive::ProgressiveMesh& mesh, const std::function<void(std::size_t, std::size_t)>& progress)
    : cells_(mesh.split_count()) {
  if (!mesh.data().has_uv) throw InputError("texture adaptation: expected a mesh with texture coordinates, got one without");
  constexpr std::size_t kBetweenReports = 1000;
  mesh.go_to(mesh.split_count());
  VertexFaces faces(mesh);
  for (std::size_t n = mesh.split_count(); n-- > 0; mesh.go_to(n)) {
    cells_.put(n, cells_of_split(mesh, n, &faces));
    faces.coarsen(mesh, n);
    if (progress && n % kBetweenReports == 0) progress(mesh.split_count() - n, mesh.split_count());
  }
  cells_.shrink();
}

std::vector<ChartCells> AdaptSequence::split(std::size_t n) const {
  std::vector<ChartCells> charts;
  cells_.read(n, charts);
  return charts;
}

Vec2d AdaptSequence::follow(Vec2d p, std::size_t from, std::size_t to) const {
  std::vector<ChartCells> charts;
  const auto through = [&](std::size_t n, AdaptDirection direction) {
    cells_.read(n, charts);
    for (const ChartCells& chart : charts)
      if (const auto q = map_point(chart.cells, direction, p)) {
        p = *q;
        return;
      }
  };
  for (std::size_t n = from; n < to; ++n) through(n, AdaptDirection::to_before);
  for (std::size_t n = from; n-- > to;) through(n, AdaptDirection::to_after);
  return p;
}

std::vector<std::vector<std::uint32_t>> pack_splits(const AdaptSequence& sequence, std::size_t from, std::size_t to, int width, int height,
                                                    int reach) {
  return packs_by(PackRule::safe, sequence, from, to, width, height, reach);
}

std::size_t count_printed_packs(const AdaptSequence& sequence, std::size_t from, std::size_t to, int width, int height, int reach) {
  return packs_by(PackRule::printed, sequence, from, to, width, height, reach).size();
}

}  // namespace etalon::adapt
