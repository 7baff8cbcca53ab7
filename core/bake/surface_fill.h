// Where each texel that no vertex hit takes its colour from: the nearest hit texel on the surface [Soucy, Godin & Rioux 1996, sec. 4].
//
// The graph: nodes are texels, those that continuity equates being one; any two nodes of one triangle are joined by an arc as long as their
// centres are apart in space (the least over their texels in that triangle); so crossing an edge costs nothing, as in the paper. The distance of a
// node is the length of its shortest path to a hit one; of equally near ones the hit node with the lower texel counts.
#pragma once

#include <functional>

#include "core/bake/texel_colors.h"
#include "core/bake/texel_metric.h"

namespace etalon::bake {

inline constexpr std::uint64_t kNoDistance = ~std::uint64_t{0};

struct SurfaceFill {
  /// #T: the texel that stands for the node whose colour it takes; a hit one's own.
  std::vector<std::uint32_t> source;
  /// #T, in steps of the metric's grid; 0 for a hit texel.
  std::vector<std::uint64_t> distance;
  /// #T, of the iterative fill: the texel of the same triangle, hit or on a side, that the distance was measured from; itself for these.
  std::vector<std::uint32_t> feature;
  int iterations = 0;  ///< of the iterative fill, the last one changing nothing
};

/// What a fill reads. Every part of the surface that edges or vertices join must have a hit texel; those of scans do: their corners.
struct FillProblem {
  const Atlas& atlas;
  const TexelNodes& nodes;
  const TexelColors& colors;
  const TexelMetric& metric;
};

/// The least distances and their sources, exactly, in whole grid steps.
///
/// Not all arcs are walked, and nothing is lost: paths change triangles only in nodes of several texels, and within one triangle the straight
/// arc is never longer than one that stops between (the rounded-up metric obeys the triangle inequality). So it is enough to search, for
/// each texel on a side, the nearest hit texel of its own triangle; to run Dijkstra's algorithm over the nodes on sides; and to let every
/// other texel choose between its own triangle's hits and the side texels by which something nearer came in from outside, by a k-d tree of
/// these (source_tree.h). A side texel that was itself reached straight through this triangle brings nothing that its origin does not.
/// Time: about n log n in texels, and every pair of one triangle's side texels once.
[[nodiscard]] SurfaceFill fill_exactly(const FillProblem& problem);

/// What the iteration has just done.
enum class FillStage : std::uint8_t {
  transformed,  ///< every triangle on its own: figures 6 and 8 of the paper
  propagated,   ///< every node took the best of its texels: figure 7
};
/// Sees the fill as it stands; kNoGroup and kNoDistance where nothing was found yet.
using FillObserver = std::function<void(FillStage stage, const SurfaceFill& now)>;

/// The paper's iteration: in each triangle an 8-neighbour Euclidean distance transform [Danielsson 1980] by distances in space, each texel
/// trying its neighbours' nearest feature; then every node takes the best that its texels found, and its texels become features with that distance
/// for an offset; until nothing changes. A distance is the length of a path of the graph above, so never below the exact one.
/// `observe` is called twice an iteration.
[[nodiscard]] SurfaceFill fill_iteratively(const FillProblem& problem, const FillObserver& observe = {});

/// Every texel's colour, by the fill. #T.
[[nodiscard]] std::vector<Rgb8> filled_colors(const TexelColors& colors, const SurfaceFill& fill);

}  // namespace etalon::bake
