#include <fmt/format.h>

#include "core/mesh/mesh_validation.h"

namespace etalon {

std::vector<std::string> MeshReport::to_lines() const {
  std::vector<std::string> lines;
  const auto say = [&](const Defect& defect, const char* what, const char* place) {
    if (!defect.found()) return;
    std::string line = fmt::format("{}: {} ({}", what, defect.count, place);
    for (const std::uint32_t index : defect.first) line += fmt::format(" {}", index);
    lines.push_back(line + (defect.first.size() < defect.count ? " …)" : ")"));
  };

  lines.push_back(fmt::format("{} vertices, {} wedges, {} faces", vertex_count, wedge_count, face_count));
  say(wedges_out_of_range, "indices out of range", "faces");
  say(non_finite_vertices, "vertices that are not finite", "vertices");
  say(non_finite_wedges, "texture coordinates that are not finite", "wedges");
  if (!indices_in_range) return lines;

  std::string kind = closed() ? "closed" : fmt::format("open, {} boundary loops", boundary_loop_count);
  kind += manifold() ? ", manifold" : ", not manifold";
  kind += oriented() ? ", consistently oriented" : ", inconsistently oriented";
  if (genus) kind += fmt::format(", genus {}", *genus);
  lines.push_back(fmt::format("{}; {} component{}, {} edges, Euler characteristic {}", kind, component_count,
                              component_count == 1 ? "" : "s", edge_count, euler_characteristic));
  say(boundary_edges, "boundary edges", "faces");
  say(non_manifold_edges, "edges of more than two faces", "faces");
  say(non_manifold_vertices, "vertices whose faces are not one fan", "vertices");
  say(inconsistent_edges, "edges between faces of opposite orientation", "faces");
  say(duplicate_faces, "faces that repeat an earlier one", "faces");
  say(degenerate_faces, "faces without area", "faces");
  say(unreferenced_vertices, "vertices of no face", "vertices");

  if (!has_uv) {
    lines.push_back("no texture coordinates");
    return lines;
  }
  if (non_finite_wedges.found()) return lines;
  lines.push_back(fmt::format(
      "{} UV chart{} (largest {} faces), {} seam vertices, u {:.6g} to {:.6g}, v {:.6g} to {:.6g}, {:.1f} % of the texture covered",
      chart_count, chart_count == 1 ? "" : "s", largest_chart_faces, seam_vertex_count, uv_min.x, uv_max.x, uv_min.y, uv_max.y,
      100 * uv_coverage));
  if (negative_uv_faces > 0)
    lines.push_back(fmt::format("faces of negative UV area: {}, of which {} in mirrored charts", negative_uv_faces, mirrored_chart_faces));
  say(mirrored_charts, "mirrored charts (legal)", "charts");
  say(folds, "folds: faces against their chart's orientation", "faces");
  say(degenerate_uv_faces, "faces without area in texture space", "faces");
  say(tiny_charts, "charts under one texel", "charts");
  say(uv_outside, "texture coordinates outside [0, 1]", "wedges");
  if (uv_overlaps.found()) {
    say(uv_overlaps, "faces that overlap another in texture space", "faces");
    lines.push_back(
        fmt::format("overlap: {:.4f} % of the covered cells of a {}x{} grid", 100 * uv_overlap_share, overlap_grid, overlap_grid));
  }
  return lines;
}

}  // namespace etalon
