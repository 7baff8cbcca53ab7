// Greedy pruning by merging domains: a heap of all points by ΔD/ΔR of what is left of their domains.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/terrain/quadtree.h"

namespace etalon::terrain {

class DomainPruning {
 public:
  /// Costs by grid point, Σ|cost| < 2^63.
  DomainPruning(int bits, std::span<const std::int64_t> costs);

  /// All points but the corners, first to go first. Once.
  [[nodiscard]] std::vector<std::uint32_t> order(const std::function<void(std::size_t, std::size_t)>& progress);

 private:
  struct Node {
    std::int64_t sum = 0;     ///< ΔD of what is left of the domain
    double key = 0;           ///< by which the heap is ordered; never above ratio(), which may have risen since
    std::uint32_t count = 0;  ///< ΔR; 0: gone
    std::uint32_t slot = 0;   ///< in the heap; the highest bit marks gone points, and members while a domain is collected
  };
  // (key, level finest first, index): a total order. A ratio is one correctly rounded quotient of two exact numbers, each rounded to double.
  [[nodiscard]] static double ratio(const Node& node) { return static_cast<double>(node.sum) / static_cast<double>(node.count); }
  [[nodiscard]] bool before(std::uint32_t a, std::uint32_t b) const;
  void place(std::size_t slot, std::uint32_t v);
  void sift_up(std::size_t slot);
  void sift_down(std::size_t slot);
  void erase(std::uint32_t v);
  void collect_domain(std::uint32_t v);
  void take(std::uint32_t v, std::vector<std::uint32_t>& out);

  int bits_;
  std::span<const std::int64_t> costs_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> heap_;
  std::vector<std::uint32_t> domain_;
};

}  // namespace etalon::terrain
