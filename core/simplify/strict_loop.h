// What the loops of half-edge and full-edge collapses have in common: a queue of each vertex' least way not yet refused, judged at the top.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "core/simplify/collapse_queue.h"
#include "core/simplify/legality.h"

namespace etalon::simplify {

/// Base of CollapseLoop and FullEdgeLoop, which say what the ways of a vertex cost.
class StrictLoop {
 public:
  [[nodiscard]] const std::array<std::uint64_t, kRefusalCount>& refusals() const { return refusals_; }
  [[nodiscard]] const CollapseQueue& queue() const { return queue_; }

 protected:
  StrictLoop(CollapseMesh& mesh, Legality& legality)
      : mesh_(mesh), legality_(legality), queue_(mesh.vertex_capacity()), refused_(mesh.vertex_capacity(), false) {}

  /// Ways of one vertex: by cost, then target.
  static bool before(double cost_a, std::uint32_t a, double cost_b, std::uint32_t b) { return cost_a != cost_b ? cost_a < cost_b : a < b; }

  /// Every vertex' best_of(vertex), where it has one.
  template <class BestOf>
  void fill_queue(const BestOf& best_of) {
    std::vector<QueuedCollapse> entries;
    for (std::uint32_t v = 0; v < mesh_.vertex_capacity(); ++v)
      if (const QueuedCollapse entry = best_of(v); entry.target != kNone) entries.push_back(entry);
    queue_.assign(std::move(entries));
  }

  /// step_of(entry) of the first entry that judge(step) does not refuse, or a step of no vertex; one that is refused gives way to
  /// best_after(entry).
  template <class StepOf, class Judge, class BestAfter>
  auto first_legal(const StepOf& step_of, const Judge& judge, const BestAfter& best_after) {
    using Step = decltype(step_of(queue_.top()));
    while (!queue_.empty()) {
      const QueuedCollapse top = queue_.top();
      const Step step = step_of(top);
      const Refusal refusal = judge(step);
      if (refusal == Refusal::none) return step;
      ++refusals_[static_cast<std::size_t>(refusal)];
      refused_[top.vertex] = true;
      requeue(best_after(top));
    }
    return Step{};
  }

  void requeue(const QueuedCollapse& entry) {
    if (entry.target == kNone)
      queue_.remove(entry.vertex);
    else
      queue_.set(entry);
  }

  CollapseMesh& mesh_;
  Legality& legality_;
  CollapseQueue queue_;
  std::vector<bool> refused_;  // whether a vertex' entry stands behind a refused way
  std::array<std::uint64_t, kRefusalCount> refusals_{};
};

}  // namespace etalon::simplify
