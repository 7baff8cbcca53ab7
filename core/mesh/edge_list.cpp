#include "core/mesh/edge_list.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"

namespace etalon {

std::vector<VertexPair> unique_edges(const Mesh& mesh) {
  const auto for_each_side = [&](const auto& visit) {
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = mesh.wedges[mesh.faces[f][k].index].vertex.index;
        const std::uint32_t b = mesh.wedges[mesh.faces[f][(k + 1) % 3].index].vertex.index;
        if (a != b) visit(std::min(a, b), std::max(a, b));
      }
  };
  for (const auto& face : mesh.faces)
    for (const WedgeId w : face) {
      ETALON_CHECK(w.index < mesh.wedge_count(), fmt::format("wedge {} of {}", w.index, mesh.wedge_count()));
      const std::uint32_t v = mesh.wedges[w.index].vertex.index;
      ETALON_CHECK(v < mesh.vertex_count(), fmt::format("vertex {} of {}", v, mesh.vertex_count()));
    }

  // Grouped by lower vertex, each short group sorted.
  std::vector<std::uint32_t> starts(mesh.vertex_count() + 1, 0);
  for_each_side([&](std::uint32_t low, std::uint32_t) { ++starts[low + 1]; });
  for (std::size_t v = 1; v < starts.size(); ++v) starts[v] += starts[v - 1];
  std::vector<std::uint32_t> highs(starts.back()), fill(starts.begin(), starts.end() - 1);
  for_each_side([&](std::uint32_t low, std::uint32_t high) { highs[fill[low]++] = high; });

  std::vector<VertexPair> edges;
  edges.reserve(highs.size() / 2);
  for (std::uint32_t v = 0; v + 1 < starts.size(); ++v) {
    const auto begin = highs.begin() + starts[v], end = highs.begin() + starts[v + 1];
    std::sort(begin, end);
    for (auto at = begin; at != end; ++at)
      if (at == begin || *at != *(at - 1)) edges.push_back({v, *at});
  }
  return edges;
}

}  // namespace etalon
