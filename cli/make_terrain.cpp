#include "cli/make_terrain.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "cli/call_files.h"
#include "cli/exit_code.h"
#include "cli/interrupt.h"
#include "cli/model_input.h"
#include "cli/usage_error.h"
#include "core/io/image_file.h"
#include "core/procedural/alps.h"
#include "core/terrain/levels.h"
#include "validation/report/json_report.h"

namespace etalon::cli {
namespace {

std::filesystem::path texture_path(const std::filesystem::path& dem) { return dem.parent_path() / (dem.stem().string() + "_color.png"); }

nlohmann::ordered_json image_json(const Image& image) {
  return {{"width", image.width()}, {"height", image.height()}, {"sha256", image.sha256()}};
}

nlohmann::ordered_json document_of(const MakeTerrainOptions& options, const CommonOptions& common, const procedural::Alps& alps) {
  const terrain::HeightField field = terrain::make_height_field(alps.dem, {.dem_spacing = alps.spacing}).field;
  const Mesh mesh = terrain::level_mesh(field, terrain::uniform_grid(field.bits, field.bits), 0);
  nlohmann::ordered_json document = validation::document_head("make", {});
  document["model"] = "terrain";
  document["vertices"] = mesh.vertex_count();
  document["faces"] = mesh.face_count();
  document["mesh_sha256"] = mesh_sha256(mesh);
  document["texture"] = image_json(alps.texture);
  document["dem"] = image_json(alps.dem);
  document["spacing_m"] = alps.spacing;
  validation::RunInfo run = validation::current_run(common.start);
  run.paths = {options.output, texture_path(options.output).string()};
  document["run"] = validation::to_json(run);
  return document;
}

}  // namespace

int run_make_terrain(const MakeTerrainOptions& options, const CommonOptions& common) {
  const std::filesystem::path dem = options.output;
  const std::string extension = dem.extension().string();
  if (extension != ".tif" && extension != ".tiff" && extension != ".exr")
    throw UsageError(fmt::format("make terrain: heights are float32: expected -o FILE.tif or .exr, got {}", options.output));
  const int size = options.size.value_or(257);
  bool is_grid = false;
  for (int steps = 32; steps <= 4096; steps *= 2) is_grid = is_grid || size == steps + 1;
  if (!is_grid)
    throw UsageError(fmt::format("--size: terrain: expected 2^k+1 heights on a side, 33, 65 … 257, 513, 1025 … 4097, got {}", size));
  const std::filesystem::path texture = texture_path(dem);
  for (const std::string& path : {options.output, texture.string(), common.json}) require_writable_file(path);
  CallFiles files;
  files.add_output(options.output, "-o");
  files.add_output(texture.string(), "-o");
  files.add_output(common.json, "--json");
  Console console(console_options(common));
  const procedural::Alps alps = procedural::make_alps(
      {.size = size, .texture_size = options.texture_size.value_or(std::min(8192, 4 * (size - 1))), .progress = [&](int done, int total) {
         console.progress("making the terrain", done, total);
       }});
  {
    const FinishWriting finish;
    io::write_image(dem, alps.dem);
    io::write_image(texture, alps.texture);
  }
  console.line(fmt::format("{}: terrain of {}x{} heights, {} m apart, orthophoto {}x{}", options.output, size, size, alps.spacing,
                           alps.texture.width(), alps.texture.height()));
  console.line("wrote " + options.output);
  console.line("wrote " + texture.string());
  console.line(fmt::format("try: etalon joint {} {} --spacing {} -o FOLDER", options.output, texture.string(), alps.spacing));
  write_document(common, document_of(options, common, alps));
  if (!common.json.empty() && common.json != "-") console.line("wrote " + common.json);
  return kExitDone;
}

}  // namespace etalon::cli
