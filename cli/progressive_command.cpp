#include "cli/progressive_command.h"

#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "cli/call_files.h"
#include "cli/cell_report.h"
#include "cli/exit_code.h"
#include "cli/interrupt.h"
#include "cli/model_input.h"
#include "cli/repair_notes.h"
#include "cli/usage_error.h"
#include "cli/work_bytes.h"
#include "core/adapt/cell_chunks.h"
#include "core/base/error.h"
#include "core/io/atomic_file.h"
#include "core/io/inputs.h"
#include "core/io/mesh_file.h"
#include "core/mesh/weld.h"
#include "core/progressive/epm_format.h"
#include "validation/report/json_report.h"

namespace etalon::cli {
namespace {

using Json = nlohmann::ordered_json;
using validation::grouped;

struct Options {
  std::string input, output, metric = "qem", collapse = "half";
  std::int64_t faces = 0;
  bool faces_given = false, metric_given = false, collapse_given = false, no_cells = false, flip_v = false;
  CommonOptions common;
};

bool is_epm(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return extension == ".epm";
}

void finish(const Options& options, Console& console, Json document) {
  validation::RunInfo run = validation::current_run(options.common.start);
  run.paths = {options.input, options.output};
  document["run"] = validation::to_json(run);
  write_document(options.common, document);
  if (!options.common.json.empty() && options.common.json != "-") console.line("wrote " + options.common.json);
}

/// The name as .epm may hold it: without control characters.
std::string printable(std::string name) {
  for (char& c : name)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
  return name;
}

/// The cells of texture adaptation, for the file; `data` as it will be read.
CellReport make_cells(const progressive::ProgressiveData& data, Console& console, std::vector<progressive::EpmExtra>& extras) {
  progressive::ProgressiveMesh mesh(data);
  const adapt::AdaptSequence cells(
      mesh, [&](std::size_t done, std::size_t total) { console.progress("cells", static_cast<int>(done), static_cast<int>(total)); });
  extras = adapt::encode_cells(cells);
  return {adapt::cell_statistics(cells), adapt::cell_chunk_bytes(extras)};
}

int make_file(const Options& options, Console& console, CallFiles& files) {
  io::LoadedModel model = io::read_mesh(options.input, kMinProgressiveBytesPerFace);
  add_side_files(files, model);
  files.add_output(options.output, "-o");
  files.add_output(options.common.json, "--json");
  if (options.flip_v) {
    if (!model.mesh.has_uv) throw InputError(fmt::format("{}: --flip-v needs texture coordinates, and the model has none", options.input));
    io::flip_v(model.mesh);
  }
  const Mesh mesh = welded_by_position(model.mesh);
  progressive::ProgressiveResult made = naming_the_model(options.input, [&] {
    simplify::SimplifyOptions how;
    how.metric = simplify::metric_named(options.metric);
    how.collapse = options.collapse == "full" ? simplify::CollapseKind::full : simplify::CollapseKind::half;
    how.target_faces = static_cast<std::size_t>(options.faces);
    how.progress = [&](std::size_t done, std::size_t total) {
      console.progress("faces removed", static_cast<int>(done), static_cast<int>(total));
    };
    progressive::ProgressiveResult result = progressive::make_progressive(mesh, how);
    if (result.data.faces.empty()) throw InputError("expected a face with three different vertices, got none");
    return result;
  });
  for (const std::string& note : model.notes) console.line("note: " + note);
  print_repair(console, made.simplified.repair);
  for (const io::Material& material : model.materials) made.data.material_names.push_back(printable(material.name));
  std::vector<progressive::EpmExtra> extras;
  std::optional<CellReport> cells;
  if (made.data.has_uv && !options.no_cells) cells = make_cells(made.data, console, extras);
  const std::string bytes = progressive::encode_epm(made.data, extras);
  {
    const FinishWriting writing;
    io::write_file(options.output, bytes);
  }
  console.line(fmt::format("{}: from {} down to {} faces in {} splits, {} bytes", options.output, grouped(mesh.face_count()),
                           grouped(made.data.base_faces), grouped(made.data.splits.size()), grouped(bytes.size())));
  if (cells)
    for (const std::string& line : cell_lines(*cells)) console.line(line);
  const bool reached = !options.faces_given || made.simplified.stop == simplify::StopReason::faces;
  if (!reached)
    console.line(fmt::format("stopped above the {} faces asked for: every collapse left is refused",
                             grouped(static_cast<std::uint64_t>(options.faces))));
  if (const std::string attribution = file_input(options.input, "model").attribution; !attribution.empty())
    console.line("by " + attribution);
  console.line("wrote " + options.output);
  Json document = validation::document_head("progressive", {file_input(options.input, "model")});
  document["metric"] = options.metric;
  document["collapse"] = options.collapse;
  document["records"] = made.data.splits.size();
  document["records_in_whole"] = made.data.splits.size();
  document["complete"] = true;
  document["faces_base"] = made.data.base_faces;
  document["faces"] = made.data.faces.size();
  add_cell_members(cells, document);
  document["bytes"] = bytes.size();
  document["mesh_sha256"] = nullptr;
  finish(options, console, std::move(document));
  return reached ? kExitDone : kExitWarning;
}

int take_level(const Options& options, Console& console, CallFiles& files) {
  if (!options.faces_given) throw UsageError("progressive: expected --faces N with an .epm file: the level to write");
  if (options.metric_given) throw UsageError("progressive: --metric is of making an .epm file, not of taking a level from one");
  if (options.collapse_given) throw UsageError("progressive: --collapse is of making an .epm file, not of taking a level from one");
  if (options.no_cells) throw UsageError("progressive: --no-cells is of making an .epm file, not of taking a level from one");
  if (options.flip_v) throw UsageError("progressive: --flip-v is of making an .epm file, not of taking a level from one");
  if (options.output == "-") throw UsageError("progressive: a model may be several files: expected -o FILE.obj, .ply or .glb");
  const io::FileBytes file = io::read_file(options.input);
  progressive::EpmContent content = naming_the_model(options.input, [&] { return progressive::decode_epm(file.bytes()); });
  content.mesh.go_to_faces(static_cast<std::size_t>(options.faces));
  const Mesh mesh = content.mesh.mesh();
  // A file of before had no names; then the indices mean nothing.
  std::vector<io::Material> materials;
  for (const std::string& name : content.mesh.data().material_names) materials.push_back({.name = name, .texture_path = {}, .texture = {}});
  Mesh named = mesh;
  if (materials.empty()) named.face_materials.clear();
  for (const std::filesystem::path& path : io::mesh_output_files(options.output, materials)) files.add_output(path.string(), "-o");
  files.add_output(options.common.json, "--json");
  {
    const FinishWriting writing;
    io::write_mesh(options.output, named, materials);
  }
  if (!content.complete)
    console.line(fmt::format("note: {} is cut short: {} of {} splits", options.input, grouped(content.mesh.split_count()),
                             grouped(content.splits_in_whole)));
  console.line(fmt::format("{}: {} and {} vertices, level {} of {}", options.output, counted(mesh.face_count(), "face"),
                           grouped(mesh.vertex_count()), grouped(content.mesh.level()), grouped(content.mesh.split_count())));
  const bool reached = mesh.face_count() <= static_cast<std::size_t>(options.faces);
  if (!reached)
    console.line(fmt::format("the base has more than the {} faces asked for", grouped(static_cast<std::uint64_t>(options.faces))));
  console.line("wrote " + options.output);
  Json document = validation::document_head("progressive", {file_input(options.input, "progressive mesh")});
  document["metric"] = nullptr;
  document["collapse"] = nullptr;
  document["records"] = content.mesh.split_count();
  document["records_in_whole"] = content.splits_in_whole;
  document["complete"] = content.complete;
  document["faces_base"] = content.mesh.face_count_at(0);
  document["faces"] = mesh.face_count();
  add_cell_members(std::nullopt, document);
  document["bytes"] = file.bytes().size();
  document["mesh_sha256"] = mesh_sha256(mesh);
  finish(options, console, std::move(document));
  return reached ? kExitDone : kExitWarning;
}

int run(const Options& options) {
  apply(options.common);
  if ((options.metric == "kim" || options.metric == "aps") && options.collapse == "full")
    throw UsageError(fmt::format("progressive: --metric {} is of half-edge collapses: --collapse half", options.metric));
  if (is_epm(options.input) == is_epm(options.output))
    throw UsageError("progressive: expected a model and -o FILE.epm, or an .epm file and -o MODEL");
  require_writable_file(options.output);
  require_writable_file(options.common.json);
  Console console(console_options(options.common));
  CallFiles files;
  files.add_input(options.input, "the input");
  return is_epm(options.output) ? make_file(options, console, files) : take_level(options, console, files);
}

}  // namespace

Verb add_progressive(CLI::App& root) {
  const auto options = std::make_shared<Options>();
  CLI::App* app = root.add_subcommand("progressive", "Turn a model into a progressive mesh, or write one of its levels as a model");
  app->add_option("input", options->input, "Model (.obj .ply .stl .glb .gltf), or a progressive mesh (.epm) to take a level from")
      ->required()
      ->type_name("IN")
      ->check(not_empty());
  CLI::Option* faces = app->add_option("--faces", options->faces,
                                       "From a model: triangles of the base (default: as few as it goes); from .epm: of the level, at most")
                           ->type_name("N")
                           ->check(CLI::Range(std::int64_t{0}, std::int64_t{1} << 32));
  CLI::Option* metric =
      app->add_option(
             "--metric", options->metric,
             "Error metric, as of simplify: qem (default); qem5 and aps mind texture coordinates; qem6, hoppe and kim vertex colours")
          ->type_name("METRIC")
          ->check(CLI::IsMember({"qem", "qem5", "qem6", "hoppe", "kim", "aps"}));
  CLI::Option* collapse =
      app->add_option("--collapse", options->collapse,
                      "half (default): a vertex goes into a neighbour; full: both ends to the best place (not kim, aps)")
          ->type_name("KIND")
          ->check(CLI::IsMember({"half", "full"}));
  app->add_flag("--no-cells", options->no_cells,
                "Store no cells of texture adaptation (a model with texture coordinates has them, 12 bytes a split)");
  app->add_flag("--flip-v", options->flip_v, "The model's texture coordinates run from top to bottom against its format's convention");
  app->add_option("-o,--output", options->output, "Progressive mesh (.epm), or the level's model (.obj .ply .glb; without materials)")
      ->required()
      ->type_name("OUT")
      ->check(not_empty());
  add_common_options(*app, options->common,
                     "  etalon progressive scan.ply -o scan.epm\n  etalon progressive scan.epm --faces 5000 -o level.ply");
  return {app, [options, faces, metric, collapse] {
            options->collapse_given = collapse->count() > 0;
            options->faces_given = faces->count() > 0, options->metric_given = metric->count() > 0;
            return run(*options);
          }};
}

}  // namespace etalon::cli
