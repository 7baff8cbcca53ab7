#include "cli/adapt_input.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "cli/model_input.h"
#include "core/adapt/cell_chunks.h"
#include "core/base/error.h"
#include "core/io/inputs.h"
#include "validation/report/json_report.h"

namespace etalon::cli {
namespace {

using validation::grouped;

constexpr double kMostOverlap = 0.01, kMostOutside = 0.5;
constexpr int kMostOutsideTexels = 2048;

double farthest_outside(const MeshReport& report) {
  const Vec2f &lo = report.uv_min, &hi = report.uv_max;
  return std::max({0.0, -static_cast<double>(lo.x), -static_cast<double>(lo.y), hi.x - 1.0, hi.y - 1.0});
}

}  // namespace

progressive::EpmContent read_whole(const std::string& path) {
  const io::FileBytes file = io::read_file(path);
  progressive::EpmContent content = naming_the_model(path, [&] { return progressive::decode_epm(file.bytes()); });
  if (!content.complete && content.mesh.split_count() == content.splits_in_whole)
    throw InputError(fmt::format("{}: expected a whole file, got all {} splits but not all that follows (cells, the end mark)", path,
                                 grouped(content.splits_in_whole)));
  if (!content.complete)
    throw InputError(fmt::format("{}: expected a whole progressive mesh, got {} of {} splits: a texture belongs to the finest level", path,
                                 grouped(content.mesh.split_count()), grouped(content.splits_in_whole)));
  return content;
}

adapt::AdaptSequence cells_of(progressive::EpmContent& content, const std::string& name, Console& console) {
  return naming_the_model(name, [&] {
    const auto progress = [&](std::size_t done, std::size_t total) {
      console.progress("cells", static_cast<int>(done), static_cast<int>(total));
    };
    if (auto stored = adapt::decode_cells(content, progress)) return std::move(*stored);
    adapt::AdaptSequence made(content.mesh, progress);
    console.line(fmt::format("note: {} has no cells: made now, the same that `etalon progressive` stores", name));
    return made;
  });
}

bool TextureSpace::overlaps() const { return report.uv_overlap_share > kMostOverlap; }

TextureSpace examine_texture_space(progressive::ProgressiveMesh& mesh, const adapt::AdaptSequence& sequence, int largest_side,
                                   const std::string& name) {
  TextureSpace space;
  mesh.go_to(mesh.split_count());
  space.report = validate_mesh(mesh.mesh(), {.overlap_grid = 1024});
  const double outside = farthest_outside(space.report);
  if (outside >= kMostOutside)
    throw InputError(
        fmt::format("{}: texture coordinates: expected less than half a texture outside of [0, 1], got {:.4g}: a tiled texture has "
                    "one texel for many points of the surface; bake it into one that has not",
                    name, outside));
  if (outside * largest_side > kMostOutsideTexels)
    throw InputError(
        fmt::format("{}: texture coordinates: expected at most {} texels outside of [0, 1], got {:.0f} of {}; a smaller map would do", name,
                    grouped(kMostOutsideTexels), outside * largest_side, grouped(static_cast<std::uint64_t>(largest_side))));
  space.rings = adapt::cell_statistics(sequence).rings;
  return space;
}

void print_texture_space(Console& console, const TextureSpace& space) {
  const MeshReport& report = space.report;
  if (report.uv_outside.found())
    console.line(
        fmt::format("{} corners have texture coordinates outside of [0, 1], by up to {:.4g}: there the texture's border texels show",
                    grouped(report.uv_outside.count), farthest_outside(report)));
  if (report.folds.found() || report.degenerate_uv_faces.found())
    console.line(fmt::format("{} faces are turned over in texture space, {} have no area there: collapses beside them adapt nothing",
                             grouped(report.folds.count), grouped(report.degenerate_uv_faces.count)));
  const auto count = [&](adapt::CellStatus status) { return space.rings[static_cast<std::size_t>(status)]; };
  const std::size_t folds = count(adapt::CellStatus::fold), no_place = count(adapt::CellStatus::no_place);
  if (folds + no_place > 0)
    console.line(fmt::format("{} of {} rings have no cells ({} folds, {} without a place for the vertex): the texture stays as it is there",
                             grouped(folds + no_place), grouped(std::accumulate(space.rings.begin(), space.rings.end(), std::size_t{0})),
                             grouped(folds), grouped(no_place)));
  if (space.overlaps())
    print_warning(
        fmt::format("{:.1f} % of the texture that faces cover is covered by several: what one collapse adapts another part of the "
                    "surface shows",
                    100 * report.uv_overlap_share));
}

void add_texture_space(nlohmann::ordered_json& document, const TextureSpace& space) {
  const MeshReport& report = space.report;
  document["coordinates"] = {{"outside", report.uv_outside.count},
                             {"outside_by", farthest_outside(report)},
                             {"overlap_share", report.uv_overlap_share},
                             {"folds", report.folds.count},
                             {"without_area", report.degenerate_uv_faces.count},
                             {"mirrored_charts", report.mirrored_charts.count}};
  nlohmann::ordered_json& rings = document["rings"];
  for (std::size_t n = 0; n < space.rings.size(); ++n) rings[adapt::to_string(static_cast<adapt::CellStatus>(n))] = space.rings[n];
}

}  // namespace etalon::cli
