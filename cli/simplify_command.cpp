#include "cli/simplify_command.h"

#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "cli/attribution.h"
#include "cli/call_files.h"
#include "cli/exit_code.h"
#include "cli/interrupt.h"
#include "cli/length_option.h"
#include "cli/model_input.h"
#include "cli/reduction_options.h"
#include "cli/repair_notes.h"
#include "cli/usage_error.h"
#include "cli/work_bytes.h"
#include "core/io/inputs.h"
#include "core/io/mesh_file.h"
#include "core/mesh/weld.h"
#include "core/simplify/simplify.h"
#include "validation/report/json_report.h"

namespace etalon::cli {
namespace {

using Json = nlohmann::ordered_json;
using simplify::SimplifyResult;
using validation::grouped;

struct Options {
  std::string model, output, metric = "qem", collapse = "half", unit;
  ReductionOptions reduction;
  std::optional<double> ratio, weight;
  double min_cosine = simplify::LegalityOptions{}.min_normal_cosine;
  bool refuse_non_manifold = false;
  CommonOptions common;
};

struct Job {
  validation::VerifyInput input;
  io::LoadedModel model;  // welded
  std::size_t vertices_read = 0;
  std::size_t target_faces = 0;
  std::optional<double> tolerance;  // model units
  double unit = 0;                  // model units; 0: the default
};

double unit_of(const std::string& text, double diagonal) {
  const double unit = parse_length(text, diagonal, "simplify: --unit");
  if (!(unit >= 1e-12 && unit <= 1e12))
    throw UsageError(fmt::format("simplify: --unit: expected a length from 1e-12 to 1e12 model units, got {}", text));
  return unit;
}

// What SimplifyResult::error is, by metric (simplify.h).
std::string error_text(const std::string& metric, const SimplifyResult& result, double diagonal) {
  const std::string of_diagonal = diagonal > 0 ? fmt::format(" ({:.4g} % of the diagonal)", 100 * result.error / diagonal) : "";
  if (metric == "aps") return fmt::format("texture moved by at most {:.6g}{}", result.error, of_diagonal);
  if (metric == "qem5") return fmt::format("RMS error in space and texture together {:.6g}{}", result.error, of_diagonal);
  if (metric == "qem6" || metric == "hoppe")
    return fmt::format("RMS error in space and colour together {:.6g}{}", result.error, of_diagonal);
  return fmt::format("RMS distance to planes {:.6g}{}", result.error, of_diagonal);
}

Job read_job(const Options& options, CallFiles& files) {
  Job job;
  files.add_input(options.model, "the model");
  job.model = io::read_mesh(options.model, kMinSimplifyBytesPerFace);
  add_side_files(files, job.model);
  job.input = {.name = std::filesystem::path(options.model).filename().string(),
               .sha256 = io::file_sha256(options.model),
               .path = options.model,
               .role = "model",
               .attribution = ""};
  job.input.attribution = attribution_of(job.input.sha256);
  if (job.input.attribution.empty()) job.input.attribution = job.model.credit;
  job.vertices_read = job.model.mesh.vertex_count();
  job.model.mesh = welded_by_position(job.model.mesh);
  const std::size_t faces = job.model.mesh.face_count();
  if (options.reduction.faces) job.target_faces = static_cast<std::size_t>(*options.reduction.faces);
  if (options.ratio) job.target_faces = simplify::faces_for_ratio(faces, *options.ratio);
  job.tolerance = tolerance_of(options.reduction, bounding_box(job.model.mesh).diagonal(), "simplify", false);
  if (!options.unit.empty()) job.unit = unit_of(options.unit, bounding_box(job.model.mesh).diagonal());
  return job;
}

Json document_of(const Options& options, const Job& job, const SimplifyResult& result) {
  const double diagonal = bounding_box(job.model.mesh).diagonal();
  Json document = validation::document_head("simplify", {job.input});
  document["metric"] = options.metric;
  document["collapse"] = options.collapse;
  document["target_faces"] = job.target_faces;
  document["tolerance"] = job.tolerance ? Json(*job.tolerance) : Json(nullptr);
  document["vertices_in"] = job.model.mesh.vertex_count();
  document["vertices_out"] = result.mesh.vertex_count();
  document["faces_in"] = job.model.mesh.face_count();
  document["faces_out"] = result.mesh.face_count();
  document["stop"] = to_string(result.stop);
  document["collapses"] = result.collapse_count;
  document["error"] = result.error;
  document["error_of_diagonal"] = diagonal > 0 ? Json(result.error / diagonal) : Json(nullptr);
  document["distance_max"] = *result.distance_max;
  document["distance_max_of_diagonal"] = diagonal > 0 ? Json(*result.distance_max / diagonal) : Json(nullptr);
  document["distance_audited"] = result.distance_audited ? Json(*result.distance_audited) : Json(nullptr);
  document["max_cost"] = result.max_cost;
  document["error_state_bytes_per_vertex"] = result.state_bytes_per_vertex;
  document["error_state_bytes"] = result.state_bytes;
  document["kinds"] = {{"interior", result.interior_vertices}, {"curve", result.curve_vertices}, {"locked", result.locked_vertices}};
  Json refusals = Json::object();
  for (std::size_t i = 1; i < simplify::kRefusalCount; ++i) refusals[to_string(static_cast<simplify::Refusal>(i))] = result.refusals[i];
  document["refusals"] = std::move(refusals);
  document["repair"] = repair_json(result.repair);
  document["repair"]["welded_vertices"] = job.vertices_read - job.model.mesh.vertex_count();
  document["mesh_sha256"] = mesh_sha256(result.mesh);
  validation::RunInfo run = validation::current_run(options.common.start);
  run.paths = {options.model, options.output};
  document["run"] = validation::to_json(run);
  return document;
}

void print_notes(Console& console, const Job& job, const SimplifyResult& result) {
  for (const std::string& note : job.model.notes) console.line("note: " + note);
  if (job.vertices_read > job.model.mesh.vertex_count())
    console.line(fmt::format("note: vertices welded into others of the same place and colour: {}",
                             grouped(job.vertices_read - job.model.mesh.vertex_count())));
  print_repair(console, result.repair);
}

std::string refusals_line(const SimplifyResult& result) {
  std::string line = "refused:";
  bool any = false;
  for (std::size_t i = 1; i < simplify::kRefusalCount; ++i) {
    if (result.refusals[i] == 0) continue;
    line += fmt::format("{} {} {}", any ? "," : "", to_string(static_cast<simplify::Refusal>(i)), grouped(result.refusals[i]));
    any = true;
  }
  return any ? line : "refused: none";
}

int run(const Options& options) {
  apply(options.common);
  if (options.output == "-") throw UsageError("simplify: a model may be several files: expected -o FILE.obj, .ply or .glb");
  if (!options.unit.empty() && options.metric != "kim") throw UsageError("simplify: --unit is of --metric kim");
  const bool has_attributes = options.metric == "qem5" || options.metric == "qem6" || options.metric == "hoppe";
  if (options.weight && !has_attributes) throw UsageError("simplify: --weight is of --metric qem5, qem6 and hoppe");
  if ((options.metric == "kim" || options.metric == "aps") && options.collapse == "full")
    throw UsageError(fmt::format("simplify: --metric {} is of half-edge collapses: --collapse half", options.metric));
  const ReductionOptions& reduction = options.reduction;
  if (reduction.faces && options.ratio) throw UsageError("simplify: expected one of --faces and --ratio, got both");
  if (!reduction.faces && !options.ratio && reduction.tolerance.empty())
    throw UsageError("simplify: expected one of --faces, --ratio and --tolerance");
  (void)tolerance_of(reduction, 1, "simplify", false);
  if (!options.unit.empty()) (void)unit_of(options.unit, 1);
  require_writable_file(options.output);
  require_writable_file(options.common.json);
  Console console(console_options(options.common));
  CallFiles files;
  Job job = read_job(options, files);
  const std::vector<std::filesystem::path> outputs = io::mesh_output_files(options.output, job.model.materials);
  for (const std::filesystem::path& path : outputs) files.add_output(path.string(), "-o");
  files.add_output(options.common.json, "--json");

  const SimplifyResult result = naming_the_model(options.model, [&] {
    simplify::SimplifyOptions how;
    how.collapse = options.collapse == "full" ? simplify::CollapseKind::full : simplify::CollapseKind::half;
    how.target_faces = job.target_faces;
    how.tolerance = job.tolerance;
    how.metric = simplify::metric_named(options.metric);
    how.attribute_weight = options.weight.value_or(how.attribute_weight);
    how.kim.unit = job.unit;
    how.record_landings = true;
    how.refuse_non_manifold = options.refuse_non_manifold;
    how.legality.min_normal_cosine = options.min_cosine;
    how.progress = [&](std::size_t done, std::size_t total) {
      console.progress("faces removed", static_cast<int>(done), static_cast<int>(total));
    };
    return simplify::simplify_mesh(job.model.mesh, how);
  });
  {
    const FinishWriting finish;
    io::write_mesh(options.output, result.mesh, job.model.materials, job.input.attribution);
  }
  print_notes(console, job, result);
  const double diagonal = bounding_box(job.model.mesh).diagonal();
  console.line(fmt::format("{}: {} of {} faces, {} of {} vertices; {}", options.output, grouped(result.mesh.face_count()),
                           grouped(job.model.mesh.face_count()), grouped(result.mesh.vertex_count()),
                           grouped(job.model.mesh.vertex_count()), error_text(options.metric, result, diagonal)));
  if (result.distance_audited)
    console.line(fmt::format("no vertex of the model is farther than {:.6g} from the result (audited; asked for {:.6g})",
                             *result.distance_audited, *job.tolerance));
  else
    console.line(fmt::format("no vertex of the model is farther than {:.6g} from the result", *result.distance_max));
  console.line(refusals_line(result));
  const bool by_faces = reduction.faces || options.ratio;
  if (by_faces) print_unreached(console, result, job.target_faces);
  if (!job.input.attribution.empty()) console.line("by " + job.input.attribution);
  for (const std::filesystem::path& path : outputs) console.line("wrote " + path.string());
  write_document(options.common, document_of(options, job, result));
  if (!options.common.json.empty() && options.common.json != "-") console.line("wrote " + options.common.json);
  return result.stop == simplify::StopReason::faces || !by_faces ? kExitDone : kExitWarning;
}

}  // namespace

Verb add_simplify(CLI::App& root) {
  const auto options = std::make_shared<Options>();
  CLI::App* app = root.add_subcommand("simplify", "Write a model with fewer triangles: edge collapses in strict order of error");
  app->add_option("model", options->model, "Mesh: .obj .ply .stl .glb .gltf")->required()->type_name("MODEL")->check(not_empty());
  add_reduction_options(*app, options->reduction, 0, "model", "--faces or --ratio");
  app->add_option("--ratio", options->ratio, "Stop at this share of the model's triangles, 0 to 1")
      ->type_name("R")
      ->check(number_between(0, 1));
  app->add_option(
         "--collapse", options->collapse,
         "half: a vertex goes into a neighbour, vertices keep their places (default); full: both ends of an edge go where the error "
         "is least (not for kim and aps)")
      ->type_name("half|full")
      ->check(CLI::IsMember({"half", "full"}));
  app->add_option(
         "--metric", options->metric,
         "Error metric: qem, the quadric of Garland & Heckbert (default); qem5 and qem6, with texture coordinates or vertex colours; "
         "hoppe, vertex colours by gradients; kim, that of Kim, Choi & Lee for vertex colours; aps, how far the texture moves")
      ->type_name("qem|qem5|qem6|hoppe|kim|aps")
      ->check(CLI::IsMember({"qem", "qem5", "qem6", "hoppe", "kim", "aps"}));
  app->add_option("--weight", options->weight,
                  "For qem5, qem6 and hoppe: how long a difference of 1 in colour or texture is, the model's longest side being 1: 1e-6 to "
                  "1000 (default 1)")
      ->type_name("W")
      ->check(number_between(1e-6, 1000));
  app->add_option(
         "--unit", options->unit,
         "For kim: the length that counts as 1: model units, 1e-12 to 1e12, or 0.1% of the diagonal (default: the diagonal / 8000)")
      ->type_name("L")
      ->check(not_empty());
  app->add_option("--min-cosine", options->min_cosine,
                  "Least cosine between a triangle's normals before and after a collapse, 0 to 1 (default 0.2)")
      ->type_name("C")
      ->check(number_between(0, 1));
  app->add_flag("--refuse-non-manifold", options->refuse_non_manifold,
                "Fail where the model is no oriented manifold, instead of keeping those places as they are");
  app->add_option("-o,--output", options->output, "Model to write: .obj .ply .glb")->required()->type_name("OUT")->check(not_empty());
  add_common_options(*app, options->common,
                     "  etalon simplify scan.ply --ratio 0.1 -o small.ply\n"
                     "  etalon simplify scan.ply --tolerance 0.1% --collapse full --metric qem6 -o near.ply");
  return {app, [options] { return run(*options); }};
}

}  // namespace etalon::cli
