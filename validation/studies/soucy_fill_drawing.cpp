// Figures 6 to 8: the fill of two triangles, stage by stage.
#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "validation/studies/soucy_drawings.h"
#include "validation/studies/svg.h"
#include "validation/studies/texel_canvas.h"

namespace etalon::validation {
namespace {

Mesh pair_of_triangles() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {10, 0, 0}, {3.6f, 6.2f, 0}, {6.2f, -6.2f, 0}};
  for (std::uint32_t v = 0; v < 4; ++v) mesh.wedges.push_back({VertexId(v), {0, 0}});
  mesh.faces = {{WedgeId(0u), WedgeId(1u), WedgeId(2u)}, {WedgeId(1u), WedgeId(0u), WedgeId(3u)}};
  return mesh;
}

/// The texel of a face in which a point of the plane lies.
std::uint32_t texel_at(const Mesh& mesh, const bake::Atlas& atlas, const bake::TexelNodes& nodes, std::uint32_t face, double x, double y) {
  const Vec3d a = to_double(mesh.position(FaceId(face), 0)), b = to_double(mesh.position(FaceId(face), 1)),
              c = to_double(mesh.position(FaceId(face), 2));
  const auto area = [](double ux, double uy, double vx, double vy) { return ux * vy - uy * vx; };
  const double all = area(b.x - a.x, b.y - a.y, c.x - a.x, c.y - a.y), wb = area(x - a.x, y - a.y, c.x - a.x, c.y - a.y) / all,
               wc = area(b.x - a.x, b.y - a.y, x - a.x, y - a.y) / all;
  const bake::Tile& tile = atlas.tiles[face];
  const auto [i, j] = tile.nearest_texel({1 - wb - wc, wb, wc});
  return nodes.texel(face, tile.size, i, j);
}

/// t4, and by it the others: a texel inside the second triangle that the second transform gives a source in the first; of several the one that is
/// farthest from it.
std::array<std::uint32_t, 6> named_texels(const FillExample& e, const bake::TexelNodes& nodes) {
  const bake::SurfaceFill &first = e.stages[0], &over = e.stages[1], &second = e.stages[2];
  std::uint32_t t4 = bake::kNoGroup;
  for (std::uint32_t t = nodes.first(1); t < nodes.texel_count(); ++t) {
    if (nodes.group_of(t) != bake::kNoGroup || second.source[t] == over.source[t] || second.source[t] >= nodes.first(1)) continue;
    if (t4 == bake::kNoGroup || second.distance[t] > second.distance[t4]) t4 = t;
  }
  ETALON_CHECK(t4 != bake::kNoGroup, "figure 8: a texel that changes");
  std::array<std::uint32_t, 6> named{};
  named[3] = t4, named[2] = second.feature[t4], named[1] = second.source[t4], named[5] = first.source[t4];
  // t5: an edge texel of the second triangle that went over to another one of the first.
  for (std::uint32_t t = nodes.first(1); t < nodes.texel_count(); ++t)
    if (over.source[t] != first.source[t] && over.source[t] < nodes.first(1) && over.source[t] != named[1])
      named[4] = t, named[0] = over.source[t];
  ETALON_CHECK(named[4] != 0, "figure 7: a second edge texel that changes");
  return named;
}

}  // namespace

FillExample fill_example() {
  FillExample e;
  e.mesh = pair_of_triangles();
  e.atlas = bake::make_atlas(e.mesh, 1.25, 16, 32);  // longest edges of 10: size 8
  const bake::TexelNodes nodes(e.mesh, e.atlas);
  bake::TexelColors colors{.color = std::vector<bake::Rgb8>(nodes.texel_count()), .hits = std::vector<std::uint32_t>(nodes.texel_count())};
  constexpr struct {
    std::uint32_t face;
    double x, y;
  } kHits[] = {{0, 3.3, 1.1}, {0, 6.6, 1.0}, {0, 3.8, 4.2}, {1, 6.2, -5.0}, {1, 4.6, -3.3}, {1, 8.1, -1.9}};
  for (const auto& hit : kHits) {
    e.hits.push_back(texel_at(e.mesh, e.atlas, nodes, hit.face, hit.x, hit.y));
    colors.hits[e.hits.back()] = 1;
  }
  const bake::TexelMetric metric(e.mesh, e.atlas);
  (void)bake::fill_iteratively({e.atlas, nodes, colors, metric},
                               [&](bake::FillStage, const bake::SurfaceFill& now) { e.stages.push_back(now); });
  e.named = named_texels(e, nodes);
  return e;
}

std::string fill_drawing(const FillExample& e) {
  const bake::TexelNodes nodes(e.mesh, e.atlas);
  std::string svg = svg_open(1180, 480, "regions of nearest texels after three stages of the fill");
  constexpr const char* kTitles[] = {"6: after the first transform", "7: over the edge", "8: after the second transform"};
  for (std::size_t stage = 0; stage < 3; ++stage) {
    const bake::SurfaceFill& fill = e.stages[stage];
    const auto on_drawing = [&](const Vec3f& p) { return Vec2d(30 + 392.0 * static_cast<double>(stage) + 34 * p.x, 228 - 34 * p.y); };
    std::vector<Vec2d> centers(nodes.texel_count());
    std::string marks, frames;
    for (std::uint32_t f = 0; f < 2; ++f) {
      const bake::Tile& tile = e.atlas.tiles[f];
      const auto corner = [&](int slot) { return on_drawing(e.mesh.position(FaceId(f), (tile.right_corner + slot) % 3)); };
      const TexelCanvas canvas(tile.size, corner(0), corner(1), corner(2));
      bake::for_each_texel(tile.size, [&](int i, int j) {
        const std::uint32_t t = nodes.texel(f, tile.size, i, j);
        const auto source =
            std::find_if(e.hits.begin(), e.hits.end(), [&](std::uint32_t hit) { return nodes.node_of(hit) == fill.source[t]; });
        const std::string fill_of = source == e.hits.end() ? "fill=\"none\""
                                                           : fmt::format("fill=\"{}\" fill-opacity=\"0.5\"",
                                                                         drawing_hue(static_cast<std::size_t>(source - e.hits.begin())));
        svg += canvas.texel(i, j, fill_of + " stroke=\"currentColor\" stroke-opacity=\"0.25\" stroke-width=\"0.8\"", true);
        centers[t] = canvas.center(i, j);
        const bool hit = std::find(e.hits.begin(), e.hits.end(), t) != e.hits.end();
        marks += svg_dot(centers[t], hit ? 5 : 1.8, "fill=\"currentColor\"");
      });
      frames += canvas.outline("fill=\"none\" stroke=\"currentColor\" stroke-width=\"2\"");
    }
    svg += frames + marks;
    const auto center = [&](std::size_t n) { return centers[e.named[n]]; };
    const char* path = "stroke=\"currentColor\" stroke-width=\"1.8\" stroke-dasharray=\"5 3\"";
    if (stage == 1) svg += svg_line(center(0), center(4), path) + svg_line(center(1), center(2), path);
    if (stage == 2) svg += svg_line(center(1), center(2), path) + svg_line(center(2), center(3), path);
    for (std::size_t n = 0; n < 6; ++n)
      svg += fmt::format(
          "<text x=\"{:.1f}\" y=\"{:.1f}\" style=\"font-weight:700;paint-order:stroke;stroke:#fff;stroke-width:3px;fill:#000\">t{}</text>",
          center(n).x + 6, center(n).y - 6, n + 1);
    const Vec2d p1 = on_drawing(e.mesh.positions[0]), p2 = on_drawing(e.mesh.positions[1]);
    svg += svg_text(p1.x - 4, p1.y + 22, "p1", "middle") + svg_text(p2.x + 2, p2.y + 22, "p2", "middle") +
           svg_text(p1.x + 210, 30, "T1", "middle") + svg_text(p1.x + 145, 445, "T2", "middle") +
           svg_text(p1.x + 180, 474, kTitles[stage], "middle");
  }
  return svg + "</svg>";
}

}  // namespace etalon::validation
