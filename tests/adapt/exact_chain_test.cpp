// The judge of the chain of cells: rational numbers, no rounding anywhere, no code shared with core/adapt but the stored float32.
#include <doctest/doctest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <optional>

#include "core/base/rng.h"
#include "tests/adapt/level_fixture.h"

using namespace etalon;
using namespace etalon::adapt;

namespace {

using Rational = boost::multiprecision::cpp_rational;

struct Point {
  Rational x, y;
  friend bool operator==(const Point&, const Point&) = default;
};

Point exact(const Vec2f& p) { return {Rational(p.x), Rational(p.y)}; }

Rational cross(const Point& o, const Point& a, const Point& b) { return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x); }

// The image of p in the first cell that holds it, borders included.
std::optional<Point> mapped(const RingCells& cells, bool to_before, const Point& p) {
  const double x = p.x.convert_to<double>(), y = p.y.convert_to<double>();
  for (const auto& cell : cells.cells) {
    const CellNode* const n[3] = {&cells.nodes[cell[0]], &cells.nodes[cell[1]], &cells.nodes[cell[2]]};
    const auto from = [&](int k) -> const Vec2f& { return to_before ? n[k]->after : n[k]->before; };
    const auto to = [&](int k) -> const Vec2f& { return to_before ? n[k]->before : n[k]->after; };
    // Far outside in double, by more than conversion rounds: outside.
    const auto beside = [&](double at, float Vec2f::*axis) {
      constexpr double kMargin = 0x1p-40;
      return (at < from(0).*axis - kMargin && at < from(1).*axis - kMargin && at < from(2).*axis - kMargin) ||
             (at > from(0).*axis + kMargin && at > from(1).*axis + kMargin && at > from(2).*axis + kMargin);
    };
    if (beside(x, &Vec2f::x) || beside(y, &Vec2f::y)) continue;
    const Point a = exact(from(0)), b = exact(from(1)), c = exact(from(2));
    const Rational area = cross(a, b, c), v = cross(a, p, c) / area, w = cross(a, b, p) / area;
    if (v < 0 || w < 0 || v + w > 1) continue;
    const Point ta = exact(to(0)), tb = exact(to(1)), tc = exact(to(2));
    return Point{ta.x + v * (tb.x - ta.x) + w * (tc.x - ta.x), ta.y + v * (tb.y - ta.y) + w * (tc.y - ta.y)};
  }
  return std::nullopt;
}

struct Tally {
  int identical = 0, steps = 0, longest_bits = 0;
};

Tally there_and_back(const AdaptSequence& sequence, int points, int size) {
  Rng rng(5);
  Tally tally;
  for (int n = 0; n < points; ++n) {
    const int i = static_cast<int>(rng.below(static_cast<std::uint32_t>(size))),
              j = static_cast<int>(rng.below(static_cast<std::uint32_t>(size)));
    const Point start{Rational(2 * i + 1, 2 * size), Rational(2 * j + 1, 2 * size)};
    Point p = start;
    const auto through = [&](std::size_t split, bool to_before) {
      for (const ChartCells& chart : sequence.split(split))
        if (const auto q = mapped(chart.cells, to_before, p)) {
          p = *q, ++tally.steps;
          return;
        }
    };
    for (std::size_t split = sequence.size(); split-- > 0;) through(split, false);
    tally.longest_bits = std::max(tally.longest_bits, static_cast<int>(msb(denominator(p.x))) + 1);
    for (std::size_t split = 0; split < sequence.size(); ++split) through(split, true);
    tally.identical += p == start ? 1 : 0;
  }
  return tally;
}

}  // namespace

TEST_CASE("exact chain: down and up again is the identity in rational numbers, for 1,000 texels of the swirl") {
  const Tally tally = there_and_back(test::swirl().sequence, 1000, 512);
  MESSAGE(tally.steps << " cells passed; denominators at the base of up to " << tally.longest_bits << " bits");
  CHECK(tally.identical == 1000);
  CHECK(tally.steps > 10'000);
}
