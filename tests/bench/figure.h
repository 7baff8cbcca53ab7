// A figure that the project has a goal for.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace etalon::bench {

enum class Sense { at_least, at_most };

struct Figure {
  std::string title;           ///< "time: CGAL ÷ ours"
  std::vector<double> values;  ///< of the rounds; one where it does not depend on time; none where it could not be measured
  double goal = 0;
  Sense sense = Sense::at_least;
  std::string skipped;  ///< why there are no values
};

/// {title, median, lower, upper, sense, goal, verdict: met | short | skipped, why}.
[[nodiscard]] nlohmann::ordered_json figure_json(const Figure& figure);

/// The rows of figure_json() as a Markdown table with its head.
[[nodiscard]] std::string figure_table(const nlohmann::ordered_json& figures);

}  // namespace etalon::bench
