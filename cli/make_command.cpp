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
#include "cli/make_range.h"
#include "cli/make_terrain.h"
#include "cli/model_input.h"
#include "cli/usage_error.h"
#include "core/io/mesh_file.h"
#include "core/procedural/duck.h"
#include "core/procedural/head.h"
#include "core/procedural/knot.h"
#include "core/procedural/monkey.h"
#include "core/procedural/statue.h"
#include "core/procedural/swirl.h"
#include "validation/report/json_report.h"

namespace etalon::cli {
namespace {

struct MakeOptions {
  std::string what;
  std::string output;
  std::optional<int> faces;
  std::optional<int> texture_size;
  std::optional<std::string> kind, image;
  std::optional<int> size;
  bool open = false;
  CommonOptions common;
};

/// What core/procedural takes, by name.
struct Kind {
  const char* name;
  int fewest, most, normal;
  bool even;      ///< only even counts
  bool textured;  ///< else coloured by vertex
};
constexpr Kind kKinds[] = {
    {"swirl", 2, 2'000'000, 7'688, false, true},          {"head", 72, 2'000'000, 7'685, false, true},
    {"monkey", 20'000, 10'000'000, 101'002, true, false}, {"duck", 2'000, 10'000'000, 166'278, false, false},
    {"statue", 40'000, 10'000'000, 200'000, true, false}, {"knot", 250, 10'000'000, 100'000, false, false},
};

const Kind& kind_of(const std::string& name) {
  for (const Kind& kind : kKinds)
    if (name == kind.name) return kind;
  throw UsageError("make: unknown model " + name);
}

/// A mesh, and its texture where it has one.
struct Made {
  Mesh mesh;
  std::optional<Image> texture;
};

procedural::DuckOptions duck_options(const MakeOptions& options) {
  if (!options.faces) return procedural::duck_of_paper(options.open);
  return procedural::duck_of_faces(*options.faces, options.open);
}

Made make_model(const MakeOptions& options, const procedural::ProcedureProgress& progress) {
  const Kind& kind = kind_of(options.what);
  const int faces = options.faces.value_or(kind.normal);
  if (faces < kind.fewest || faces > kind.most)
    throw UsageError(fmt::format("--faces: {}: expected {} to {}, got {}", options.what, kind.fewest, kind.most, faces));
  if (kind.even && faces % 2 != 0) throw UsageError(fmt::format("--faces: {}: expected an even number, got {}", options.what, faces));
  if (options.texture_size && !kind.textured)
    throw UsageError(fmt::format("--texture-size: {} is coloured by vertex and has no texture", options.what));
  if (options.open && options.what != "duck") throw UsageError("--open is of duck");
  const int texture_size = options.texture_size.value_or(1024);
  if (options.what == "swirl") {
    procedural::Model model = procedural::make_swirl({.faces = faces, .texture_size = texture_size});
    return {std::move(model.mesh), std::move(model.texture)};
  }
  if (options.what == "head") {
    procedural::Model model = procedural::make_head({.faces = faces, .texture_size = texture_size});
    return {std::move(model.mesh), std::move(model.texture)};
  }
  if (options.what == "monkey") return {procedural::make_monkey({.faces = faces, .progress = progress}), {}};
  if (options.what == "statue") return {procedural::make_statue({.faces = faces, .progress = progress}), {}};
  if (options.what == "knot") return {procedural::make_knot(procedural::knot_of_faces(faces)), {}};
  procedural::DuckOptions duck = duck_options(options);
  duck.progress = progress;
  return {procedural::make_duck(duck), {}};
}

nlohmann::ordered_json document_of(const MakeOptions& options, const Made& made) {
  nlohmann::ordered_json document = validation::document_head("make", {});
  document["model"] = options.what;
  document["vertices"] = made.mesh.vertex_count();
  document["faces"] = made.mesh.face_count();
  document["mesh_sha256"] = mesh_sha256(made.mesh);
  if (made.texture)
    document["texture"] = {{"width", made.texture->width()}, {"height", made.texture->height()}, {"sha256", made.texture->sha256()}};
  validation::RunInfo run = validation::current_run(options.common.start);
  run.paths = {options.output};
  document["run"] = validation::to_json(run);
  return document;
}

int run_make_range(const MakeOptions& options) {
  if (options.faces) throw UsageError("--faces: range has as many triangles as its samples give");
  if (options.texture_size) throw UsageError("--texture-size: range is coloured by vertex and has no texture");
  if (options.open) throw UsageError("--open is of duck");
  if (options.output == "-") throw UsageError("make: expected -o FILE.ply, .obj, .glb, .png, .tif or .exr");
  require_writable_file(options.output);
  require_writable_file(options.common.json);
  Console console(console_options(options.common));
  const MadeRange made = make_range({options.kind, options.image, options.output});
  CallFiles files;
  for (const std::filesystem::path& path : made.outputs) files.add_output(path.string(), "-o");
  files.add_output(options.common.json, "--json");
  {
    const FinishWriting finish;
    write_range(made);
  }
  console.line(fmt::format("{}: {}: {}x{} samples {} apart, {} of them there; {} vertices, {}{}", options.output, made.kind,
                           made.range.width, made.range.height, made.range.spacing, validation::grouped(sample_count(made.range)),
                           validation::grouped(made.mesh.vertex_count()), counted(made.mesh.face_count(), "face"),
                           made.image.empty() ? "" : ", coloured by the " + made.image));
  for (const std::filesystem::path& path : made.outputs) console.line("wrote " + path.string());
  nlohmann::ordered_json document = document_of(options, {made.mesh, {}});
  document["range"] = {{"kind", made.kind},
                       {"image", made.image.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(made.image)},
                       {"width", made.range.width},
                       {"height", made.range.height},
                       {"spacing", made.range.spacing},
                       {"depth_step", procedural::kRangeStep},
                       {"samples", sample_count(made.range)}};
  write_document(options.common, document);
  if (!options.common.json.empty() && options.common.json != "-") console.line("wrote " + options.common.json);
  return kExitDone;
}

int run_make(const MakeOptions& options) {
  apply(options.common);
  if (options.size && options.what != "terrain") throw UsageError("--size is of terrain");
  if (options.what == "range") return run_make_range(options);
  if (options.kind || options.image) throw UsageError(fmt::format("{}: of range only", options.kind ? "--kind" : "--image"));
  if (options.what == "terrain") {
    if (options.faces) throw UsageError("--faces: terrain has --size heights on a side");
    if (options.open) throw UsageError("--open is of duck");
    return run_make_terrain({options.output, options.size, options.texture_size}, options.common);
  }
  if (options.output == "-") throw UsageError("make: a model and its texture are several files: expected -o FILE.obj, .ply or .glb");
  require_writable_file(options.output);
  require_writable_file(options.common.json);
  Console console(console_options(options.common));
  const Made made = make_model(options, [&](int done, int total) { console.progress("making the " + options.what, done, total); });
  std::vector<io::Material> materials;
  if (made.texture) materials.push_back({.name = options.what, .texture_path = {}, .texture = *made.texture});
  const std::vector<std::filesystem::path> outputs = io::mesh_output_files(options.output, materials);
  CallFiles files;
  for (const std::filesystem::path& path : outputs) files.add_output(path.string(), "-o");
  files.add_output(options.common.json, "--json");
  {
    const FinishWriting finish;
    io::write_mesh(options.output, made.mesh, materials);
  }
  const std::string looks = made.texture ? fmt::format("texture {}x{}", made.texture->width(), made.texture->height()) : "vertex colours";
  console.line(fmt::format("{}: {} with {} vertices, {}, {}", options.output, options.what, validation::grouped(made.mesh.vertex_count()),
                           counted(made.mesh.face_count(), "face"), looks));
  for (const std::filesystem::path& path : outputs) console.line("wrote " + path.string());
  write_document(options.common, document_of(options, made));
  if (!options.common.json.empty() && options.common.json != "-") console.line("wrote " + options.common.json);
  return kExitDone;
}

}  // namespace

Verb add_make(CLI::App& root) {
  const auto options = std::make_shared<MakeOptions>();
  CLI::App* app = root.add_subcommand("make", "Write a procedural model");
  app->add_option(
         "what", options->what,
         "With a texture: swirl, the curved grid of a swirled texture; head, the embedded default. With vertex colours: monkey, a "
         "mandrill's head; duck, a wooden drake; statue, a robed figure in marble; knot, a displaced torus knot. A scan: range, one of "
         "five range images of 256x256 samples in millimetres. terrain: alpine heights and their orthophoto, two images")
      ->required()
      ->check(CLI::IsMember({"swirl", "head", "monkey", "duck", "statue", "knot", "range", "terrain"}))
      ->type_name("swirl|head|monkey|duck|statue|knot|range|terrain");
  app->add_option(
         "--faces", options->faces,
         "How many triangles: exactly so for monkey (default 101,002) and statue (default 200,000), even numbers; about so for swirl "
         "(7,688), head (7,685), duck (166,278; open 99,997) and knot (100,000)")
      ->type_name("N");
  app->add_flag("--open", options->open, "Of the duck: with a hole under its belly, as a scanner leaves it");
  app->add_option("--texture-size", options->texture_size,
                  "Of swirl, head and terrain: side of the texture in texels (default 1024; terrain 4 for each height)")
      ->type_name("N")
      ->check(CLI::Range(64, 8192));
  app->add_option("--size", options->size, "Of terrain: heights on a side, 2^k+1: 33, 65 … 4097 (default 257), of the same 5.1 km")
      ->type_name("N");
  app->add_option("--kind", options->kind, "Of range: which object (default telephone)")
      ->type_name("shuttle|hand|soldier|teapot|telephone")
      ->check(CLI::IsMember({"shuttle", "hand", "soldier", "teapot", "telephone"}));
  app->add_option("--image", options->image,
                  "Of range: the test image laid over it (a mesh: default chessboard; depths: none, else beside them as STEM_color.png)")
      ->type_name("chessboard|ramp")
      ->check(CLI::IsMember({"chessboard", "ramp"}));
  app->add_option(
         "-o,--output", options->output,
         "Model to write, a texture STEM_texture.png beside it: .obj, .ply; or in one file: .glb. Of range also depths: .exr and .tif "
         "in millimetres (float, no sample: NaN), .png in 1/256 mm (16 bits, no sample: 0). Of terrain the heights: .tif or .exr (float), "
         "an orthophoto STEM_color.png beside it")
      ->required()
      ->type_name("FILE")
      ->check(not_empty());
  add_common_options(*app, options->common,
                     "  etalon make head -o head.obj\n  etalon make statue --faces 2351302 -o statue.ply\n"
                     "  etalon make range --kind teapot --image ramp -o teapot.ply\n  etalon make range --kind hand -o hand.png\n  etalon "
                     "make terrain -o alps.tif");
  return {app, [options] { return run_make(*options); }};
}

}  // namespace etalon::cli
