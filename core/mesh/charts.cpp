#include "core/mesh/charts.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/base/error.h"
#include "core/mesh/adjacency.h"
#include "core/mesh/exact_orientation.h"

namespace etalon {

namespace {

/// For each wedge the lowest wedge of the same vertex and uv.
std::vector<WedgeId> merged_wedges(const Mesh& mesh) {
  std::vector<WedgeId> order(mesh.wedge_count());
  for (std::uint32_t w = 0; w < order.size(); ++w) order[w] = WedgeId(w);
  const auto place = [&](WedgeId w) {
    return std::make_tuple(mesh.wedges[w.index].vertex, mesh.wedges[w.index].uv.x, mesh.wedges[w.index].uv.y);
  };
  std::sort(order.begin(), order.end(), [&](WedgeId a, WedgeId b) { return place(a) != place(b) ? place(a) < place(b) : a < b; });
  std::vector<WedgeId> result(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    result[order[i].index] = i > 0 && place(order[i]) == place(order[i - 1]) ? result[order[i - 1].index] : order[i];
  return result;
}

/// `merged` has equal texture coordinates as equal wedges.
void count_seams(const Mesh& merged, Charts& result) {
  std::vector<WedgeId> only(merged.vertex_count());
  std::vector<bool> split(merged.vertex_count(), false), on_seam(merged.vertex_count(), false);
  for (const auto& face : merged.faces)
    for (const WedgeId w : face) {
      const std::uint32_t v = merged.wedges[w.index].vertex.index;
      if (only[v].valid() && only[v] != w) split[v] = true;
      only[v] = w;
    }
  const Adjacency adjacency(merged);
  for (std::uint32_t e = 0; e < adjacency.edge_count(); ++e) {
    const auto on = adjacency.half_edges(EdgeId(e));
    const auto wedges = [&](HalfEdgeId h) {  // in one direction for all
      const auto& face = merged.faces[Adjacency::face(h).index];
      const std::size_t k = h.index % 3;
      const bool along = adjacency.start(h) == adjacency.start(on[0]);
      return along ? std::pair(face[k], face[(k + 1) % 3]) : std::pair(face[(k + 1) % 3], face[k]);
    };
    if (std::all_of(on.begin(), on.end(), [&](HalfEdgeId h) { return wedges(h) == wedges(on[0]); })) continue;
    ++result.seam_edge_count;
    on_seam[adjacency.start(on[0])] = on_seam[adjacency.end(on[0])] = true;
  }
  result.split_vertex_count = static_cast<std::size_t>(std::count(split.begin(), split.end(), true));
  result.seam_vertex_count = static_cast<std::size_t>(std::count(on_seam.begin(), on_seam.end(), true));
}

}  // namespace

Charts find_charts(const Mesh& mesh) {
  for (const Wedge& wedge : mesh.wedges)
    ETALON_CHECK(std::isfinite(wedge.uv.x) && std::isfinite(wedge.uv.y), "texture coordinates must be finite");
  Mesh merged = mesh;
  const std::vector<WedgeId> lowest = merged_wedges(mesh);
  for (auto& face : merged.faces)
    for (WedgeId& w : face) w = lowest[w.index];

  const Adjacency::Components components = Adjacency(merged, Adjacency::Nodes::wedges).face_components();
  Charts result;
  result.of_face = components.of_face;
  result.charts.resize(components.count);
  count_seams(merged, result);

  std::vector<double> signed_area(components.count, 0);
  std::vector<int> signs(mesh.face_count());
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    Chart& chart = result.charts[result.of_face[f]];
    const Vec2f corner[3] = {mesh.wedge(FaceId(f), 0).uv, mesh.wedge(FaceId(f), 1).uv, mesh.wedge(FaceId(f), 2).uv};
    if (chart.faces.empty()) chart.uv_min = chart.uv_max = corner[0];
    for (const Vec2f& uv : corner) {
      chart.uv_min = {std::min(chart.uv_min.x, uv.x), std::min(chart.uv_min.y, uv.y)};
      chart.uv_max = {std::max(chart.uv_max.x, uv.x), std::max(chart.uv_max.y, uv.y)};
    }
    chart.faces.push_back(FaceId(f));
    signs[f] = orientation(corner[0], corner[1], corner[2]);
    const double area = signs[f] * std::fabs(doubled_area(corner[0], corner[1], corner[2])) * 0.5;
    chart.area_uv += std::fabs(area);
    signed_area[result.of_face[f]] += area;
  }
  for (std::size_t c = 0; c < result.charts.size(); ++c) {
    Chart& chart = result.charts[c];
    chart.sign = signed_area[c] < 0 ? -1 : 1;
    for (const FaceId f : chart.faces) {
      if (signs[f.index] == 0) chart.degenerate.push_back(f);
      if (signs[f.index] == -chart.sign) chart.folds.push_back(f);
    }
  }
  return result;
}

}  // namespace etalon
