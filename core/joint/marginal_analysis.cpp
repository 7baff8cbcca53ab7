#include "core/joint/marginal_analysis.h"

#include <algorithm>
#include <array>

#include "core/base/error.h"
#include "core/joint/error_table.h"

namespace etalon::joint {
namespace {

__extension__ using Int128 = __int128;

// A path in terms of the distinct levels, in either direction: positions run from 0 at the start to the last level at the end.
class Walk {
 public:
  Walk(const Problem& problem, Direction direction)
      : problem_(problem), table_(problem), meshes_(distinct_levels(problem.mesh_bits)), textures_(distinct_levels(problem.texture_bits)) {
    if (direction == Direction::prune) std::reverse(meshes_.begin(), meshes_.end()), std::reverse(textures_.begin(), textures_.end());
  }

  struct Place {
    std::size_t mesh = 0, texture = 0;
  };

  [[nodiscard]] Pair pair(Place at) const { return {meshes_[at.mesh], textures_[at.texture]}; }
  [[nodiscard]] std::uint64_t error(Place at) { return table_.at(pair(at)); }
  [[nodiscard]] std::uint64_t mesh_bits(std::size_t position) const { return problem_.mesh_bits[meshes_[position]]; }
  [[nodiscard]] std::uint64_t texture_bits(std::size_t position) const { return problem_.texture_bits[textures_[position]]; }
  [[nodiscard]] std::uint64_t bits(Place at) const { return mesh_bits(at.mesh) + texture_bits(at.texture); }
  [[nodiscard]] bool mesh_is_left(Place at) const { return at.mesh + 1 < meshes_.size(); }
  [[nodiscard]] bool texture_is_left(Place at) const { return at.texture + 1 < textures_.size(); }
  [[nodiscard]] std::size_t level_count() const { return meshes_.size() + textures_.size(); }
  [[nodiscard]] Place last() const { return {meshes_.size() - 1, textures_.size() - 1}; }

  void store(Place at) {
    PathPoint point{pair(at), bits(at), {}};
    if (table_.is_known(point.pair)) point.error = table_.at(point.pair);
    points_.push_back(point);
  }
  void store_border(Place at) {
    while (mesh_is_left(at)) ++at.mesh, store(at);
    while (texture_is_left(at)) ++at.texture, store(at);
  }
  [[nodiscard]] Path finished() {
    Path path{std::move(points_), table_.evaluations()};
    if (path.points.size() > 1 && path.points.front().bits > path.points.back().bits) std::reverse(path.points.begin(), path.points.end());
    return path;
  }

 private:
  const Problem& problem_;
  ErrorTable table_;
  std::vector<std::size_t> meshes_, textures_;
  std::vector<PathPoint> points_;
};

// A step's signed rise of error, and its bits, removed or added.
struct Price {
  std::int64_t rise = 0;
  std::uint64_t bits = 0;
};

std::uint64_t difference(std::uint64_t a, std::uint64_t b) { return a > b ? a - b : b - a; }

// rise/bits of a <= that of b. Pruning takes the least rise per bit removed. Growing takes the greatest fall per bit added, which is the least
// (signed) rise per bit too: one comparison serves both. |rise| and bits are below 2^63, so the products are below 2^126.
bool pays_at_least(const Price& a, const Price& b) { return Int128{a.rise} * Int128{b.bits} <= Int128{b.rise} * Int128{a.bits}; }

// The nearest position after `from` whose bits differ by at least `wanted`, or the last.
template <class Bits>
std::size_t position_after(std::size_t from, std::size_t last, std::uint64_t wanted, const Bits& bits) {
  std::size_t to = from + 1;
  while (to < last && difference(bits(from), bits(to)) < wanted) ++to;
  return to;
}

Walk::Place best_by_levels(Walk& walk, Walk::Place at, StepRule rule) {
  const Walk::Place by_mesh{at.mesh + 1, at.texture}, by_texture{at.mesh, at.texture + 1};
  const std::uint64_t mesh_error = walk.error(by_mesh), texture_error = walk.error(by_texture);
  if (rule == StepRule::printed) return mesh_error <= texture_error ? by_mesh : by_texture;
  const auto now = static_cast<std::int64_t>(walk.error(at));
  const Price mesh{static_cast<std::int64_t>(mesh_error) - now, difference(walk.bits(at), walk.bits(by_mesh))};
  const Price texture{static_cast<std::int64_t>(texture_error) - now, difference(walk.bits(at), walk.bits(by_texture))};
  return pays_at_least(mesh, texture) ? by_mesh : by_texture;
}

Walk::Place best_by_budget(Walk& walk, Walk::Place at, std::uint64_t budget) {
  const auto mesh_after = [&](std::uint64_t wanted) {
    return position_after(at.mesh, walk.last().mesh, wanted, [&](std::size_t n) { return walk.mesh_bits(n); });
  };
  const auto texture_after = [&](std::uint64_t wanted) {
    return position_after(at.texture, walk.last().texture, wanted, [&](std::size_t n) { return walk.texture_bits(n); });
  };
  const std::uint64_t half = budget / 2 + budget % 2;
  const std::array<Walk::Place, 3> places = {Walk::Place{mesh_after(budget), at.texture}, Walk::Place{at.mesh, texture_after(budget)},
                                             Walk::Place{mesh_after(half), texture_after(half)}};
  const auto now = static_cast<std::int64_t>(walk.error(at));
  Walk::Place best = places[0];
  Price best_price;
  for (const Walk::Place& place : places) {
    const Price price{static_cast<std::int64_t>(walk.error(place)) - now, difference(walk.bits(at), walk.bits(place))};
    if (best_price.bits == 0 || !pays_at_least(best_price, price)) best = place, best_price = price;
  }
  return best;
}

}  // namespace

Path marginal_analysis(const Problem& problem, const SearchOptions& options) {
  validate(problem);
  Walk walk(problem, options.direction);
  Walk::Place at;
  std::uint64_t budget = options.budget_bits;
  if (budget == 0) budget = std::max<std::uint64_t>(1, difference(walk.bits(at), walk.bits(walk.last())) / walk.level_count());
  const bool has_choice = walk.mesh_is_left(at) && walk.texture_is_left(at);
  if (has_choice) (void)walk.error(at);  // the largest (smallest) pair's own error is known, whatever the rule
  walk.store(at);
  while (walk.mesh_is_left(at) && walk.texture_is_left(at)) {
    at = options.rule == StepRule::budget ? best_by_budget(walk, at, budget) : best_by_levels(walk, at, options.rule);
    walk.store(at);
  }
  walk.store_border(at);
  return walk.finished();
}

Path one_sided_path(const Problem& problem, OneSided order) {
  validate(problem);
  Walk walk(problem, Direction::prune);
  Walk::Place at;
  walk.store(at);
  if (order == OneSided::texture_pruned_first)
    while (walk.texture_is_left(at)) ++at.texture, walk.store(at);
  walk.store_border(at);
  return walk.finished();
}

Path independent_path(const Problem& problem) {
  validate(problem);
  Walk walk(problem, Direction::prune);
  Walk::Place at;
  const auto rise = [&](Walk::Place from, Walk::Place to) {
    return static_cast<std::int64_t>(walk.error(to)) - static_cast<std::int64_t>(walk.error(from));
  };
  (void)walk.error(at);
  walk.store(at);
  while (walk.mesh_is_left(at) && walk.texture_is_left(at)) {
    const Price mesh{rise({at.mesh, 0}, {at.mesh + 1, 0}), difference(walk.mesh_bits(at.mesh), walk.mesh_bits(at.mesh + 1))};
    const Price texture{rise({0, at.texture}, {0, at.texture + 1}),
                        difference(walk.texture_bits(at.texture), walk.texture_bits(at.texture + 1))};
    pays_at_least(mesh, texture) ? ++at.mesh : ++at.texture;
    walk.store(at);
  }
  walk.store_border(at);
  return walk.finished();
}

}  // namespace etalon::joint
