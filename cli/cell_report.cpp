#include "cli/cell_report.h"

#include <fmt/format.h>

#include "validation/report/json_report.h"

namespace etalon::cli {
namespace {

using Json = nlohmann::ordered_json;
using adapt::CellStatus;
using validation::grouped;

double share(std::size_t part, std::size_t whole) { return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole); }

constexpr CellStatus kRefusals[] = {CellStatus::fold, CellStatus::no_place, CellStatus::gone, CellStatus::no_fan};

std::size_t rings(const adapt::CellStatistics& s, CellStatus status) { return s.rings[static_cast<std::size_t>(status)]; }

Json bytes(std::size_t total, std::size_t splits) { return {{"total", total}, {"per_split", share(total, splits)}}; }

}  // namespace

std::vector<std::string> cell_lines(const CellReport& report) {
  const adapt::CellStatistics& s = report.statistics;
  std::string refused;
  for (const CellStatus status : kRefusals)
    if (const std::size_t count = rings(s, status); count > 0)
      refused += fmt::format("{}{} {}", refused.empty() ? "; without: " : ", ", grouped(count), to_string(status));
  return {fmt::format("cells for texture adaptation: {} of {} rings{}; {:.1f} bytes a split in the file, {:.1f} in memory",
                      grouped(s.cells), grouped(s.made()), refused, share(report.file_bytes, s.splits), share(s.memory_bytes, s.splits)),
          fmt::format("places kept: u {:.4f}, crossings {:.4f} in the mean; damped: {} and {} rings; folded cells: {}", s.mean_place_share,
                      s.mean_crossing_share, grouped(s.damped_places), grouped(s.damped_crossings), grouped(s.folded_cells))};
}

void add_cell_members(const std::optional<CellReport>& report, Json& document) {
  for (const char* name : {"cells", "damped_crossings", "folded_cells", "cell_statistics"}) document[name] = nullptr;
  if (!report) return;
  const adapt::CellStatistics& s = report->statistics;
  document["cells"] = s.cells;
  document["damped_crossings"] = s.damped_crossings;
  document["folded_cells"] = s.folded_cells;
  Json refusals = Json::object();
  for (const CellStatus status : kRefusals) refusals[to_string(status)] = rings(s, status);
  document["cell_statistics"] = {{"rings", s.made()},
                                 {"refusals", refusals},
                                 {"damped_places", s.damped_places},
                                 {"damped_places_share", share(s.damped_places, s.made())},
                                 {"damped_crossings_share", share(s.damped_crossings, s.made())},
                                 {"mean_place_share", s.mean_place_share},
                                 {"mean_crossing_share", s.mean_crossing_share},
                                 {"file_bytes", bytes(report->file_bytes, s.splits)},
                                 {"memory_bytes", bytes(s.memory_bytes, s.splits)}};
}

}  // namespace etalon::cli
