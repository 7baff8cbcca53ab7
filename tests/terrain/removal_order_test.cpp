#include "core/terrain/removal_order.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/terrain/levels.h"
#include "core/terrain/quadtree.h"
#include "core/terrain/terrain_view.h"
#include "tests/terrain/terrain_fixture.h"

using namespace etalon;
using namespace etalon::terrain;

namespace {

// What is left of v's domain among `there`, by search.
std::set<std::uint32_t> domain(int bits, std::uint32_t v, const std::set<std::uint32_t>& there) {
  std::set<std::uint32_t> found{v};
  std::vector<std::uint32_t> open{v};
  while (!open.empty()) {
    const GridPoint p = point_at(bits, open.back());
    open.pop_back();
    for_each_child(bits, p, split_of(bits, p), [&](GridPoint q) {
      const std::uint32_t c = point_index(bits, q);
      if (there.contains(c) && found.insert(c).second) open.push_back(c);
    });
  }
  return found;
}

// The rule as it is written, every ratio made anew at every step.
std::vector<std::uint32_t> order_by_definition(int bits, const std::vector<std::int64_t>& costs) {
  std::set<std::uint32_t> there;
  const auto level = [&](std::uint32_t v) { return split_of(bits, point_at(bits, v)).level; };
  for (std::uint32_t v = 0; v < costs.size(); ++v)
    if (level(v) >= 0) there.insert(v);
  std::vector<std::uint32_t> order;
  while (!there.empty()) {
    double least = 0;
    std::uint32_t best = 0;
    bool found = false;
    for (const std::uint32_t v : there) {
      std::int64_t sum = 0;
      const std::set<std::uint32_t> points = domain(bits, v, there);
      for (const std::uint32_t d : points) sum += costs[d];
      const double ratio = static_cast<double>(sum) / static_cast<double>(points.size());
      if (!found || ratio < least || (ratio == least && level(v) > level(best))) least = ratio, best = v, found = true;
    }
    const std::set<std::uint32_t> gone = domain(bits, best, there);
    std::vector<std::uint32_t> sorted(gone.begin(), gone.end());
    std::sort(sorted.begin(), sorted.end(), [&](std::uint32_t a, std::uint32_t b) {
      if (level(a) != level(b)) return level(a) > level(b);
      return costs[a] != costs[b] ? costs[a] < costs[b] : a < b;
    });
    for (const std::uint32_t v : sorted) order.push_back(v), there.erase(v);
  }
  return order;
}

void check_is_order(const HeightField& field, const RemovalOrder& order) {
  REQUIRE(order.points.size() + 4 == field.point_count());
  std::vector<std::size_t> place(field.point_count(), field.point_count());
  for (std::size_t n = 0; n < order.points.size(); ++n) {
    REQUIRE(place[order.points[n]] == field.point_count());
    place[order.points[n]] = n;
  }
  for (const std::uint32_t v : order.points) {
    const GridPoint p = point_at(field.bits, v);
    for_each_child(field.bits, p, split_of(field.bits, p), [&](GridPoint c) { CHECK(place[point_index(field.bits, c)] < place[v]); });
  }
}

}  // namespace

TEST_CASE("merge costs: by hand on 5x5 with one peak") {
  HeightField field = test::random_field(2, 0, 1);
  field.unit = 1;
  field.heights[field.index(1, 1)] = 6;  // a middle of level 2: splits the diagonal (0,0)-(2,2)
  const MergeCosts merge = merge_costs(field);
  const auto cost = [&](int i, int j) { return static_cast<double>(merge.costs[field.index(i, j)]) * merge.quantum; };
  // Its four children split edges of length 2 from (1,1): each lies 3 below the edge's middle, in two triangles, half in each.
  // Without them the surface is 3 too high at each: cost 9 each. Then without the peak: 36 for the peak, less 4·9 for what is right again.
  CHECK(cost(1, 0) == 0);  // its edge runs along the border, from corner to corner of its square
  CHECK(cost(1, 1) == 36);
  double total = 0;
  for (const std::int64_t c : merge.costs) total += static_cast<double>(c) * merge.quantum;
  CHECK(total == 36);  // what is left is the plane 0: only the peak is missed
}

TEST_CASE("merge costs: the distortion of any level is the sum of the costs of what it lacks") {
  for (const bool rough : {false, true}) {
    const HeightField field = rough ? test::rough_field(5) : test::random_field(5, 5000, 3);
    for (const PruningRule rule : {PruningRule::merging_domains, PruningRule::saturated}) {
      const RemovalOrder order = removal_order(field, {.rule = rule});
      double sum = 0;
      std::size_t gone = 0;
      for (const std::uint32_t count : {1000u, 700u, 333u, 100u, 20u, 4u}) {
        for (; field.point_count() - gone > count; ++gone) sum += static_cast<double>(order.costs[gone]);
        const LevelError error = level_error(field, make_levels(field.bits, order, std::vector<std::uint32_t>{count}), 0);
        const double direct = error.rms_m * error.rms_m * static_cast<double>(field.point_count());
        // Sums of 1,089 squares in double: a relative 1e-12 covers both orders of summing.
        CHECK(std::fabs(sum * order.quantum - direct) <= 1e-12 * direct + 1e-9);
      }
    }
  }
}

TEST_CASE("merging domains: the heap does what the rule says, with and without ties") {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const int bits = seed % 3 == 2 ? 3 : 2;
    // Heights of 0 and ±1 make many equal ratios, also negative and zero ones.
    const HeightField field = test::random_field(bits, seed % 2 == 0 ? 1 : 400, seed);
    const RemovalOrder order = removal_order(field);
    CHECK(order.points == order_by_definition(bits, merge_costs(field).costs));
    check_is_order(field, order);
  }
  const HeightField flat = test::random_field(3, 0, 1);
  CHECK(removal_order(flat).points == order_by_definition(3, merge_costs(flat).costs));
}

TEST_CASE("saturated: by rising error, the greatest of the domain") {
  const HeightField field = test::rough_field(4);
  const RemovalOrder order = removal_order(field, {.rule = PruningRule::saturated});
  check_is_order(field, order);
  const std::vector<double> errors = split_errors(field);
  std::set<std::uint32_t> all(order.points.begin(), order.points.end());
  double before = 0;
  for (const std::uint32_t v : order.points) {
    double saturated = 0;
    for (const std::uint32_t d : domain(field.bits, v, all)) saturated = std::max(saturated, errors[d]);
    CHECK(saturated >= before);
    before = saturated;
  }
  // By hand: the middle of the field against the diagonal's ends.
  const double middle_m = field.height(8, 8) * field.unit, ends_m = (field.height(0, 0) + field.height(16, 16)) * field.unit / 2;
  CHECK(errors[field.index(8, 8)] == std::fabs(middle_m - ends_m));
}

TEST_CASE("weights: where they are 0 points go first; screen weights are used by both rules") {
  const HeightField field = test::rough_field(5);
  const std::vector<double> weights = screen_weights(field, test::low_view(field));
  for (const PruningRule rule : {PruningRule::merging_domains, PruningRule::saturated}) {
    const RemovalOrder order = removal_order(field, {.rule = rule, .weights = weights});
    check_is_order(field, order);
    const Levels levels = make_levels(field.bits, order, std::vector<std::uint32_t>{200});
    std::size_t visible = 0, kept = 0, kept_visible = 0;
    for (std::size_t v = 0; v < weights.size(); ++v) {
      visible += weights[v] > 0;
      kept += levels.first_level[v] == 0;
      kept_visible += weights[v] > 0 && levels.first_level[v] == 0;
    }
    CHECK(visible * 3 < weights.size());
    // The frustum keeps more than twice the share of its points that the rest does, which only holds what the frustum's points need.
    CHECK(kept_visible * (weights.size() - visible) > 2 * (kept - kept_visible) * visible);
  }
  const std::vector<double> nothing(field.point_count(), 0.0);
  check_is_order(field, removal_order(field, {.weights = nothing}));
}

TEST_CASE("removal order: the same for any number of threads; wrong weights are refused") {
  const HeightField field = test::rough_field(6);
  const std::vector<double> weights = screen_weights(field, test::low_view(field));
  set_thread_count(1);
  const RemovalOrder one = removal_order(field, {.weights = weights});
  set_thread_count(3);
  const RemovalOrder three = removal_order(field, {.weights = weights});
  set_thread_count(0);
  CHECK(one.points == three.points);
  CHECK(one.costs == three.costs);
  CHECK(one.quantum == three.quantum);
  CHECK_THROWS_AS((void)removal_order(field, {.weights = std::span(weights).first(5)}), InputError);
  std::vector<double> bad = weights;
  bad[7] = -1;
  CHECK_THROWS_AS((void)removal_order(field, {.weights = bad}), InputError);
  bad[7] = std::nan("");
  CHECK_THROWS_AS((void)split_errors(field, bad), InputError);
}

TEST_CASE("removal order: it says how far it is") {
  const HeightField field = test::random_field(8, 0, 1);
  std::size_t calls = 0, last = 0;
  const auto progress = [&](std::size_t done, std::size_t total) {
    CHECK(done >= last);
    CHECK(total == field.point_count() - 4);
    last = done;
    ++calls;
  };
  (void)removal_order(field, {.progress = progress});
  CHECK(calls > 0);
}
