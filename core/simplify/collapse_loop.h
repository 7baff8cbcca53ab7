// The strict loop: at each step the one legal half-edge collapse of least (cost, vertex, target), over the whole mesh.
#pragma once

#include <limits>

#include "core/simplify/collapse_candidate.h"
#include "core/simplify/strict_loop.h"

namespace etalon::simplify {

/// Metric: double cost(u, v, half-edge between them) (never NaN, ≥ 0), of the states of u and v and the faces of u; costs(u, candidates),
/// of all; collapse(u, v, edge), the state of v after u went into it, called before the faces change, by which no cost of a way to v falls;
/// and kCostsAreLocal: whether a cost leaves the other faces of u out, so that a vertex that loses a neighbour keeps its other costs. Where
/// costs are dear it may have, in place of costs(): surround(u, all neighbours), then bound_of(i), never above the cost of the way to the
/// i-th as computed, and cost_of(i), the bits of that cost.
///
/// The queue holds for each vertex its least candidate not yet refused: a lower bound of its least legal one. What is popped is judged
/// then; a refused candidate gives way to the vertex' next one in the order (cost, target). A refusal can only become void when the faces of
/// the vertex change (the link condition of u→v eases only where u loses a neighbour, everything else depends on the faces of u and the
/// place of v), and then all its candidates are considered anew. So the first candidate that is legal when popped is the least of all. (One
/// exception: beside a place of several fans, where another fan's faces decide the link condition too, a collapse that becomes legal may be
/// seen late.)
template <class Metric>
class CollapseLoop : public StrictLoop {
 public:
  struct Step {
    std::uint32_t u = kNone, v = kNone;
    CollapseMesh::Edge edge;
    double cost = 0;
  };

  CollapseLoop(CollapseMesh& mesh, Metric& metric, Legality& legality) : StrictLoop(mesh, legality), metric_(metric) {
    fill_queue([&](std::uint32_t u) { return best_of(u); });
  }

  /// The next collapse, judged legal and not yet done; u is kNone where none is left. `accept(step)`: a last word, Refusal::none or
  /// another.
  template <class Accept>
  [[nodiscard]] Step find(const Accept& accept) {
    const auto step_of = [&](const QueuedCollapse& top) {
      return Step{top.vertex, top.target, mesh_.find_edge(top.vertex, top.target), top.cost};
    };
    const auto judge = [&](const Step& step) {
      const Refusal refusal = legality_.check(step.u, step.edge);
      return refusal == Refusal::none ? accept(step) : refusal;
    };
    return first_legal(step_of, judge, [&](const QueuedCollapse& top) { return least_behind(top.vertex, top.cost, top.target); });
  }
  [[nodiscard]] Step find() {
    return find([](const Step&) { return Refusal::none; });
  }

  /// Does what find() returned last.
  void apply(const Step& step) {
    queue_.remove(step.u);
    metric_.collapse(step.u, step.v, step.edge);
    mesh_.collapse(step.u, step.edge);
    requeue(best_of(step.v));
    // What was near u is near v now. Vertices that lost u as a neighbour: their faces changed. The others only see v dearer.
    mesh_.for_each_neighbor(step.v, [&](std::uint32_t w, std::uint32_t h) {
      if (legality_.was_near(w))
        refresh(w, h, step);
      else
        see_dearer_cost(w, step.v);
    });
  }

 private:
  static constexpr bool kHasBounds = requires(Metric & m) { m.bound_of(0); };

  // Calls visit(v, half-edge) for every neighbour that u's kind lets it go to.
  template <class Visit>
  void for_each_candidate(std::uint32_t u, const Visit& visit) const {
    const VertexKind kind = mesh_.kind(u);
    if (kind == VertexKind::locked || !mesh_.vertex_alive(u)) return;
    mesh_.for_each_neighbor(u, [&](std::uint32_t v, std::uint32_t h) {
      if (kind == VertexKind::interior || mesh_.on_curve(h)) visit(v, h);
    });
  }

  void gather(std::uint32_t u) {
    candidates_.clear();
    for_each_candidate(u, [&](std::uint32_t v, std::uint32_t h) { candidates_.push_back({v, h}); });
  }

  // All neighbours, and which of them it may go to.
  void gather_ring(std::uint32_t u) {
    ring_.clear();
    ways_.clear();
    const VertexKind kind = mesh_.kind(u);
    if (kind == VertexKind::locked || !mesh_.vertex_alive(u)) return;
    mesh_.for_each_neighbor(u, [&](std::uint32_t v, std::uint32_t h) {
      if (kind == VertexKind::interior || mesh_.on_curve(h)) ways_.push_back(static_cast<std::uint32_t>(ring_.size()));
      ring_.push_back({v, h});
    });
  }

  // The least candidate behind (cost, target).
  [[nodiscard]] QueuedCollapse least_behind(std::uint32_t u, double cost, std::uint32_t target) {
    QueuedCollapse best{std::numeric_limits<double>::infinity(), u, kNone};
    const auto consider = [&](double here, std::uint32_t v) {
      if (before(cost, target, here, v) && before(here, v, best.cost, best.target)) best = {here, u, v};
    };
    if constexpr (kHasBounds) {
      gather_ring(u);
      if (ways_.empty()) return best;
      metric_.surround(u, ring_);
      // Least bound first: where a bound is above the best cost, so is the cost.
      std::size_t first = ways_[0];
      for (const std::uint32_t i : ways_)
        if (metric_.bound_of(i) < metric_.bound_of(first)) first = i;
      consider(metric_.cost_of(first), ring_[first].target);
      for (const std::uint32_t i : ways_)
        if (i != first && !(metric_.bound_of(i) > best.cost)) consider(metric_.cost_of(i), ring_[i].target);
    } else {
      gather(u);
      metric_.costs(u, candidates_);
      for (const auto& [v, h, here] : candidates_) consider(here, v);
    }
    return best;
  }
  [[nodiscard]] QueuedCollapse best_of(std::uint32_t u) {
    refused_[u] = false;
    return least_behind(u, -1, 0);
  }

  // Whether u→v now comes before u's entry; then it takes its place.
  void see_cost(std::uint32_t u, std::uint32_t v, std::uint32_t h, const QueuedCollapse& entry) {
    const double cost = metric_.cost(u, v, h);
    if (before(cost, v, entry.cost, entry.target)) queue_.set({cost, u, v});
  }

  // w's faces changed. Without a refusal, and with its best elsewhere, only the way to v can have become better.
  void refresh(std::uint32_t w, std::uint32_t h, const Step& step) {
    if constexpr (Metric::kCostsAreLocal) {
      if (!refused_[w] && mesh_.kind(w) == VertexKind::interior && queue_.contains(w)) {
        if (!queue_.goes_to(w, step.u) && !queue_.goes_to(w, step.v)) return see_cost(w, step.v, h, queue_.of(w));
      }
    }
    requeue(best_of(w));
  }

  // v's state changed, w's faces did not: the way to v has become dearer or stayed, so only an entry that is that way is not the least any
  // more.
  void see_dearer_cost(std::uint32_t w, std::uint32_t v) {
    if (queue_.goes_to(w, v)) requeue(best_of(w));
  }

  Metric& metric_;
  std::vector<CollapseCandidate> candidates_, ring_;
  std::vector<std::uint32_t> ways_;  // of the ring, which u may go to
};

}  // namespace etalon::simplify
