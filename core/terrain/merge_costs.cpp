#include "core/terrain/merge_costs.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/terrain/quadtree.h"

namespace etalon::terrain {

namespace {

void check_weights(const HeightField& field, std::span<const double> weights) {
  if (weights.empty()) return;
  if (weights.size() != field.point_count())
    throw InputError(fmt::format("weights: expected one for each of {} points, got {}", field.point_count(), weights.size()));
  for (const double w : weights)
    if (!(w >= 0) || !std::isfinite(w)) throw InputError(fmt::format("weights: expected finite ones from 0 on, got {}", w));
}

class TriangleErrors {
 public:
  TriangleErrors(const HeightField& field, std::span<const double> weights) : field_(field), weights_(weights) {}

  // E(T) of apex, a, b. With legs along the axes the points are apex + x·e + y·f, x + y <= n; with the longest side along an axis they are
  // middle + s·e + t·f, |s| <= n − t. Heights of the plane are multiples of 2^-k units: exact.
  [[nodiscard]] double of(const GridTriangle& t) const {
    const double za = height(t.a), zb = height(t.b), zp = height(t.apex);
    double sum = 0;
    if (t.a.i != t.b.i && t.a.j != t.b.j) {
      const int n = std::abs(t.a.i - t.apex.i) + std::abs(t.a.j - t.apex.j);
      const GridPoint e{(t.a.i - t.apex.i) / n, (t.a.j - t.apex.j) / n}, f{(t.b.i - t.apex.i) / n, (t.b.j - t.apex.j) / n};
      const double slope_x = (za - zp) / n, slope_y = (zb - zp) / n;
      for (int y = 0; y <= n; ++y)
        for (int x = 0; x <= n - y; ++x) {
          const bool on_edge = x == 0 || y == 0 || x + y == n;
          sum += term({t.apex.i + x * e.i + y * f.i, t.apex.j + x * e.j + y * f.j}, zp + x * slope_x + y * slope_y, on_edge);
        }
      return sum;
    }
    const GridPoint m = middle(t);
    const int n = (std::abs(t.b.i - t.a.i) + std::abs(t.b.j - t.a.j)) / 2;
    const GridPoint e{(t.b.i - m.i) / n, (t.b.j - m.j) / n}, f{(t.apex.i - m.i) / n, (t.apex.j - m.j) / n};
    const double zm = (za + zb) / 2, slope_s = (zb - zm) / n, slope_t = (zp - zm) / n;
    for (int y = 0; y <= n; ++y)
      for (int s = y - n; s <= n - y; ++s) {
        const bool on_edge = y == 0 || s == y - n || s == n - y;
        sum += term({m.i + s * e.i + y * f.i, m.j + s * e.j + y * f.j}, zm + s * slope_s + y * slope_t, on_edge);
      }
    return sum;
  }

 private:
  [[nodiscard]] double height(GridPoint p) const { return field_.height(p.i, p.j); }

  // A point on an edge of the triangle counts half, its other half in the triangle beyond; on the grid's border there is none.
  [[nodiscard]] double term(GridPoint p, double plane, bool on_edge) const {
    const std::uint32_t index = field_.index(p.i, p.j);
    double error = (field_.heights[index] - plane) * field_.unit;
    if (!weights_.empty()) error *= weights_[index];
    const int s = field_.steps();
    const bool on_border = p.i == 0 || p.j == 0 || p.i == s || p.j == s;
    return (on_edge && !on_border) ? 0.5 * (error * error) : error * error;
  }

  const HeightField& field_;
  std::span<const double> weights_;
};

// Body(point, split) for every point but the corners, by rows on several threads.
template <class Body>
void for_each_split(const HeightField& field, const Body& body) {
  parallel_for(static_cast<std::size_t>(field.side()), [&](std::size_t row) {
    for (int i = 0; i < field.side(); ++i) {
      const GridPoint p{i, static_cast<int>(row)};
      const Split split = split_of(field.bits, p);
      if (split.level >= 0) body(p, split);
    }
  });
}

double cost_of(const HeightField& field, const TriangleErrors& errors, GridPoint p, const Split& split) {
  const GridPoint a{p.i - split.along.i, p.j - split.along.j}, b{p.i + split.along.i, p.j + split.along.j};
  double cost = 0;
  for_each_parent(field.bits, p, split, [&](GridPoint apex) {
    cost += errors.of({apex, a, b}) - errors.of({p, apex, a}) - errors.of({p, b, apex});
  });
  return cost;
}

}  // namespace

MergeCosts merge_costs(const HeightField& field, std::span<const double> weights) {
  validate(field);
  check_weights(field, weights);
  const TriangleErrors errors(field, weights);
  std::vector<double> costs(field.point_count());
  for_each_split(field, [&](GridPoint p, const Split& split) { costs[field.index(p.i, p.j)] = cost_of(field, errors, p, split); });

  double total = 0;
  for (const double c : costs) total += std::fabs(c);
  if (!std::isfinite(total)) throw InputError("weights: the distortion is too large for a double");
  MergeCosts result;
  result.costs.resize(costs.size());
  if (total == 0) return result;
  // Each cost is rounded by at most half a step and there are at most 2^25: total/quantum < 2^61 leaves room for all of them.
  int exponent = 0;
  (void)std::frexp(total, &exponent);
  result.quantum = std::ldexp(1.0, exponent - 61);
  for (std::size_t v = 0; v < costs.size(); ++v) result.costs[v] = static_cast<std::int64_t>(std::nearbyint(costs[v] / result.quantum));
  return result;
}

std::vector<double> split_errors(const HeightField& field, std::span<const double> weights) {
  validate(field);
  check_weights(field, weights);
  std::vector<double> errors(field.point_count());
  for_each_split(field, [&](GridPoint p, const Split& split) {
    const std::uint32_t index = field.index(p.i, p.j);
    const double ends = field.height(p.i - split.along.i, p.j - split.along.j) + field.height(p.i + split.along.i, p.j + split.along.j);
    const double error = std::fabs(field.heights[index] - ends / 2) * field.unit;
    errors[index] = weights.empty() ? error : error * weights[index];
  });
  return errors;
}

}  // namespace etalon::terrain
