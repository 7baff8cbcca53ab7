// Small surfaces with hits here and there, and a judge that finds the fill from the definition alone.
#pragma once

#include "core/bake/surface_fill.h"

namespace etalon::test {

/// A mesh with its atlas, in which chosen texels are hit.
struct FillCase {
  Mesh mesh;
  bake::Atlas atlas;
  bake::TexelNodes nodes;
  bake::TexelColors colors;
  bake::TexelMetric metric;
  [[nodiscard]] bake::FillProblem problem() const { return {atlas, nodes, colors, metric}; }

  /// Right angles at corners chosen by chance where `seed` is not 0; one texel in `rarity` is hit, and all corners where `corners`.
  FillCase(Mesh surface, const std::vector<double>& ratios, std::uint64_t seed, std::uint64_t rarity, bool corners = true);
  /// Hits by hand.
  FillCase(Mesh surface, const std::vector<double>& ratios, const std::vector<std::uint32_t>& hits);
};

/// Triangles over given positions; wedge i is vertex i.
[[nodiscard]] Mesh mesh_of(const std::vector<Vec3f>& positions, const std::vector<std::array<std::uint32_t, 3>>& faces);
/// n × n quads over a random relief; `flat`: all heights 0, so that many distances are equal.
[[nodiscard]] Mesh relief(int n, std::uint64_t seed, bool flat = false);
/// Three triangles on one edge, one more with its corner at that edge's end, and one without area.
[[nodiscard]] Mesh fins();

/// By texel: the lowest texel that continuity equates it with, from which pieces of edges overlap.
[[nodiscard]] std::vector<std::uint32_t> judge_nodes(const FillCase& c);
/// The shortest paths of the graph that surface_fill.h describes, all of whose arcs are walked.
[[nodiscard]] bake::SurfaceFill judge_fill(const FillCase& c);

}  // namespace etalon::test
