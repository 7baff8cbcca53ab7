#include "core/bake/texel_nodes.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/mesh/adjacency.h"

namespace etalon::bake {
namespace {

// Disjoint sets; the lowest element stands for its set.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t find(std::uint32_t t) {
    while (parent_[t] != t) t = parent_[t] = parent_[parent_[t]];
    return t;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

class Uniter {
 public:
  Uniter(const Mesh& mesh, const Atlas& atlas, const TexelNodes& nodes)
      : mesh_(mesh), atlas_(atlas), nodes_(nodes), adjacency_(mesh), sets_(nodes.texel_count()) {}

  Sets run() {
    for (std::uint32_t e = 0; e < adjacency_.edge_count(); ++e) unite_edge(adjacency_.half_edges(EdgeId(e)));
    for (std::uint32_t v = 0; v < adjacency_.node_count(); ++v) unite_corners(v);
    return std::move(sets_);
  }

 private:
  // The step-th texel of a half-edge's side, from its vertex of lower index.
  [[nodiscard]] std::uint32_t side_texel(HalfEdgeId h, int step) const {
    const std::uint32_t f = Adjacency::face(h).index;
    const Tile& tile = atlas_.tiles[f];
    int from = Adjacency::corner(h), to = (from + 1) % 3;
    if (adjacency_.start(h) > adjacency_.end(h)) std::swap(from, to);
    const auto [i, j] = tile.side_texel(from, to, step);
    return nodes_.texel(f, tile.size, i, j);
  }
  [[nodiscard]] int size_at(HalfEdgeId h) const { return atlas_.tiles[Adjacency::face(h).index].size; }

  void unite_edge(std::span<const HalfEdgeId> sides) {
    const HalfEdgeId finest =
        *std::max_element(sides.begin(), sides.end(), [&](HalfEdgeId a, HalfEdgeId b) { return size_at(a) < size_at(b); });
    for (const HalfEdgeId h : sides) {
      const int ratio = size_at(finest) / size_at(h);
      if (h != finest)
        for (int step = 0; step < size_at(finest); ++step) sets_.unite(side_texel(h, step / ratio), side_texel(finest, step));
    }
  }

  void unite_corners(std::uint32_t v) {
    std::uint32_t first = kNoGroup;
    for (const FaceId f : adjacency_.faces_around(v))
      for (int c = 0; c < 3; ++c) {
        if (mesh_.vertex(f, c).index != v) continue;
        const Tile& tile = atlas_.tiles[f.index];
        const auto [i, j] = tile.corner_texel(c);
        const std::uint32_t texel = nodes_.texel(f.index, tile.size, i, j);
        if (first == kNoGroup) first = texel;
        sets_.unite(first, texel);
      }
  }

  const Mesh& mesh_;
  const Atlas& atlas_;
  const TexelNodes& nodes_;
  Adjacency adjacency_;
  Sets sets_;
};

}  // namespace

TexelNodes::TexelNodes(const Mesh& mesh, const Atlas& atlas) {
  ETALON_CHECK(mesh.face_count() == atlas.tiles.size(), fmt::format("{} faces, {} tiles", mesh.face_count(), atlas.tiles.size()));
  ETALON_CHECK(atlas.inside_count() < kNoGroup, fmt::format("{} texels", atlas.inside_count()));
  first_.push_back(0);
  for (const Tile& tile : atlas.tiles)
    first_.push_back(first_.back() + static_cast<std::uint32_t>(texels_of_size(static_cast<std::uint64_t>(tile.size))));
  group_of_.assign(first_.back(), kNoGroup);
  Sets sets = Uniter(mesh, atlas, *this).run();

  // The lowest texel of each set of two and more opens its group.
  for (std::uint32_t t = 0; t < group_of_.size(); ++t)
    if (sets.find(t) != t) group_of_[sets.find(t)] = 0;
  std::vector<std::uint32_t> sizes;
  for (std::uint32_t t = 0; t < group_of_.size(); ++t) {
    const std::uint32_t lowest = sets.find(t);
    if (lowest != t) {
      group_of_[t] = group_of_[lowest];
      ++sizes[group_of_[t]];
    } else if (group_of_[t] != kNoGroup) {
      group_of_[t] = static_cast<std::uint32_t>(sizes.size());
      sizes.push_back(1);
    }
  }
  group_starts_.assign(1, 0);
  for (const std::uint32_t size : sizes) group_starts_.push_back(group_starts_.back() + size);
  members_.resize(group_starts_.back());
  std::vector<std::uint32_t> next(group_starts_.begin(), group_starts_.end() - 1);
  for (std::uint32_t t = 0; t < group_of_.size(); ++t)
    if (group_of_[t] != kNoGroup) members_[next[group_of_[t]]++] = t;
}

}  // namespace etalon::bake
