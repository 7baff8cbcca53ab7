#include "tests/bench/timing.h"

#include <doctest/doctest.h>

#include "core/base/error.h"
#include "tests/bench/limits.h"

using namespace etalon;
using namespace etalon::bench;

TEST_CASE("timing: ways take turns") {
  std::string order;
  std::vector<Way> ways = {{"a", [&] { order += 'a'; }, {}}, {"b", [&] { order += 'b'; }, {}}};
  for (int round = 0; round < 3; ++round) measure_round(ways);
  CHECK(order == "ababab");
  CHECK(ways[0].milliseconds.size() == 3);
  for (const double time : ways[1].milliseconds) CHECK(time >= 0);
}

TEST_CASE("timing: short runs follow one another in a turn") {
  int runs = 0;
  std::vector<Way> ways = {{"short", [&] { ++runs; }, {}}, {"long", [] {}, {}}};
  measure_round(ways);
  ways[0].milliseconds = {kLeastTurn_ms / 2.5}, ways[1].milliseconds = {2 * kLeastTurn_ms};
  choose_runs(ways);
  CHECK(ways[0].runs == 3);
  CHECK(ways[1].runs == 1);
  CHECK(ways[0].milliseconds.empty());
  runs = 0;
  measure_round(ways);
  CHECK(runs == 3);
  CHECK(ways[0].milliseconds.size() == 1);
}

TEST_CASE("timing: median, quartiles, ratios of the same round") {
  CHECK(median({3}) == 3);
  CHECK(median({9, 1, 2}) == 2);
  CHECK(median({4, 1, 2, 9}) == 3);
  const Quartiles q = quartiles({5, 1, 4, 2, 3});
  CHECK(q.lower == 2);
  CHECK(q.upper == 4);
  CHECK(quartiles({7}).lower == 7);
  CHECK(ratios({6, 8}, {3, 2}) == std::vector<double>{2, 4});
}

TEST_CASE("limits: every way to gather reads the same, for either size and order") {
  for (const std::size_t element_bytes : {4, 8})
    for (const GatherOrder order : {GatherOrder::affine, GatherOrder::random}) {
      // The constructor compares all ways that this machine has and throws where they differ.
      GatherLimit gather(5000, 128 * 128, element_bytes, order);
      CHECK_FALSE(gather.method().empty());
      CHECK_NOTHROW(gather.run());
    }
  CHECK_THROWS_AS(GatherLimit(5000, 4096, 16, GatherOrder::affine), InternalError);
}

TEST_CASE("limits: copies of nothing and of odd sizes") {
  for (const std::size_t bytes : {std::size_t{0}, std::size_t{1}, (std::size_t{1} << 18) + 7}) CHECK_NOTHROW(CopyLimit(bytes).run());
}
