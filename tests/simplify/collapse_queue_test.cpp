#include "core/simplify/collapse_queue.h"

#include <doctest/doctest.h>

#include <map>

#include "core/base/rng.h"

using namespace etalon;
using namespace etalon::simplify;

TEST_CASE("equal costs come out by vertex") {
  CollapseQueue queue(5);
  for (const std::uint32_t v : {3u, 0u, 4u, 1u}) queue.set({1.0, v, v});
  for (const std::uint32_t v : {0u, 1u, 3u, 4u}) {
    CHECK(queue.top().vertex == v);
    queue.remove(v);
  }
  CHECK(queue.empty());
  queue.remove(2);  // of what is not there: nothing
  CHECK(queue.empty());
}

TEST_CASE("against a sorted map: 20,000 random insertions, changes and removals") {
  Rng rng(11);
  CollapseQueue queue(100);
  std::map<std::uint32_t, double> model;
  std::vector<QueuedCollapse> start;
  for (std::uint32_t v = 0; v < 100; v += 3) {
    model[v] = static_cast<double>(rng.below(20));
    start.push_back({model[v], v, 0});
  }
  queue.assign(start);
  for (int i = 0; i < 20000; ++i) {
    const auto v = static_cast<std::uint32_t>(rng.below(100));
    if (rng.below(3) == 0) {
      queue.remove(v);
      model.erase(v);
    } else {
      model[v] = static_cast<double>(rng.below(20));
      queue.set({model[v], v, static_cast<std::uint32_t>(i)});
    }
    REQUIRE(queue.size() == model.size());
    REQUIRE(queue.contains(v) == model.contains(v));
    if (model.empty()) continue;
    auto least = model.begin();
    for (auto at = model.begin(); at != model.end(); ++at)
      if (at->second < least->second) least = at;
    REQUIRE(queue.top().vertex == least->first);
    REQUIRE(queue.top().cost == least->second);
  }
  CHECK(queue.ok());
}
