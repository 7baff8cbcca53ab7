// Which texels must be equal so that the image of every vertex and edge is the same in all triangles that share it
// [Soucy, Godin & Rioux 1996, sec. 2, figure 2].
#pragma once

#include <span>

#include "core/bake/atlas.h"

namespace etalon::bake {

inline constexpr std::uint32_t kNoGroup = 0xFFFFFFFFu;

/// The texels of all triangles, numbered face by face, in each by j, then i; and the groups of two and more that continuity makes one:
/// all corner texels at a vertex; on an edge, however many faces it has, every texel of a larger triangle and that of a smaller one whose
/// piece of the edge contains its own (sizes are powers of two, so pieces nest). What is equal to the same is equal to each other, so at
/// vertices where sizes differ much a group can hold a whole side.
class TexelNodes {
 public:
  /// `atlas` must be that of `mesh`. ETALON_CHECKs that it has as many tiles, and fewer than 2^32 − 1 texels.
  TexelNodes(const Mesh& mesh, const Atlas& atlas);

  [[nodiscard]] std::size_t texel_count() const { return group_of_.size(); }
  [[nodiscard]] std::uint32_t first(std::uint32_t face) const { return first_[face]; }
  [[nodiscard]] std::uint32_t texel(std::uint32_t face, int size, int i, int j) const {
    return first_[face] + static_cast<std::uint32_t>(j * size - j * (j - 1) / 2 + i);
  }
  [[nodiscard]] std::size_t group_count() const { return group_starts_.size() - 1; }
  /// kNoGroup for a texel that no other must equal.
  [[nodiscard]] std::uint32_t group_of(std::uint32_t texel) const { return group_of_[texel]; }
  /// Ascending; groups ascend by their lowest texel.
  [[nodiscard]] std::span<const std::uint32_t> members(std::uint32_t group) const {
    return {members_.data() + group_starts_[group], group_starts_[group + 1] - group_starts_[group]};
  }
  /// The texel that stands for a texel and all that must equal it: the lowest of them.
  [[nodiscard]] std::uint32_t node_of(std::uint32_t texel) const {
    return group_of_[texel] == kNoGroup ? texel : members_[group_starts_[group_of_[texel]]];
  }

 private:
  std::vector<std::uint32_t> first_;  // #F + 1
  std::vector<std::uint32_t> group_of_;
  std::vector<std::uint32_t> members_;
  std::vector<std::uint32_t> group_starts_;
};

/// Calls visit(i, j) for all texels of a triangle, in the order of their numbers.
template <class Visit>
void for_each_texel(int size, const Visit& visit) {
  for (int j = 0; j < size; ++j)
    for (int i = 0; i + j < size; ++i) visit(i, j);
}

}  // namespace etalon::bake
