#include "cli/joint_command.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "cli/attribution.h"
#include "cli/call_files.h"
#include "cli/exit_code.h"
#include "cli/interrupt.h"
#include "cli/joint_open.h"
#include "cli/model_input.h"
#include "cli/terrain_input.h"
#include "cli/terrain_view_option.h"
#include "cli/usage_error.h"
#include "core/io/atomic_file.h"
#include "core/io/image_file.h"
#include "core/io/mesh_file.h"
#include "core/joint/joint_stream.h"
#include "core/joint/marginal_analysis.h"
#include "raster/cpu_renderer.h"
#include "validation/joint/path_gaps.h"
#include "validation/joint/terrain_problem.h"
#include "validation/joint/terrain_views.h"
#include "validation/metrics/decibel.h"
#include "validation/report/json_report.h"

namespace etalon::cli {
namespace {

using Json = nlohmann::ordered_json;
using validation::grouped;

struct Options {
  std::string dem, image, view, output, search = "prune", rule = "slope", kernel = "9/7", pyramid = "significance", size;
  std::int64_t meshes = 60, textures = 32, budget_bytes = 0;
  TerrainOptions terrain;
  double height_unit = 0.25;
  CommonOptions common;
};

terrain::TerrainView chosen_view(const Options& options, const terrain::HeightField& field) {
  const FrameSize fallback{640, 480};
  if (options.view.empty()) {
    const FrameSize size = options.size.empty() ? fallback : parse_size(options.size);
    return validation::terrain_overview(field, size.width, size.height).view;
  }
  return chosen_terrain_view(options.view, options.size, fallback, field).view;
}

joint::SearchOptions search_options(const Options& options) {
  joint::SearchOptions how;
  how.direction = options.search == "grow" ? joint::Direction::grow : joint::Direction::prune;
  how.rule = options.rule == "printed"  ? joint::StepRule::printed
             : options.rule == "budget" ? joint::StepRule::budget
                                        : joint::StepRule::slope;
  return how;
}

/// What was searched, and found.
struct Outcome {
  joint::Path path;
  std::optional<joint::AllPairs> all;
  std::optional<validation::PathGaps> gaps;
  const joint::PathPoint* chosen = nullptr;  ///< the pair that is written as a model
};

Outcome search(const Options& options, validation::TerrainProblem& terrain, Console& console) {
  joint::Problem problem = terrain.problem();
  const int most = static_cast<int>(2 * (problem.mesh_bits.size() + problem.texture_bits.size()));
  int asked = 0;
  const auto error = problem.error;
  problem.error = [&](std::size_t i, std::size_t j) {
    console.progress("marginal analysis", std::min(asked++, most), most);
    return error(i, j);
  };
  Outcome outcome{joint::marginal_analysis(problem, search_options(options)), {}, {}, nullptr};
  problem.error = error;
  if (options.search == "exhaustive") {
    outcome.all = joint::evaluate_all(problem, [&](std::size_t done, std::size_t total) {
      console.progress("all pairs", static_cast<int>(done), static_cast<int>(total));
    });
    outcome.gaps = validation::path_gaps(outcome.path, *outcome.all, joint::Staircase(problem, *outcome.all));
    outcome.path = joint::with_errors(std::move(outcome.path), *outcome.all);
  }
  const std::uint64_t budget =
      options.budget_bytes == 0 ? outcome.path.points.back().bits : 8 * static_cast<std::uint64_t>(options.budget_bytes);
  outcome.chosen = joint::point_within(outcome.path, budget);
  if (outcome.chosen == nullptr)
    throw InputError(fmt::format("--budget: expected at least the {} bytes of the smallest pair, got {}",
                                 grouped(outcome.path.points.front().bits / 8), grouped(budget / 8)));
  return outcome;
}

Json psnr_json(const std::optional<std::uint64_t>& error, std::uint64_t samples) {
  if (!error) return nullptr;
  const std::optional<double> db = validation::psnr_db(static_cast<double>(*error), samples, 255);
  return db ? Json(*db) : Json(nullptr);
}

Json point_json(const joint::PathPoint& point, std::uint64_t samples) {
  return {{"mesh", point.pair.mesh},
          {"texture", point.pair.texture},
          {"bits", point.bits},
          {"sse", point.error ? Json(*point.error) : Json(nullptr)},
          {"psnr", psnr_json(point.error, samples)}};
}

std::string path_csv(const joint::Path& path, std::uint64_t samples) {
  std::string csv = "mesh,texture,bits,sse,psnr\r\n";
  for (const joint::PathPoint& p : path.points) {
    const Json db = psnr_json(p.error, samples);
    csv += fmt::format("{},{},{},{},{}\r\n", p.pair.mesh, p.pair.texture, p.bits, p.error ? std::to_string(*p.error) : "",
                       db.is_null() ? "" : fmt::format("{:.4f}", db.get<double>()));
  }
  return csv;
}

std::string pairs_csv(const joint::AllPairs& all, const joint::Problem& problem) {
  std::string csv = "mesh,texture,bits,sse\r\n";
  for (std::size_t i = 0; i < all.mesh_count; ++i)
    for (std::size_t j = 0; j < all.texture_count; ++j) csv += fmt::format("{},{},{},{}\r\n", i, j, problem.bits(i, j), all.error({i, j}));
  return csv;
}

Json document_of(const Options& options, const TerrainInput& input, const std::vector<validation::VerifyInput>& inputs,
                 validation::TerrainProblem& terrain, const Outcome& outcome, std::size_t file_bytes) {
  const joint::JointLevels& levels = terrain.levels();
  const std::uint64_t samples = terrain.errors().samples();
  Json document = validation::document_head("joint", inputs);
  document["search"] = options.search;
  document["rule"] = options.rule;
  document["kernel"] = options.kernel;
  document["pyramid"] = options.pyramid;
  document["grid"] = input.field.side();
  document["texture_size"] = input.image.width();
  document["width"] = terrain.frame().width;
  document["height"] = terrain.frame().height;
  Json meshes = Json::array(), textures = Json::array();
  for (std::size_t i = 0; i < levels.mesh_bits.size(); ++i)
    meshes.push_back({{"vertices", levels.levels.vertex_counts[i]}, {"bits", levels.mesh_bits[i]}});
  for (std::size_t j = 0; j < levels.texture_bits.size(); ++j)
    textures.push_back({{"significant", levels.significant[j]}, {"bits", levels.texture_bits[j]}});
  document["meshes"] = meshes;
  document["textures"] = textures;
  document["significant_total"] = levels.significant_total;
  document["evaluations"] = outcome.path.evaluations;
  Json path = Json::array();
  for (const joint::PathPoint& point : outcome.path.points) path.push_back(point_json(point, samples));
  document["path"] = path;
  document["chosen"] = point_json(*outcome.chosen, samples);
  document["bytes"] = file_bytes;
  if (outcome.gaps) {
    document["gap_db"] = {{"mean", outcome.gaps->mean_db}, {"max", outcome.gaps->max_db}};
    document["gap_budget_db"] = {{"mean", outcome.gaps->budget_mean_db}, {"max", outcome.gaps->budget_max_db}};
  }
  document["notes"] = input.notes;
  document["warnings"] = input.warnings;
  validation::RunInfo run = validation::current_run(options.common.start);
  run.paths = {options.dem, options.image, options.output};
  document["run"] = validation::to_json(run);
  return document;
}

void write_results(const std::filesystem::path& folder, validation::TerrainProblem& terrain, const Outcome& outcome,
                   const std::vector<std::byte>& stream) {
  const FinishWriting writing;
  std::filesystem::create_directories(folder);
  const joint::Pair pair = outcome.chosen->pair;
  io::write_mesh(folder / "model.obj", terrain.mesh(pair.mesh),
                 {{.name = "model", .texture_path = {}, .texture = terrain.textures()[pair.texture]}});
  io::write_image(folder / "picture.png", validation::without_alpha(terrain.errors().picture(pair.mesh, pair.texture)));
  io::write_image(folder / "full.png", validation::without_alpha(terrain.errors().reference()));
  io::write_file(folder / "path.csv", path_csv(outcome.path, terrain.errors().samples()));
  if (outcome.all) io::write_file(folder / "pairs.csv", pairs_csv(*outcome.all, terrain.problem()));
  io::write_file(folder / "joint.ejt", std::span<const std::byte>(stream));
}

void print_outcome(Console& console, const Options& options, validation::TerrainProblem& terrain, const Outcome& outcome,
                   const std::vector<std::byte>& stream) {
  const joint::JointLevels& levels = terrain.levels();
  console.line(fmt::format("{} meshes of {} to {} vertices, {} textures of {} to {} significant coefficients", levels.mesh_bits.size(),
                           grouped(levels.levels.vertex_counts.front()), grouped(levels.levels.vertex_counts.back()),
                           levels.texture_bits.size(), grouped(levels.significant.front()), grouped(levels.significant.back())));
  console.line(fmt::format("path of {} pairs from {} to {} bytes, {} evaluations", outcome.path.points.size(),
                           grouped(outcome.path.points.front().bits / 8), grouped(outcome.path.points.back().bits / 8),
                           outcome.path.evaluations));
  if (outcome.gaps)
    console.line(fmt::format("behind the best of all {} pairs: {:.3f} dB in the mean, at most {:.3f} dB",
                             grouped(outcome.all->errors.size()), outcome.gaps->mean_db, outcome.gaps->max_db));
  const Json db = psnr_json(outcome.chosen->error, terrain.errors().samples());
  console.line(fmt::format("model: mesh {} with texture {}, {} bytes{}", outcome.chosen->pair.mesh, outcome.chosen->pair.texture,
                           grouped(outcome.chosen->bits / 8), db.is_null() ? "" : fmt::format(", {:.2f} dB", db.get<double>())));
  if (options.budget_bytes > 0 && static_cast<std::uint64_t>(options.budget_bytes) > stream.size())
    console.line(fmt::format("note: the largest pair takes {} bytes of the budget's {}", grouped(stream.size()),
                             grouped(static_cast<std::uint64_t>(options.budget_bytes))));
}

/// Opening a stream takes no other choice: its view, its frame and its levels stand in the file.
void require_no_choices(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options())
    if (option->count() > 0 && !option->get_positional() && !option->check_lname("output") && !option->check_lname("threads") &&
        !option->check_lname("quiet"))
      throw UsageError(fmt::format("joint: {} belongs to DEM IMAGE", option->get_name()));
}

int run(const Options& options, const CLI::App& app) {
  apply(options.common);
  if (options.output == "-") throw UsageError("joint: the results are several files: expected -o DIR");
  require_writable_folder(options.output);
  require_writable_file(options.common.json);
  Console console(console_options(options.common));
  if (options.image.empty()) {
    if (!is_joint_stream(options.dem))
      throw UsageError(fmt::format("joint: {}: expected an IMAGE after the DEM, or a file .ejt", options.dem));
    require_no_choices(app);
    open_joint_stream(options.dem, options.output, console);
    return kExitDone;
  }
  if (options.pyramid == "distance" && options.textures > static_cast<std::int64_t>(joint::kMostDistances))
    throw UsageError(fmt::format("--pyramid distance: expected at most {} --textures, got {}", joint::kMostDistances, options.textures));
  CallFiles files;
  files.add_input(options.dem, "DEM");
  files.add_input(options.image, "IMAGE");
  const std::filesystem::path folder(options.output);
  for (const char* name : {"model.obj", "model.mtl", "model_texture.png", "picture.png", "full.png", "path.csv", "pairs.csv", "joint.ejt"})
    files.add_output((folder / name).string(), "-o");
  files.add_output(options.common.json, "--json");
  const TerrainInput input = load_terrain(options.dem, options.image, options.terrain);
  const std::vector<validation::VerifyInput> inputs = {file_input(options.dem, "DEM"), file_input(options.image, "image")};
  for (const std::string& note : input.notes) console.line("note: " + note);
  for (const std::string& warning : input.warnings) print_warning(options.dem + ": " + warning);

  raster::CpuRenderer exact;
  joint::LevelOptions levels{.meshes = static_cast<std::size_t>(options.meshes),
                             .textures = static_cast<std::size_t>(options.textures),
                             .height_unit_m = options.height_unit};
  if (options.pyramid == "distance") levels.pyramid = joint::TexturePyramid::distance;
  if (options.kernel == "5/3") levels.kernel = wavelet::Kernel::reversible_5_3;
  console.progress("levels", 0, 1);
  validation::TerrainProblem terrain(exact, input.field, input.image, chosen_view(options, input.field), levels);
  const Outcome outcome = search(options, terrain, console);
  const std::vector<std::byte> stream = joint::encode_joint(terrain.levels(), outcome.path);
  write_results(folder, terrain, outcome, stream);
  print_outcome(console, options, terrain, outcome, stream);
  console.line("wrote " + options.output);
  write_document(options.common, document_of(options, input, inputs, terrain, outcome, stream.size()));
  return input.warnings.empty() ? kExitDone : kExitWarning;
}

}  // namespace

Verb add_joint(CLI::App& root) {
  const auto options = std::make_shared<Options>();
  CLI::App* app = root.add_subcommand("joint", "Spend one bit budget on a terrain's mesh and its texture, by what a view shows of them");
  app->add_option("dem", options->dem,
                  "Heights: an image of one channel, float or 16 bit; or a file .ejt, or the beginning of one, to be opened")
      ->required()
      ->type_name("DEM")
      ->check(not_empty());
  app->add_option("image", options->image, "Its texture, of the same extent, 8 bits a channel")->type_name("IMAGE")->check(not_empty());
  app->add_option("--view", options->view, "View file (etalon/view/1), or fit, front, N/24 (default: all of it, from the south)")
      ->type_name("FILE|NAME")
      ->check(not_empty());
  app->add_option("--size", options->size, "Frame in pixels (default: the view file's, else 640x480)")
      ->type_name("WxH")
      ->check(not_empty());
  app->add_option("--meshes", options->meshes, "Levels of the mesh, 0.1 % to 10 % of the points (default 60)")
      ->type_name("N")
      ->check(CLI::Range(2, 4096));
  app->add_option("--textures", options->textures, "Levels of the texture, 0.1 % to 10 % of the coefficients (default 32)")
      ->type_name("N")
      ->check(CLI::Range(2, 4096));
  app->add_option("--search", options->search,
                  "Marginal analysis down from the finest pair (default) or up from the coarsest; exhaustive: down, beside all pairs")
      ->type_name("prune|grow|exhaustive")
      ->check(CLI::IsMember({"prune", "grow", "exhaustive"}));
  app->add_option("--rule", options->rule, "Which step pays best: by error per bit (default), as printed in the paper, by bit budgets")
      ->type_name("slope|printed|budget")
      ->check(CLI::IsMember({"slope", "printed", "budget"}));
  app->add_option("--budget", options->budget_bytes, "Bytes that the written model may take (default: all)")
      ->type_name("N")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{1} << 40));
  add_terrain_options(*app, options->terrain);
  app->add_option("--spacing", options->terrain.spacing_m, "Metres between samples of the DEM (default 10)")
      ->type_name("M")
      ->check(number_between(1e-6, 1e6));
  app->add_option("--height-unit", options->height_unit, "Metres of which coded heights are multiples (default 0.25)")
      ->type_name("M")
      ->check(number_between(1e-6, 1e3));
  app->add_option("--kernel", options->kernel, "Wavelet (default 9/7)")->type_name("9/7|5/3")->check(CLI::IsMember({"9/7", "5/3"}));
  app->add_option("--pyramid", options->pyramid,
                  "Levels of the texture: ever more significant coefficients (default), or what can be told apart from d_0·2^(i/k), d_0 "
                  "being the view's "
                  "own distance, each complete (at most 43 --textures)")
      ->type_name("significance|distance")
      ->check(CLI::IsMember({"significance", "distance"}));
  app->add_option("-o,--output", options->output,
                  "Folder: joint.ejt (every prefix a mesh and a texture), path.csv, the model of the budget, its picture and the full one")
      ->required()
      ->type_name("DIR")
      ->check(not_empty());
  add_common_options(*app, options->common,
                     "  etalon joint dem.tif photo.png -o both\n"
                     "  etalon joint dem.tif photo.png --view pass.json --search exhaustive --json - -o both\n"
                     "  etalon joint dem.tif photo.png --budget 20000 -o small\n"
                     "  etalon joint small/joint.ejt -o opened");
  return {app, [options, app] { return run(*options, *app); }};
}

}  // namespace etalon::cli
