#include "core/mesh/adjacency.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "core/base/error.h"

namespace etalon {

Adjacency::Adjacency(const Mesh& mesh, Nodes kind) {
  const std::size_t node_total = kind == Nodes::vertices ? mesh.vertex_count() : mesh.wedge_count();
  nodes_.reserve(mesh.face_count() * 3);
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t w = mesh.faces[f][static_cast<std::size_t>(k)].index;
      ETALON_CHECK(w < mesh.wedge_count(), fmt::format("face {}, wedge {} of {}", f, w, mesh.wedge_count()));
      const std::uint32_t v = mesh.wedges[w].vertex.index;
      ETALON_CHECK(v < mesh.vertex_count(), fmt::format("wedge {}, vertex {} of {}", w, v, mesh.vertex_count()));
      nodes_.push_back(kind == Nodes::vertices ? v : w);
    }

  // Edges: half-edges sorted by (lower node, higher node, index), equal pairs grouped.
  struct Entry {
    std::uint32_t low, high;
    HalfEdgeId half_edge;
    auto operator<=>(const Entry&) const = default;
  };
  std::vector<Entry> entries;
  entries.reserve(nodes_.size());
  for (std::uint32_t h = 0; h < nodes_.size(); ++h) {
    const std::uint32_t a = start(HalfEdgeId(h)), b = end(HalfEdgeId(h));
    if (a != b) entries.push_back({std::min(a, b), std::max(a, b), HalfEdgeId(h)});
  }
  std::sort(entries.begin(), entries.end());
  edge_of_.resize(nodes_.size());
  on_edges_.reserve(entries.size());
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (i == 0 || entries[i].low != entries[i - 1].low || entries[i].high != entries[i - 1].high)
      edge_starts_.push_back(static_cast<std::uint32_t>(i));
    edge_of_[entries[i].half_edge.index] = EdgeId(edge_starts_.size() - 1);
    on_edges_.push_back(entries[i].half_edge);
  }
  edge_starts_.push_back(static_cast<std::uint32_t>(entries.size()));

  const auto first_use = [&](std::uint32_t h) {  // a face that uses a node twice is listed once
    const std::uint32_t f = h - h % 3;
    for (std::uint32_t k = f; k < h; ++k)
      if (nodes_[k] == nodes_[h]) return false;
    return true;
  };
  face_starts_.assign(node_total + 1, 0);
  for (std::uint32_t h = 0; h < nodes_.size(); ++h)
    if (first_use(h)) ++face_starts_[nodes_[h] + 1];
  std::partial_sum(face_starts_.begin(), face_starts_.end(), face_starts_.begin());
  around_.resize(face_starts_.back());
  std::vector<std::uint32_t> fill(face_starts_.begin(), face_starts_.end() - 1);
  for (std::uint32_t h = 0; h < nodes_.size(); ++h)
    if (first_use(h)) around_[fill[nodes_[h]]++] = FaceId(h / 3);
}

HalfEdgeId Adjacency::opposite(HalfEdgeId h) const {
  if (!edge(h).valid()) return {};
  const auto both = half_edges(edge(h));
  if (both.size() != 2) return {};
  const HalfEdgeId other = both[0] == h ? both[1] : both[0];
  return start(other) == end(h) ? other : HalfEdgeId{};
}

HalfEdgeId Adjacency::next_on_boundary(HalfEdgeId h) const {
  HalfEdgeId at = next(h);
  for (std::size_t guard = 0; guard < half_edge_count(); ++guard) {
    if (on_boundary(at)) return at;
    const HalfEdgeId across = opposite(at);
    if (!across.valid()) return {};
    at = next(across);
  }
  return {};
}

std::vector<std::vector<HalfEdgeId>> Adjacency::boundary_loops() const {
  std::vector<bool> used(half_edge_count(), false);
  std::vector<std::vector<HalfEdgeId>> loops;
  for (std::uint32_t first = 0; first < half_edge_count(); ++first) {
    if (used[first] || !on_boundary(HalfEdgeId(first))) continue;
    std::vector<HalfEdgeId>& loop = loops.emplace_back();
    HalfEdgeId h(first);
    while (h.valid() && !used[h.index]) {
      used[h.index] = true;
      loop.push_back(h);
      HalfEdgeId following = next_on_boundary(h);
      if (!following.valid()) {
        for (const FaceId f : faces_around(end(h)))
          for (int k = 0; k < 3 && !following.valid(); ++k) {
            const HalfEdgeId candidate = half_edge(f, k);
            if (start(candidate) == end(h) && on_boundary(candidate) && !used[candidate.index]) following = candidate;
          }
      }
      h = following;
    }
  }
  return loops;
}

Adjacency::Components Adjacency::face_components() const {
  Components result;
  constexpr std::uint32_t kNone = 0xFFFFFFFFu;
  result.of_face.assign(half_edge_count() / 3, kNone);
  std::vector<std::uint32_t> stack;
  for (std::uint32_t seed = 0; seed < result.of_face.size(); ++seed) {
    if (result.of_face[seed] != kNone) continue;
    const std::uint32_t component = result.count++;
    result.of_face[seed] = component;
    stack.push_back(seed);
    while (!stack.empty()) {
      const std::uint32_t f = stack.back();
      stack.pop_back();
      for (int k = 0; k < 3; ++k) {
        const EdgeId e = edge(half_edge(FaceId(f), k));
        if (!e.valid()) continue;
        for (const HalfEdgeId h : half_edges(e)) {
          std::uint32_t& other = result.of_face[face(h).index];
          if (other != kNone) continue;
          other = component;
          stack.push_back(face(h).index);
        }
      }
    }
  }
  return result;
}

}  // namespace etalon
