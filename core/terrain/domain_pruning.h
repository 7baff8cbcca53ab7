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
  // (ratio, level finest first, index): a total order. The ratio is one correctly rounded quotient of two exact numbers.
  [[nodiscard]] double ratio(std::uint32_t v) const { return static_cast<double>(sums_[v]) / static_cast<double>(counts_[v]); }
  [[nodiscard]] bool before(std::uint32_t a, std::uint32_t b) const;
  void place(std::size_t slot, std::uint32_t v);
  void sift_up(std::size_t slot);
  void sift_down(std::size_t slot);
  void erase(std::uint32_t v);
  void collect_domain(std::uint32_t v);
  void take(std::uint32_t v, std::vector<std::uint32_t>& out);

  int bits_;
  std::span<const std::int64_t> costs_;
  std::vector<std::int64_t> sums_;     ///< ΔD of what is left of the domain
  std::vector<std::uint32_t> counts_;  ///< ΔR; 0: gone
  std::vector<double> keys_;           ///< by which the heap is ordered; never above ratio(), which may have risen since
  std::vector<std::uint32_t> heap_, slots_;
  std::vector<std::uint32_t> domain_;
  std::vector<std::uint8_t> levels_;
};

}  // namespace etalon::terrain
