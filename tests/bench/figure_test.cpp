#include "tests/bench/figure.h"

#include <doctest/doctest.h>

using namespace etalon::bench;

TEST_CASE("a figure is met or short on the right side of its goal, also exactly at it") {
  const auto verdict = [](std::vector<double> values, Sense sense) {
    return figure_json({.title = "t", .values = std::move(values), .goal = 5, .sense = sense}).at("verdict").get<std::string>();
  };
  CHECK(verdict({4, 5, 9}, Sense::at_least) == "met");
  CHECK(verdict({4, 4.9, 9}, Sense::at_least) == "short");
  CHECK(verdict({5}, Sense::at_most) == "met");
  CHECK(verdict({5.1}, Sense::at_most) == "short");
}

TEST_CASE("rows of the table: median and quartiles; one value alone; what was skipped and why") {
  nlohmann::ordered_json figures = nlohmann::ordered_json::array();
  figures.push_back(figure_json({.title = "time", .values = {6, 5, 7}, .goal = 5, .sense = Sense::at_least}));
  figures.push_back(figure_json({.title = "RMS", .values = {0.98}, .goal = 1, .sense = Sense::at_most}));
  figures.push_back(figure_json({.title = "rival", .goal = 3, .sense = Sense::at_least, .skipped = "not here"}));
  CHECK(figure_table(figures) ==
        "| figure | measured (quartiles) | wanted | |\n|---|---|---|---|\n"
        "| time | **6.000** (5.000–6.000) | ≥ 5 | met |\n"
        "| RMS | **0.980** | ≤ 1 | met |\n"
        "| rival | | ≥ 3 | skipped: not here |\n");
}
