#include "cli/make_command.h"

#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "cli/call_files.h"
#include "cli/exit_code.h"
#include "cli/interrupt.h"
#include "cli/model_input.h"
#include "cli/usage_error.h"
#include "core/io/mesh_file.h"
#include "core/procedural/head.h"
#include "core/procedural/swirl.h"
#include "validation/report/json_report.h"

namespace etalon::cli {
namespace {

// What core/procedural takes.
constexpr int kFewestSwirlFaces = 2;
constexpr int kFewestHeadFaces = 72;
constexpr int kMostFaces = 2'000'000;

struct MakeOptions {
  std::string what;
  std::string output;
  std::optional<int> faces;
  int texture_size = 1024;
  CommonOptions common;
};

procedural::Model make_model(const MakeOptions& options) {
  const int fewest = options.what == "swirl" ? kFewestSwirlFaces : kFewestHeadFaces;
  if (options.faces && (*options.faces < fewest || *options.faces > kMostFaces))
    throw UsageError(fmt::format("--faces: {}: expected {} to {}, got {}", options.what, fewest, kMostFaces, *options.faces));
  if (options.what == "swirl") {
    procedural::SwirlOptions swirl{.faces = 7688, .texture_size = options.texture_size};
    if (options.faces) swirl.faces = *options.faces;
    return procedural::make_swirl(swirl);
  }
  procedural::HeadOptions head{.faces = 7685, .texture_size = options.texture_size};
  if (options.faces) head.faces = *options.faces;
  return procedural::make_head(head);
}

nlohmann::ordered_json document_of(const MakeOptions& options, const procedural::Model& model) {
  nlohmann::ordered_json document = validation::document_head("make", {});
  document["model"] = model.name;
  document["vertices"] = model.mesh.vertex_count();
  document["faces"] = model.mesh.face_count();
  document["mesh_sha256"] = mesh_sha256(model.mesh);
  document["texture"] = {{"width", model.texture.width()}, {"height", model.texture.height()}, {"sha256", model.texture.sha256()}};
  validation::RunInfo run = validation::current_run(options.common.start);
  run.paths = {options.output};
  document["run"] = validation::to_json(run);
  return document;
}

int run_make(const MakeOptions& options) {
  apply(options.common);
  if (options.output == "-") throw UsageError("make: a model and its texture are several files: expected -o FILE.obj, .ply or .glb");
  require_writable_file(options.output);
  require_writable_file(options.common.json);
  Console console(console_options(options.common));
  const procedural::Model model = make_model(options);
  const std::vector<io::Material> materials{{.name = model.name, .texture_path = {}, .texture = model.texture}};
  const std::vector<std::filesystem::path> outputs = io::mesh_output_files(options.output, materials);
  CallFiles files;
  for (const std::filesystem::path& path : outputs) files.add_output(path.string(), "-o");
  files.add_output(options.common.json, "--json");
  {
    const FinishWriting finish;
    io::write_mesh(options.output, model.mesh, materials);
  }
  console.line(fmt::format("{}: {} with {} vertices, {}, texture {}x{}", options.output, model.name,
                           validation::grouped(model.mesh.vertex_count()), counted(model.mesh.face_count(), "face"), model.texture.width(),
                           model.texture.height()));
  for (const std::filesystem::path& path : outputs) console.line("wrote " + path.string());
  write_document(options.common, document_of(options, model));
  if (!options.common.json.empty() && options.common.json != "-") console.line("wrote " + options.common.json);
  return kExitDone;
}

}  // namespace

Verb add_make(CLI::App& root) {
  const auto options = std::make_shared<MakeOptions>();
  CLI::App* app = root.add_subcommand("make", "Write a procedural model and its texture");
  app->add_option("what", options->what, "swirl: the curved grid of a swirled texture; head: the embedded default")
      ->required()
      ->check(CLI::IsMember({"swirl", "head"}))
      ->type_name("swirl|head");
  app->add_option("--faces", options->faces,
                  "About how many triangles, up to 2,000,000: swirl from 2 (default 7,688), head from 72 (default 7,685)")
      ->type_name("N");
  app->add_option("--texture-size", options->texture_size, "Side of the texture in texels (default 1024)")
      ->type_name("N")
      ->check(CLI::Range(64, 8192));
  app->add_option("-o,--output", options->output,
                  "Model to write, with its texture STEM_texture.png beside it: .obj, .ply; or in one file: .glb")
      ->required()
      ->type_name("FILE")
      ->check(not_empty());
  add_common_options(*app, options->common, "  etalon make head -o head.obj");
  return {app, [options] { return run_make(*options); }};
}

}  // namespace etalon::cli
