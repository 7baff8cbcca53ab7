#include "core/bake/bake.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/bake/gutter.h"
#include "core/bake/scan_colors.h"
#include "core/bake/seams.h"
#include "core/bake/vertex_landings.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/mesh/weld.h"

namespace etalon::bake {
namespace {

// The scan as a surface with colours and nothing else: texture seams and materials would keep vertices where they are.
Mesh bare_scan(const Mesh& scan) {
  Mesh bare = scan;
  bare.has_uv = false;
  bare.face_materials.clear();
  return welded_by_position(bare);
}

void require_input(const Mesh& scan, const BakeOptions& options) {
  if (scan.colors.empty()) throw InputError("expected vertex colours, got none: there is nothing to bake");
  for (std::size_t v = 0; v < scan.colors.size(); ++v)
    for (int c = 0; c < 3; ++c)
      if (!std::isfinite(scan.colors[v][c]))
        throw InputError(fmt::format("vertex {}: expected a finite colour, got {}", v, scan.colors[v][c]));
  if (options.tolerance && !(*options.tolerance > 0))
    throw InputError(fmt::format("expected a tolerance above 0, got {}", *options.tolerance));
  (void)largest_size(options.width, options.height, options.gutter);
}

// Each face with wedges of its own.
Mesh textured(const Mesh& mesh, const Atlas& atlas, double share) {
  Mesh result;
  result.positions = mesh.positions;
  result.has_uv = true;
  result.wedges.reserve(3 * mesh.face_count());
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    for (int c = 0; c < 3; ++c) {
      const Vec2d p = corner_place(atlas.tiles[f], c, share);
      result.wedges.push_back({mesh.vertex(FaceId(f), c), {static_cast<float>(p.x / atlas.width), static_cast<float>(p.y / atlas.height)}});
    }
    result.faces.push_back({WedgeId(3 * f), WedgeId(3 * f + 1), WedgeId(3 * f + 2)});
  }
  return result;
}

Image painted(const Atlas& atlas, const std::vector<Rgb8>& colors) {
  Image image(atlas.width, atlas.height, kRgb8);
  std::size_t t = 0;
  for (const Tile& tile : atlas.tiles)
    for_each_texel(tile.size, [&](int i, int j) {
      const auto [x, y] = tile.place(i, j);
      std::copy_n(colors[t++].data(), 3, image.channels<std::uint8_t>(x, y));
    });
  return image;
}

// With a tolerance every vertex is followed over the surface, since every collapse is judged by how far that goes.
simplify::SimplifyResult decimated(const Mesh& dense, const BakeOptions& options) {
  simplify::SimplifyOptions how{.target_faces = options.target_faces, .tolerance = options.tolerance, .progress = options.progress};
  if (options.tolerance) return simplify::simplify_mesh(dense, how);
  CollapseTrail trail(dense.vertex_count());
  how.before_collapse = [&](const simplify::CollapseMesh& mesh, const simplify::CollapseEvent& event) { trail.record(mesh, event); };
  simplify::SimplifyResult result = simplify::simplify_mesh(dense, how);
  result.landings = land_vertices(dense, result, trail);
  result.distance_max = largest_distance(dense, result.mesh, result.landings);
  return result;
}

// What --fill sampled asks for colours; made beside the decimation, which keeps one thread busy.
struct Decimation {
  simplify::SimplifyResult simplified;
  std::optional<TriangleTree> tree;  // of the scan
};

Decimation decimated_beside_tree(const Mesh& dense, const BakeOptions& options) {
  Decimation result;
  std::exception_ptr unfit;
  parallel_for(options.fill == FillKind::sampled ? 2 : 1, [&](std::size_t part) {
    if (part == 0) {
      result.simplified = decimated(dense, options);
    } else {
      try {
        result.tree.emplace(dense);
      } catch (...) {
        unfit = std::current_exception();  // what is wrong with the scan the decimation says first, whoever is faster
      }
    }
  });
  if (unfit) std::rethrow_exception(unfit);
  return result;
}

TexelCounts counts_of(const Atlas& atlas, const TexelColors& colors) {
  TexelCounts counts{.atlas = static_cast<std::uint64_t>(atlas.width) * static_cast<std::uint64_t>(atlas.height),
                     .inside = colors.hits.size(),
                     .border = atlas.border_count()};
  for (const std::uint32_t hits : colors.hits) {
    counts.hit += hits > 0;
    counts.averaged += hits > 1;
  }
  counts.filled = counts.inside - counts.hit;
  return counts;
}

// Every texel's colour, and into the result how the fill went.
std::vector<Rgb8> completed_colors(const Mesh& dense, const std::optional<TriangleTree>& tree, const TexelNodes& nodes,
                                   const TexelColors& colors, FillKind kind, BakeResult& result) {
  const Mesh& mesh = result.simplified.mesh;
  if (kind == FillKind::sampled) {
    ScanColors sampled = sample_scan(dense, tree.value(), mesh, result.atlas, nodes);
    result.fill_distance_max = sampled.distance_max;
    return std::move(sampled.color);
  }
  const TexelMetric metric(mesh, result.atlas);
  const FillProblem problem{result.atlas, nodes, colors, metric};
  const SurfaceFill fill = kind == FillKind::exact ? fill_exactly(problem) : fill_iteratively(problem);
  result.iterations = fill.iterations;
  for (const std::uint64_t distance : fill.distance)
    result.fill_distance_max = std::max(result.fill_distance_max, static_cast<double>(distance) * metric.step_length());
  return filled_colors(colors, fill);
}

}  // namespace

BakeResult bake_scan(const Mesh& scan, const BakeOptions& options) {
  require_input(scan, options);
  const Mesh dense = bare_scan(scan);
  BakeResult result;
  Decimation decimation = decimated_beside_tree(dense, options);
  result.simplified = std::move(decimation.simplified);
  const Mesh& mesh = result.simplified.mesh;

  result.spacing = mean_edge_length(dense);
  if (!(result.spacing > 0)) throw InputError("expected a surface, got edges that all have length 0");
  result.atlas = make_atlas(mesh, result.spacing, options.width, options.height, options.gutter);
  const Atlas& atlas = result.atlas;
  const TexelNodes nodes(mesh, atlas);
  const TexelColors colors = average_colors(atlas, nodes, dense.colors, result.simplified.landings);
  result.texels = counts_of(atlas, colors);
  result.texture = painted(atlas, completed_colors(dense, decimation.tree, nodes, colors, options.fill, result));
  paint_borders(atlas, result.texture);
  result.share = options.corners == Corners::exact ? 0 : drawn_in_share(atlas);
  result.mesh = textured(mesh, atlas, result.share);
  result.without_face = colors.without_face;
  result.seam_residual = largest_seam_residual(mesh, atlas, result.texture);
  return result;
}

}  // namespace etalon::bake
