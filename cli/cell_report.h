// What is said about the cells of a progressive mesh: lines for a person, members for a program.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/adapt/cell_statistics.h"

namespace etalon::cli {

struct CellReport {
  adapt::CellStatistics statistics;
  std::size_t file_bytes = 0;  ///< of the CELL chunks
};

/// Two or three lines.
[[nodiscard]] std::vector<std::string> cell_lines(const CellReport& report);

/// Sets `cells`, `damped_crossings`, `folded_cells` and `cell_statistics` of a document; all null without a report.
void add_cell_members(const std::optional<CellReport>& report, nlohmann::ordered_json& document);

}  // namespace etalon::cli
