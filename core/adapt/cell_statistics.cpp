#include "core/adapt/cell_statistics.h"

#include <algorithm>

#include "core/mesh/exact_orientation.h"

namespace etalon::adapt {
namespace {

std::size_t folded_in(const RingCells& cells) {
  std::size_t positive = 0, negative = 0;
  for (const auto& cell : cells.cells) {
    const CellNode &a = cells.nodes[cell[0]], &b = cells.nodes[cell[1]], &c = cells.nodes[cell[2]];
    const int before = orientation(a.before, b.before, c.before), after = orientation(a.after, b.after, c.after);
    positive += before > 0 && after > 0 ? 1 : 0, negative += before < 0 && after < 0 ? 1 : 0;
  }
  return cells.cells.size() - std::max(positive, negative);
}

}  // namespace

CellStatistics cell_statistics(const AdaptSequence& sequence) {
  CellStatistics result;
  result.splits = sequence.size(), result.memory_bytes = sequence.memory_bytes();
  double place_shares = 0, crossing_shares = 0;  // of eighths and sixteenths: exact sums
  std::vector<ChartCells> charts;
  for (std::size_t n = 0; n < sequence.size(); ++n) {
    sequence.read(n, charts);
    for (const ChartCells& chart : charts) {
      ++result.rings[static_cast<std::size_t>(chart.status)];
      if (chart.status != CellStatus::made) continue;
      result.cells += chart.cells.cells.size(), result.folded_cells += folded_in(chart.cells);
      result.damped_places += chart.cells.u_kept < 1 ? 1 : 0, result.damped_crossings += chart.cells.crossings_kept < 1 ? 1 : 0;
      place_shares += chart.cells.u_kept, crossing_shares += chart.cells.crossings_kept;
    }
  }
  if (const auto made = static_cast<double>(result.made()); made > 0)
    result.mean_place_share = place_shares / made, result.mean_crossing_share = crossing_shares / made;
  return result;
}

}  // namespace etalon::adapt
