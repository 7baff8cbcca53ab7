#include "core/adapt/chart_borders.h"

#include <algorithm>
#include <utility>

#include "core/base/error.h"
#include "core/mesh/charts.h"
#include "core/mesh/exact_orientation.h"

namespace etalon::adapt {
namespace {

using progressive::kNone;
using progressive::ProgressiveMesh;

// The finest level with wedges and faces numbered by appearance.
Mesh finest_mesh(ProgressiveMesh& mesh) {
  mesh.go_to(mesh.split_count());
  Mesh result;
  result.has_uv = true;
  result.positions = mesh.data().positions, result.wedges = mesh.data().wedges;
  for (std::size_t w = 0; w < result.wedge_count(); ++w) result.wedges[w].uv = mesh.uv(w);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto& wedges = mesh.face_wedges(f);
    result.faces.push_back({WedgeId(wedges[0]), WedgeId(wedges[1]), WedgeId(wedges[2])});
  }
  return result;
}

// A triangle (u, a, b) around u, by wedges.
struct Spoke {
  std::uint32_t u, a, b;
};

// All triangles around the vertex that split n brings, ordered by the wedge of u: those of one chart are together. The mesh is at level n + 1.
std::vector<Spoke> spokes_of(const ProgressiveMesh& mesh, std::size_t n) {
  const auto& data = mesh.data();
  const progressive::VertexSplit& split = data.splits[n];
  const std::uint32_t u = data.base_vertices + static_cast<std::uint32_t>(n);
  std::vector<Spoke> spokes;
  const auto add = [&](std::uint32_t face, std::uint32_t corner) {
    const auto& wedges = mesh.face_wedges(face);
    spokes.push_back({wedges[corner], wedges[(corner + 1) % 3], wedges[(corner + 2) % 3]});
  };
  for (std::uint32_t c = split.first_corner; c < split.end_corner; ++c) add(data.corners[c] >> 2, data.corners[c] & 3);
  for (auto face = split.first_face; face < static_cast<std::uint32_t>(mesh.face_count_at(n + 1)); ++face)
    for (std::uint32_t corner = 0; corner < 3; ++corner)
      if (data.wedges[mesh.face_wedges(face)[corner]].vertex.index == u) add(face, corner);
  std::stable_sort(spokes.begin(), spokes.end(), [](const Spoke& x, const Spoke& y) { return x.u < y.u; });
  return spokes;
}

// Where the fan of one wedge begins and ends: wedges that only one of its triangles has. Both kNone for a closed fan, or for more than one.
struct Ends {
  std::uint32_t first = kNone, last = kNone;
};

Ends ends_of(std::span<const Spoke> fan) {
  Ends ends;
  std::size_t firsts = 0, lasts = 0;
  for (const Spoke& s : fan) {
    if (std::none_of(fan.begin(), fan.end(), [&](const Spoke& other) { return other.b == s.a; })) ends.first = s.a, ++firsts;
    if (std::none_of(fan.begin(), fan.end(), [&](const Spoke& other) { return other.a == s.b; })) ends.last = s.b, ++lasts;
  }
  return firsts == 1 && lasts == 1 ? ends : Ends{};
}

// The borders of charts as rings of wedges, with the chart on the left. A wedge at which two borders touch has the one that came first.
class BorderRings {
 public:
  explicit BorderRings(const Mesh& mesh) : next_(mesh.wedge_count(), kNone), previous_(mesh.wedge_count(), kNone) {
    using Edge = std::array<std::uint32_t, 2>;
    std::vector<Edge> edges;
    for (const auto& face : mesh.faces)
      for (std::size_t k = 0; k < 3; ++k) edges.push_back({face[k].index, face[(k + 1) % 3].index});
    std::sort(edges.begin(), edges.end());
    for (const Edge& edge : edges)
      if (!std::binary_search(edges.begin(), edges.end(), Edge{edge[1], edge[0]}) && next_[edge[0]] == kNone) link(edge[0], edge[1]);
  }

  void link(std::uint32_t from, std::uint32_t to) { next_[from] = to, previous_[to] = from; }
  [[nodiscard]] std::uint32_t next(std::uint32_t wedge) const { return next_[wedge]; }
  [[nodiscard]] std::uint32_t previous(std::uint32_t wedge) const { return previous_[wedge]; }

 private:
  std::vector<std::uint32_t> next_, previous_;
};

// What a collapse does to one border: the wedges of the chain that goes, and v's, whose place after it is what comes.
struct Chain {
  std::vector<std::uint32_t> wedges;
  std::vector<Vec2f> uv;  // before the collapse
  std::uint32_t of_parent = kNone, chart = 0;
};

}  // namespace

ChartBorders::ChartBorders(ProgressiveMesh& mesh) : first_bend_(mesh.split_count() + 1, 0) {
  if (!mesh.data().has_uv) throw InputError("charts of a progressive mesh: expected texture coordinates, got none");
  const Mesh finest = finest_mesh(mesh);
  const Charts charts = find_charts(finest);
  std::vector<std::uint32_t> chart_of_wedge(finest.wedge_count(), 0);
  for (std::uint32_t f = 0; f < finest.face_count(); ++f) {
    const auto uv = [&](int corner) { return finest.wedge(FaceId(f), corner).uv; };
    faces_.push_back({{uv(0), uv(1), uv(2)}, charts.of_face[f]});
    for (const WedgeId wedge : finest.faces[f]) chart_of_wedge[wedge.index] = charts.of_face[f];
  }
  BorderRings rings(finest);
  const auto vertex = [&](std::uint32_t wedge) { return finest.wedges[wedge].vertex.index; };
  std::vector<Bend> backwards;  // from the last split to the first
  std::vector<Chain> chains;
  for (std::size_t n = mesh.split_count(); n-- > 0;) {
    const std::vector<Spoke> spokes = spokes_of(mesh, n);
    chains.clear();
    for (std::size_t begin = 0, end = 0; begin < spokes.size(); begin = end) {
      while (end < spokes.size() && spokes[end].u == spokes[begin].u) ++end;
      const Ends ends = ends_of(std::span(spokes).subspan(begin, end - begin));
      if (ends.first == kNone) continue;
      const std::uint32_t u = spokes[begin].u, parent = mesh.data().splits[n].parent;
      Chain chain{.wedges = {ends.last, u, ends.first}, .uv = {}, .of_parent = ends.last, .chart = chart_of_wedge[u]};
      if (vertex(ends.first) == parent) chain.of_parent = ends.first;
      if (mesh.data().splits[n].move != kNone) {  // v goes too
        const std::uint32_t beyond = chain.of_parent == ends.first ? rings.next(ends.first) : rings.previous(ends.last);
        if (beyond != kNone) chain.wedges.insert(chain.of_parent == ends.first ? chain.wedges.end() : chain.wedges.begin(), beyond);
      }
      for (const std::uint32_t wedge : chain.wedges) chain.uv.push_back(mesh.uv(wedge));
      rings.link(ends.last, ends.first);
      chains.push_back(std::move(chain));
    }
    mesh.go_to(n);
    for (const Chain& chain : chains) {
      const Vec2f p = mesh.uv(chain.of_parent);
      for (std::size_t k = 0; k + 1 < chain.uv.size(); ++k) {
        const int turn = orientation(p, chain.uv[k], chain.uv[k + 1]);
        if (turn == 0) continue;
        backwards.push_back({{p, chain.uv[k], chain.uv[k + 1]}, chain.chart, turn == charts.charts[chain.chart].sign});
        ++first_bend_[n];
      }
    }
  }
  std::reverse(backwards.begin(), backwards.end());
  bends_ = std::move(backwards);
  std::size_t sum = 0;
  for (std::size_t& first : first_bend_) first = std::exchange(sum, sum + first);
}

}  // namespace etalon::adapt
