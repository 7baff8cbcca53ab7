// The places of one triangle that colours come from, asked for the nearest: each already has a way behind it.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/bake/texel_metric.h"

namespace etalon::bake {

/// A distance in grid steps and the node whose colour it leads to: nearer first, then the lower node.
using Nearest = std::pair<std::uint64_t, std::uint32_t>;

/// A k-d tree of places with distances behind them. Answers are exact, whatever its shape.
class SourceTree {
 public:
  struct Source {
    GridPoint center;
    Nearest behind;  ///< how far from there, and where to
  };

  /// Replaces what it held; the memory is kept.
  void build(std::vector<Source>& sources);
  [[nodiscard]] bool empty() const { return sources_.empty(); }

  /// The least of `known` and, over all sources, the distance behind plus grid_distance() to `at`, with the node it leads to.
  /// Time: logarithmic in the sources where distances behind differ less than places do.
  [[nodiscard]] Nearest nearest(const GridPoint& at, Nearest known) const;

 private:
  struct Node {
    std::array<std::int32_t, 3> low{}, high{};
    std::uint64_t least = 0;  ///< behind
    std::uint32_t begin = 0, end = 0;
    std::uint32_t right = 0;  ///< the left child follows; 0: a leaf
  };

  std::uint32_t add_node(std::uint32_t begin, std::uint32_t end);
  [[nodiscard]] static std::uint64_t squared_distance_to(const Node& node, const std::array<std::int32_t, 3>& at);

  std::vector<Source> sources_;
  std::vector<Node> nodes_;
};

}  // namespace etalon::bake
