#include "core/mesh/mesh_validation.h"

#include <algorithm>
#include <cmath>

#include "core/mesh/adjacency.h"
#include "core/mesh/exact_orientation.h"
#include "core/mesh/uv_overlap.h"

namespace etalon {

namespace {

class Examiner {
 public:
  Examiner(const Mesh& mesh, const MeshValidationOptions& options) : mesh_(mesh), options_(options) {}

  MeshReport report() {
    report_.vertex_count = mesh_.vertex_count();
    report_.wedge_count = mesh_.wedge_count();
    report_.face_count = mesh_.face_count();
    report_.has_uv = mesh_.has_uv;
    values();
    if (!report_.indices_in_range) return std::move(report_);
    const Adjacency adjacency(mesh_);
    edges(adjacency);
    vertices(adjacency);
    faces();
    summary(adjacency);
    if (mesh_.has_uv && !report_.non_finite_wedges.found()) texture_space();
    return std::move(report_);
  }

 private:
  void note(Defect& defect, std::uint32_t place) const {
    ++defect.count;
    if (defect.first.size() < options_.list_limit) defect.first.push_back(place);
  }

  void values() {
    for (std::uint32_t f = 0; f < mesh_.face_count(); ++f) {
      const bool broken = std::any_of(mesh_.faces[f].begin(), mesh_.faces[f].end(), [&](WedgeId w) {
        return w.index >= mesh_.wedge_count() || mesh_.wedges[w.index].vertex.index >= mesh_.vertex_count();
      });
      if (broken) note(report_.wedges_out_of_range, f);
    }
    report_.indices_in_range = !report_.wedges_out_of_range.found();
    for (std::uint32_t v = 0; v < mesh_.vertex_count(); ++v) {
      const Vec3f& p = mesh_.positions[v];
      bool finite = std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
      if (v < mesh_.colors.size())
        for (int k = 0; k < 4; ++k) finite = finite && std::isfinite(mesh_.colors[v][k]);
      if (!finite) note(report_.non_finite_vertices, v);
    }
    if (!mesh_.has_uv) return;
    for (std::uint32_t w = 0; w < mesh_.wedge_count(); ++w)
      if (!std::isfinite(mesh_.wedges[w].uv.x) || !std::isfinite(mesh_.wedges[w].uv.y)) note(report_.non_finite_wedges, w);
  }

  void edges(const Adjacency& adjacency) {
    report_.edge_count = adjacency.edge_count();
    std::vector<std::uint32_t> boundary, crowded, inconsistent;
    for (std::uint32_t e = 0; e < adjacency.edge_count(); ++e) {
      const auto on = adjacency.half_edges(EdgeId(e));
      const std::uint32_t f = Adjacency::face(on[0]).index;
      if (on.size() == 1) boundary.push_back(f);
      if (on.size() > 2) crowded.push_back(f);
      if (on.size() == 2 && adjacency.start(on[0]) == adjacency.start(on[1])) inconsistent.push_back(f);
    }
    const auto note_sorted = [&](Defect& defect, std::vector<std::uint32_t>& places) {
      std::sort(places.begin(), places.end());
      for (const std::uint32_t f : places) note(defect, f);
    };
    note_sorted(report_.boundary_edges, boundary);
    note_sorted(report_.non_manifold_edges, crowded);
    note_sorted(report_.inconsistent_edges, inconsistent);
  }

  /// Faces around a vertex, connected over edges that end there: one group is a fan.
  void vertices(const Adjacency& adjacency) {
    std::vector<std::uint32_t> group(mesh_.face_count(), 0xFFFFFFFFu);
    std::vector<FaceId> stack;
    for (std::uint32_t v = 0; v < mesh_.vertex_count(); ++v) {
      const auto around = adjacency.faces_around(v);
      if (around.empty()) {
        note(report_.unreferenced_vertices, v);
        continue;
      }
      int groups = 0;
      for (const FaceId seed : around) {
        if (group[seed.index] == v) continue;
        ++groups;
        group[seed.index] = v;
        stack.push_back(seed);
        while (!stack.empty()) {
          const FaceId f = stack.back();
          stack.pop_back();
          for (int k = 0; k < 3; ++k) {
            const HalfEdgeId h = Adjacency::half_edge(f, k);
            if (!adjacency.edge(h).valid() || (adjacency.start(h) != v && adjacency.end(h) != v)) continue;
            for (const HalfEdgeId other : adjacency.half_edges(adjacency.edge(h)))
              if (group[Adjacency::face(other).index] != v) {
                group[Adjacency::face(other).index] = v;
                stack.push_back(Adjacency::face(other));
              }
          }
        }
      }
      if (groups > 1) note(report_.non_manifold_vertices, v);
    }
  }

  void faces() {
    std::vector<std::pair<std::array<std::uint32_t, 3>, std::uint32_t>> sorted;
    for (std::uint32_t f = 0; f < mesh_.face_count(); ++f) {
      std::array<std::uint32_t, 3> corners{mesh_.vertex(FaceId(f), 0).index, mesh_.vertex(FaceId(f), 1).index,
                                           mesh_.vertex(FaceId(f), 2).index};
      std::sort(corners.begin(), corners.end());
      sorted.push_back({corners, f});
      if (is_collinear(mesh_.position(FaceId(f), 0), mesh_.position(FaceId(f), 1), mesh_.position(FaceId(f), 2)))
        note(report_.degenerate_faces, f);
    }
    std::sort(sorted.begin(), sorted.end());
    std::vector<std::uint32_t> repeated;
    for (std::size_t i = 1; i < sorted.size(); ++i)
      if (sorted[i].first == sorted[i - 1].first) repeated.push_back(sorted[i].second);
    std::sort(repeated.begin(), repeated.end());
    for (const std::uint32_t f : repeated) note(report_.duplicate_faces, f);
  }

  void summary(const Adjacency& adjacency) {
    report_.component_count = adjacency.face_components().count;
    report_.boundary_loop_count = adjacency.boundary_loops().size();
    report_.euler_characteristic = static_cast<std::int64_t>(mesh_.vertex_count() - report_.unreferenced_vertices.count) -
                                   static_cast<std::int64_t>(report_.edge_count) + static_cast<std::int64_t>(mesh_.face_count());
    if (report_.closed() && report_.manifold() && report_.oriented())
      report_.genus = static_cast<std::int64_t>(report_.component_count) - report_.euler_characteristic / 2;
  }

  void texture_space() {
    const Charts charts = find_charts(mesh_);
    report_.chart_count = charts.charts.size();
    report_.seam_edge_count = charts.seam_edge_count;
    report_.seam_vertex_count = charts.seam_vertex_count;
    report_.split_vertex_count = charts.split_vertex_count;
    std::vector<std::uint32_t> folds, flat;
    for (std::uint32_t c = 0; c < charts.charts.size(); ++c) {
      const Chart& chart = charts.charts[c];
      report_.largest_chart_faces = std::max(report_.largest_chart_faces, chart.faces.size());
      const std::size_t along = chart.faces.size() - chart.folds.size() - chart.degenerate.size();
      report_.negative_uv_faces += chart.sign < 0 ? along : chart.folds.size();
      if (chart.sign < 0) {
        note(report_.mirrored_charts, c);
        report_.mirrored_chart_faces += along;
      }
      if (chart.area_texels(options_.texture_width, options_.texture_height) < 1) note(report_.tiny_charts, c);
      for (const FaceId f : chart.folds) folds.push_back(f.index);
      for (const FaceId f : chart.degenerate) flat.push_back(f.index);
      report_.uv_min =
          c == 0 ? chart.uv_min : Vec2f(std::min(report_.uv_min.x, chart.uv_min.x), std::min(report_.uv_min.y, chart.uv_min.y));
      report_.uv_max =
          c == 0 ? chart.uv_max : Vec2f(std::max(report_.uv_max.x, chart.uv_max.x), std::max(report_.uv_max.y, chart.uv_max.y));
    }
    std::sort(folds.begin(), folds.end());
    std::sort(flat.begin(), flat.end());
    for (const std::uint32_t f : folds) note(report_.folds, f);
    for (const std::uint32_t f : flat) note(report_.degenerate_uv_faces, f);

    std::vector<bool> used(mesh_.wedge_count(), false);
    for (const auto& face : mesh_.faces)
      for (const WedgeId w : face) used[w.index] = true;
    for (std::uint32_t w = 0; w < mesh_.wedge_count(); ++w) {
      const Vec2f& uv = mesh_.wedges[w].uv;
      if (used[w] && !(uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1)) note(report_.uv_outside, w);
    }

    const UvOverlap overlap = measure_uv_overlap(mesh_, options_.overlap_grid, options_.list_limit);
    report_.uv_overlaps.count = overlap.face_count;
    for (const FaceId f : overlap.first_faces) report_.uv_overlaps.first.push_back(f.index);
    report_.uv_overlap_share = overlap.share();
    report_.overlap_grid = overlap.grid;
    report_.uv_coverage = static_cast<double>(overlap.covered_cells) / (static_cast<double>(overlap.grid) * overlap.grid);
  }

  const Mesh& mesh_;
  const MeshValidationOptions& options_;
  MeshReport report_;
};

}  // namespace

MeshReport validate_mesh(const Mesh& mesh, const MeshValidationOptions& options) { return Examiner(mesh, options).report(); }

}  // namespace etalon
