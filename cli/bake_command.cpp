#include "cli/bake_command.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "cli/attribution.h"
#include "cli/call_files.h"
#include "cli/exit_code.h"
#include "cli/interrupt.h"
#include "cli/model_input.h"
#include "cli/range_input.h"
#include "cli/reduction_options.h"
#include "cli/repair_notes.h"
#include "cli/size_option.h"
#include "cli/usage_error.h"
#include "core/bake/bake.h"
#include "core/io/inputs.h"
#include "core/io/mesh_file.h"
#include "validation/report/json_report.h"

namespace etalon::cli {
namespace {

using Json = nlohmann::ordered_json;
using bake::BakeResult;
using validation::grouped;

struct Options {
  std::string scan, output, size = "512", fill = "iterative", corners = "inset";
  ReductionOptions reduction;
  RangeOptions range;
  bake::Gutter gutter;
  CommonOptions common;
};

FrameSize require_options(const Options& options) {
  if (options.output == "-") throw UsageError("bake: a model may be several files: expected -o FILE.obj, .ply or .glb");
  if (!options.reduction.faces && options.reduction.tolerance.empty()) throw UsageError("bake: expected --faces or --tolerance");
  (void)tolerance_of(options.reduction, 1, "bake", true);
  const FrameSize size = parse_size(options.size, bake::kLargestMap);
  try {
    (void)bake::largest_size(size.width, size.height, options.gutter);
  } catch (const InputError& error) {
    throw UsageError(fmt::format("bake: --size: {}", error.what()));
  }
  return size;
}

// With a gutter what it is for. Mip levels beyond it hold several triangles, but a sampler cannot leave them out.
io::TextureLookup lookup_for(bake::Gutter gutter) {
  if (!gutter) return io::TextureLookup::nearest;
  return *gutter == 0 ? io::TextureLookup::linear : io::TextureLookup::mipmap;
}

std::vector<io::Material> materials_of(Image texture, bake::Gutter gutter) {
  return {{.name = "baked", .texture_path = {}, .texture = std::move(texture), .lookup = lookup_for(gutter)}};
}

double growth_of(const bake::Atlas& atlas) { return static_cast<double>(atlas.rows) / static_cast<double>(atlas.rows_without); }

Json gutter_json(const BakeResult& result) {
  const bake::Atlas& atlas = result.atlas;
  if (!atlas.gutter) return nullptr;
  return {{"levels", *atlas.gutter}, {"border", 1 << *atlas.gutter},       {"texels", result.texels.border},
          {"rows", atlas.rows},      {"rows_without", atlas.rows_without}, {"growth", growth_of(atlas)}};
}

Json sizes_json(const bake::Atlas& atlas) {
  bake::SizeCounts counts{};
  for (const bake::Tile& tile : atlas.tiles)
    for (std::size_t k = 1; k < bake::kSizeCount; ++k) counts[k] += tile.size == 1 << k;
  Json sizes = Json::array();
  for (std::size_t k = bake::kSizeCount - 1; k > 0; --k)
    if (counts[k] > 0) sizes.push_back({{"size", 1 << k}, {"triangles", counts[k]}});
  return sizes;
}

validation::VerifyInput input_of(const Options& options, const io::LoadedModel& scan) {
  validation::VerifyInput input = file_input(options.scan, "scan");
  input.attribution = attribution_of(input.sha256);
  if (input.attribution.empty()) input.attribution = scan.credit;
  return input;
}

std::vector<validation::VerifyInput> inputs_of(const Options& options, const validation::VerifyInput& scan) {
  if (options.range.texture.empty()) return {scan};
  return {scan, file_input(options.range.texture, "texture")};
}

Json document_of(const Options& options, const validation::VerifyInput& input, const io::LoadedModel& scan, const BakeResult& result,
                 std::optional<double> tolerance) {
  Json document = validation::document_head("bake", inputs_of(options, input));
  document["target_faces"] = options.reduction.faces ? Json(*options.reduction.faces) : Json(nullptr);
  document["tolerance"] = tolerance ? Json(*tolerance) : Json(nullptr);
  document["width"] = result.atlas.width;
  document["height"] = result.atlas.height;
  document["fill"] = options.fill;
  document["corners"] = options.corners;
  document["gutter"] = gutter_json(result);
  document["vertices_in"] = scan.mesh.vertex_count();
  document["vertices_out"] = result.mesh.vertex_count();
  document["faces_in"] = scan.mesh.face_count();
  document["faces_out"] = result.mesh.face_count();
  document["stop"] = to_string(result.simplified.stop);
  document["distance_max"] = *result.simplified.distance_max;
  document["distance_audited"] = result.simplified.distance_audited ? Json(*result.simplified.distance_audited) : Json(nullptr);
  document["spacing"] = result.spacing;
  document["sizes"] = sizes_json(result.atlas);
  document["reductions"] = result.atlas.reductions;
  document["handed_down"] = result.atlas.handed_down;
  document["drawn_in"] = result.share;
  document["texels"] = {{"atlas", result.texels.atlas},
                        {"inside", result.texels.inside},
                        {"hit", result.texels.hit},
                        {"averaged", result.texels.averaged},
                        {"filled", result.texels.filled}};
  document["vertices_in_no_face"] = result.without_face;
  document["iterations"] = result.iterations;
  document["fill_distance_max"] = result.fill_distance_max;
  document["seam_residual_max"] = result.seam_residual;
  document["repair"] = repair_json(result.simplified.repair);
  document["mesh_sha256"] = mesh_sha256(result.mesh);
  document["texture_sha256"] = result.texture.sha256();
  validation::RunInfo run = validation::current_run(options.common.start);
  run.paths = {options.scan, options.output};
  document["run"] = validation::to_json(run);
  return document;
}

void print_result(Console& console, const Options& options, const io::LoadedModel& scan, const BakeResult& result) {
  for (const std::string& note : scan.notes) console.line("note: " + note);
  print_repair(console, result.simplified.repair);
  const auto percent = [&](std::uint64_t texels) {
    return fmt::format("{:.1f} %", 100.0 * static_cast<double>(texels) / static_cast<double>(result.texels.inside));
  };
  console.line(fmt::format("{}: {} of {} faces; no vertex of the scan is farther than {:.6g} from them", options.output,
                           grouped(result.mesh.face_count()), grouped(scan.mesh.face_count()),
                           result.simplified.distance_audited.value_or(*result.simplified.distance_max)));
  console.line(fmt::format("texture {}x{}: {} of {} texels in triangles of size {} to {}; hit {} (averaged {}), filled {}",
                           result.atlas.width, result.atlas.height, grouped(result.texels.inside), grouped(result.texels.atlas),
                           sizes_json(result.atlas).back()["size"].get<int>(), sizes_json(result.atlas).front()["size"].get<int>(),
                           percent(result.texels.hit), percent(result.texels.averaged), percent(result.texels.filled)));
  if (const bake::Atlas& atlas = result.atlas; atlas.gutter)
    console.line(fmt::format("gutter of {} for linear lookup in {}: triangles of these sizes take {} rows, without it {}: {:.2f} times",
                             counted(std::uint64_t{1} << *atlas.gutter, "texel"),
                             *atlas.gutter == 0 ? "level 0" : fmt::format("levels 0 to {}", *atlas.gutter), grouped(atlas.rows),
                             grouped(atlas.rows_without), growth_of(atlas)));
  if (result.atlas.reductions > 0)
    console.line(fmt::format("sizes were halved {} for the map: it filters the colours", counted(result.atlas.reductions, "time")));
  else if (result.texels.inside < result.texels.atlas / 16)
    console.line(fmt::format(
        "note: at the scan's mean edge length, {:.6g}, the triangles ask for no more texels: a few long edges make it large, or "
        "a smaller map would do",
        result.spacing));
  console.line(fmt::format("largest difference across edges and vertices: {}", result.seam_residual));
}

int run(const Options& options) {
  apply(options.common);
  const FrameSize size = require_options(options);
  require_colors(options.scan, options.range, "bake");
  require_writable_file(options.output);
  require_writable_file(options.common.json);
  Console console(console_options(options.common));
  CallFiles files;
  files.add_input(options.scan, "the scan");
  const io::LoadedModel scan = load_scan(options.scan, options.range, files);
  add_side_files(files, scan);
  const std::vector<std::filesystem::path> outputs =
      io::mesh_output_files(options.output, materials_of(Image(1, 1, kRgb8), options.gutter));
  for (const std::filesystem::path& path : outputs) files.add_output(path.string(), "-o");
  files.add_output(options.common.json, "--json");

  bake::BakeOptions how{.width = size.width, .height = size.height, .gutter = options.gutter};
  how.target_faces = static_cast<std::size_t>(options.reduction.faces.value_or(0));
  how.tolerance = tolerance_of(options.reduction, bounding_box(scan.mesh).diagonal(), "bake", true);
  how.fill = options.fill == "exact"     ? bake::FillKind::exact
             : options.fill == "sampled" ? bake::FillKind::sampled
                                         : bake::FillKind::iterative;
  how.corners = options.corners == "exact" ? bake::Corners::exact : bake::Corners::inset;
  how.progress = [&](std::size_t done, std::size_t total) {
    console.progress("faces removed", static_cast<int>(done), static_cast<int>(total));
  };
  const validation::VerifyInput input = input_of(options, scan);
  const BakeResult result = naming_the_model(options.scan, [&] { return bake::bake_scan(scan.mesh, how); });
  {
    const FinishWriting writing;
    io::write_mesh(options.output, result.mesh, materials_of(result.texture, options.gutter), input.attribution);
  }
  print_result(console, options, scan, result);
  if (!input.attribution.empty()) console.line("by " + input.attribution);
  for (const std::filesystem::path& path : outputs) console.line("wrote " + path.string());
  write_document(options.common, document_of(options, input, scan, result, how.tolerance));
  if (!options.common.json.empty() && options.common.json != "-") console.line("wrote " + options.common.json);
  if (!options.reduction.faces) return kExitDone;
  print_unreached(console, result.simplified, how.target_faces);
  return result.simplified.stop == simplify::StopReason::faces ? kExitDone : kExitWarning;
}

}  // namespace

Verb add_bake(CLI::App& root) {
  const auto options = std::make_shared<Options>();
  CLI::App* app = root.add_subcommand("bake", "Write a coloured scan as few triangles and a texture map of its vertex colours");
  app->add_option("scan", options->scan, "Mesh with vertex colours: .ply .obj .glb .gltf; or a range image: .png .tif .exr, with --texture")
      ->required()
      ->type_name("SCAN")
      ->check(not_empty());
  add_reduction_options(*app, options->reduction, 1, "scan", "--faces");
  app->add_option("--size", options->size, "Texels of the map, the width a power of two (default 512x512)")
      ->type_name("WxH")
      ->check(not_empty());
  app->add_option(
         "--fill", options->fill,
         "What texels that no vertex fell into take: the colour of the nearest on the surface, by the paper's iteration (default) or "
         "exactly; sampled (not the paper's): all texels take the scan's colours between its vertices")
      ->type_name("iterative|exact|sampled")
      ->check(CLI::IsMember({"iterative", "exact", "sampled"}));
  app->add_option("--corners", options->corners,
                  "Texture coordinates: drawn in by 1/8192 of a triangle's size, so that its points are looked up in its own texels "
                  "(default); or the paper's, on the corners of texels")
      ->type_name("inset|exact")
      ->check(CLI::IsMember({"inset", "exact"}));
  add_range_options(*app, options->range);
  app->add_option("--gutter", options->gutter,
                  "Surround each triangle with 2^N texels, so that linear filtering, in mip levels 0 to N too, shows no other triangle's "
                  "texels; N: 0 to 8 (default: none, for nearest lookup)")
      ->type_name("N")
      ->check(CLI::Range(0, bake::kLargestGutter));
  app->add_option("-o,--output", options->output,
                  "Model to write, its texture beside or in it: .obj .ply .glb; for nearest lookup, or with a gutter linear")
      ->required()
      ->type_name("MODEL")
      ->check(not_empty());
  add_common_options(*app, options->common,
                     "  etalon bake scan.ply --faces 1000 -o scan1000.glb\n"
                     "  etalon bake scan.ply --tolerance 0.2% --size 1024x512 --fill exact -o near.obj\n"
                     "  etalon bake depth.tif --texture colour.png --spacing 0.7 --depth-scale 0.1 --faces 2000 -o scan.glb\n"
                     "  etalon bake scan.ply --faces 1000 --size 1024 --gutter 3 -o smooth.glb\n"
                     "  etalon render near.obj --filter nearest -o near.png");
  return {app, [options] { return run(*options); }};
}

}  // namespace etalon::cli
