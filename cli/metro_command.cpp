#include "cli/metro_command.h"

#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "cli/attribution.h"
#include "cli/call_files.h"
#include "cli/exit_code.h"
#include "cli/model_input.h"
#include "cli/work_bytes.h"
#include "core/io/inputs.h"
#include "core/io/mesh_file.h"
#include "validation/metrics/metro.h"
#include "validation/report/json_report.h"

namespace etalon::cli {
namespace {

using Json = nlohmann::ordered_json;
using validation::DirectedDistance;
using validation::grouped;
using validation::SurfaceDistance;

struct Options {
  std::string a, b;
  std::uint64_t samples = validation::MetroOptions{}.samples;
  CommonOptions common;
};

Mesh read_surface(const std::string& path, const std::string& role, CallFiles& files, std::vector<validation::VerifyInput>& inputs) {
  files.add_input(path, "surface " + role);
  io::LoadedModel model = io::read_mesh(path, kMinMetroBytesPerFace);
  add_side_files(files, model);
  validation::VerifyInput input{.name = std::filesystem::path(path).filename().string(),
                                .sha256 = io::file_sha256(path),
                                .path = path,
                                .role = role,
                                .attribution = ""};
  input.attribution = attribution_of(input.sha256);
  inputs.push_back(input);
  return std::move(model.mesh);
}

Json optional_json(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

void add_figures(Json& object, double mean, double rms, double max, double diagonal) {
  const auto share = [&](double x) { return diagonal > 0 ? Json(x / diagonal) : Json(nullptr); };
  object["mean"] = mean;
  object["mean_of_diagonal"] = share(mean);
  object["rms"] = rms;
  object["rms_of_diagonal"] = share(rms);
  object["max"] = max;
  object["max_of_diagonal"] = share(max);
}

Json direction_json(const DirectedDistance& direction, double diagonal) {
  Json object = {{"samples", direction.samples},
                 {"vertex_samples", direction.vertex_samples},
                 {"edge_samples", direction.edge_samples},
                 {"face_samples", direction.face_samples}};
  add_figures(object, direction.mean, direction.rms, direction.max, diagonal);
  object["max_at"] = {direction.max_at.x, direction.max_at.y, direction.max_at.z};
  object["colour_mean"] = optional_json(direction.colour_mean);
  object["colour_rms"] = optional_json(direction.colour_rms);
  object["colour_max"] = optional_json(direction.colour_max);
  return object;
}

std::string figures_line(const std::string& label, double mean, double rms, double max, const std::optional<double>& colour,
                         double diagonal) {
  const auto figure = [&](double x) {
    return diagonal > 0 ? fmt::format("{:.6g} ({:.4f} %)", x, 100 * x / diagonal) : fmt::format("{:.6g}", x);
  };
  return fmt::format("{}: mean {}, RMS {}, max {}{}", label, figure(mean), figure(rms), figure(max),
                     colour ? fmt::format(", colour RMS {:.5f}", *colour) : "");
}

std::string direction_line(const std::string& label, const DirectedDistance& d, double diagonal) {
  return figures_line(label, d.mean, d.rms, d.max, d.colour_rms, diagonal) + fmt::format("; {} samples", grouped(d.samples));
}

int run(const Options& options) {
  apply(options.common);
  require_writable_file(options.common.json);
  Console console(console_options(options.common));
  CallFiles files;
  std::vector<validation::VerifyInput> inputs;
  const Mesh a = read_surface(options.a, "a", files, inputs), b = read_surface(options.b, "b", files, inputs);
  files.add_output(options.common.json, "--json");

  const SurfaceDistance distance =
      validation::measure_surfaces(a, b, {.samples = options.samples, .progress = [&](std::size_t done, std::size_t total) {
                                            console.progress("blocks of samples", static_cast<int>(done), static_cast<int>(total));
                                          }});
  const double diagonal = distance.diagonal;
  console.line(fmt::format("A {}: {}; B {}: {}; diagonal of A {:.6g}", inputs[0].name, counted(a.face_count(), "face"), inputs[1].name,
                           counted(b.face_count(), "face"), diagonal));
  console.line(direction_line("A to B", distance.forward, diagonal));
  console.line(direction_line("B to A", distance.backward, diagonal));
  console.line(figures_line("larger", distance.mean(), distance.rms(), distance.max(), distance.colour_rms(), diagonal));

  Json document = validation::document_head("metro", inputs);
  document["target_samples"] = options.samples;
  document["diagonal"] = diagonal;
  document["forward"] = direction_json(distance.forward, diagonal);
  document["backward"] = direction_json(distance.backward, diagonal);
  add_figures(document, distance.mean(), distance.rms(), distance.max(), diagonal);
  document["colour_rms"] = optional_json(distance.colour_rms());
  validation::RunInfo run_info = validation::current_run(options.common.start);
  run_info.paths = {options.a, options.b};
  document["run"] = validation::to_json(run_info);
  write_document(options.common, document);
  return kExitDone;
}

}  // namespace

Verb add_metro(CLI::App& root) {
  const auto options = std::make_shared<Options>();
  CLI::App* app = root.add_subcommand("metro", "Measure how far two surfaces are apart, in space and in vertex colour");
  app->add_option("a", options->a, "Surface A, whose diagonal is 100 %: .obj .ply .stl .glb .gltf")
      ->required()
      ->type_name("A")
      ->check(not_empty());
  app->add_option("b", options->b, "Surface B")->required()->type_name("B")->check(not_empty());
  app->add_option("--samples", options->samples, "Samples in each direction, about (default 1,000,000); every vertex is always one")
      ->type_name("N")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000}));
  add_common_options(*app, options->common, "  etalon metro scan.ply small.ply");
  return {app, [options] { return run(*options); }};
}

}  // namespace etalon::cli
