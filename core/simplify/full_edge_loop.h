// The strict loop of full-edge collapses: at each step the one legal edge collapse of least (cost, lower end, higher end), over the whole
// mesh.
// [Garland & Heckbert 1997]; [Kim, Choi & Lee 2008, figure 1a].
#pragma once

#include <limits>
#include <vector>

#include "core/simplify/moved_vertex.h"
#include "core/simplify/placement.h"
#include "core/simplify/strict_loop.h"

namespace etalon::simplify {

/// Metric: as for CollapseLoop, its costs local; Placement place(u, v, edge), void merge(u, v, edge, placement) (before v moves), and
/// void adopt(placement, u, v, edge, MovedVertex&), which overwrites what the metric chose itself.
///
/// An edge of two interior vertices, or on a curve, becomes one vertex where the metric places it: the lower vertex stays and moves. Where
/// only one
/// end may go (an interior vertex beside a curve, a curve vertex beside a locked one) it goes into the other as a half-edge.
///
/// The queue holds for each vertex the least of its edges to higher vertices not yet refused. A refusal may become void when the faces of
/// either end change, by a vertex lost or one moved: then all refused edges at that vertex are considered anew.
template <class Metric>
class FullEdgeLoop : public StrictLoop {
 public:
  struct Step {
    std::uint32_t u = kNone, v = kNone;
    CollapseMesh::Edge edge;
    double cost = 0;
    bool moves = false;
    Placement placement;
    MovedVertex moved;
  };

  FullEdgeLoop(CollapseMesh& mesh, UnitPositions& positions, Metric& metric, Legality& legality)
      : StrictLoop(mesh, legality), positions_(positions), metric_(metric), refused_at_(mesh.vertex_capacity(), false) {
    fill_queue([&](std::uint32_t v) { return best_of(v); });
  }

  /// The next collapse, judged legal and not yet done; u is kNone where none is left. `accept(step)`: a last word, Refusal::none or
  /// another.
  template <class Accept>
  [[nodiscard]] Step find(const Accept& accept) {
    const auto judge = [&](const Step& step) {
      const Refusal refusal = step.moves ? legality_.check_move(step.u, step.v, step.edge, step.moved) : legality_.check(step.u, step.edge);
      return refusal == Refusal::none ? accept(step) : refusal;
    };
    return first_legal([&](const QueuedCollapse& top) { return step_of(top); }, judge,
                       [&](const QueuedCollapse& top) {
                         refused_at_[top.vertex] = refused_at_[top.target] = true;
                         return least_behind(top.vertex, top.cost, top.target);
                       });
  }
  [[nodiscard]] Step find() {
    return find([](const Step&) { return Refusal::none; });
  }

  /// Does what find() returned last.
  void apply(const Step& step) {
    queue_.remove(step.u);
    if (step.moves) {
      metric_.merge(step.u, step.v, step.edge, step.placement);
      move_vertex(mesh_, positions_, step.v, step.edge, step.moved);
    } else {
      metric_.collapse(step.u, step.v, step.edge);
    }
    mesh_.collapse(step.u, step.edge);
    // Faces changed: at what was near u, and, where v moved, at all that is near it now.
    revive(step.v);
    mesh_.for_each_neighbor(step.v, [&](std::uint32_t n, std::uint32_t) {
      if (step.moves || legality_.was_near(n)) revive(n);
    });
    requeue(best_of(step.v));
    mesh_.for_each_neighbor(step.v, [&](std::uint32_t n, std::uint32_t h) { see_new_cost(n, h, step); });
  }

  /// What the edge of half-edge h between a and b would become: u is kNone where nothing.
  [[nodiscard]] Step way_of(std::uint32_t a, std::uint32_t b, std::uint32_t h) const {
    const VertexKind kind_a = mesh_.kind(a), kind_b = mesh_.kind(b);
    const bool on_curve = mesh_.on_curve(h);
    const auto may_go = [&](VertexKind kind) { return kind == VertexKind::interior || (kind == VertexKind::curve && on_curve); };
    const bool a_goes = may_go(kind_a), b_goes = may_go(kind_b);
    Step step;
    if (kind_a == kind_b && a_goes) {
      step.v = a < b ? a : b;
      step.u = a < b ? b : a;
      step.edge = mesh_.edge_from(step.u, h);
      step.moves = true;
      if (!sides_fit(step.edge)) step.u = kNone;
    } else if (a_goes && (kind_a == VertexKind::interior || !b_goes)) {
      step.u = a;
      step.v = b;
      step.edge = mesh_.edge_from(a, h);
    } else if (b_goes) {
      step.u = b;
      step.v = a;
      step.edge = mesh_.edge_from(b, h);
    }
    return step;
  }

 private:
  // Where u has two wedges and v one for both sides, v has no place in texture space that would do for both.
  [[nodiscard]] bool sides_fit(const CollapseMesh::Edge& edge) const {
    if (!mesh_.textured() || edge.face_count() < 2) return true;
    return mesh_.wedge(CollapseMesh::next(edge.left)) != mesh_.wedge(edge.right) ||
           mesh_.wedge(edge.left) == mesh_.wedge(CollapseMesh::next(edge.right));
  }

  [[nodiscard]] double cost_of(std::uint32_t a, std::uint32_t b, std::uint32_t h) const {
    const Step step = way_of(a, b, h);
    if (step.u == kNone) return std::numeric_limits<double>::infinity();
    return step.moves ? metric_.place(step.u, step.v, step.edge).cost : metric_.cost(step.u, step.v, h);
  }

  [[nodiscard]] Step step_of(const QueuedCollapse& entry) const {
    Step step;
    mesh_.for_each_neighbor(entry.vertex, [&](std::uint32_t n, std::uint32_t h) {
      if (n == entry.target) step = way_of(entry.vertex, n, h);
    });
    step.cost = entry.cost;
    if (!step.moves) return step;
    step.placement = metric_.place(step.u, step.v, step.edge);
    step.moved = carried(mesh_, positions_, step.u, step.v, step.edge, step.placement.at);
    metric_.adopt(step.placement, step.u, step.v, step.edge, step.moved);
    return step;
  }

  // The least edge to a higher vertex behind (cost, target).
  [[nodiscard]] QueuedCollapse least_behind(std::uint32_t v, double cost, std::uint32_t target) const {
    QueuedCollapse best{std::numeric_limits<double>::infinity(), v, kNone};
    if (!mesh_.vertex_alive(v)) return best;
    mesh_.for_each_neighbor(v, [&](std::uint32_t n, std::uint32_t h) {
      if (n < v) return;
      const double here = cost_of(v, n, h);
      if (here == std::numeric_limits<double>::infinity()) return;
      if (before(cost, target, here, n) && before(here, n, best.cost, best.target)) best = {here, v, n};
    });
    return best;
  }
  [[nodiscard]] QueuedCollapse best_of(std::uint32_t v) {
    refused_[v] = false;
    return least_behind(v, -1, 0);
  }

  void revive(std::uint32_t v) {
    if (!refused_at_[v]) return;
    refused_at_[v] = false;
    if (refused_[v]) requeue(best_of(v));
    mesh_.for_each_neighbor(v, [&](std::uint32_t n, std::uint32_t) {
      if (n < v && refused_[n]) requeue(best_of(n));
    });
  }

  void see_new_cost(std::uint32_t n, std::uint32_t h, const Step& step) {
    if (!queue_.contains(n)) return requeue(best_of(n));
    const QueuedCollapse& entry = queue_.of(n);
    if (entry.target == step.u || entry.target == step.v) return requeue(best_of(n));
    if (n > step.v) return;
    const double cost = cost_of(n, step.v, h);
    if (before(cost, step.v, entry.cost, entry.target)) queue_.set({cost, n, step.v});
  }

  UnitPositions& positions_;
  Metric& metric_;
  std::vector<bool> refused_at_;  // whether an edge at the vertex was refused since its faces changed last
};

}  // namespace etalon::simplify
