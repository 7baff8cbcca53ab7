#include "cli/verify_command.h"

#include <algorithm>
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "cli/call_files.h"
#include "cli/exit_code.h"
#include "cli/gl_options.h"
#include "cli/interrupt.h"
#include "cli/model_input.h"
#include "cli/size_option.h"
#include "cli/usage_error.h"
#include "cli/view_option.h"
#include "core/procedural/head.h"
#include "core/procedural/swirl.h"
#include "raster/cpu_renderer.h"
#include "validation/report/html_report.h"
#include "validation/report/json_report.h"
#include "validation/verify/verify.h"

namespace etalon::cli {
namespace {

using namespace etalon::validation;

struct Options {
  std::vector<std::string> models;
  std::vector<std::string> jobs = verify_jobs();
  std::string size;  ///< empty: the view files'
  std::vector<std::string> views;
  std::int64_t faces = 0;
  int map_size = 256;
  std::string report = "etalon-report";
  ModelOptions model;
  GlOptions gl;
  CommonOptions common;
};

std::vector<VerifyModel> load_models(const Options& options, Console& console, CallFiles& files) {
  std::vector<VerifyModel> models;
  if (options.models.empty()) {
    console.progress("making the embedded head", 0, 1);
    models.push_back(embedded_model(procedural::make_head()));
    models.push_back(embedded_model(procedural::make_swirl()));
  }
  for (const std::string& path : options.models) models.push_back(load_model(path, options.model, files));
  for (const VerifyModel& model : models) {
    console.line(fmt::format("model    {}: {}{}", model.inputs.front().name, counted(model.mesh.face_count(), "face"),
                             model.mesh.has_uv ? "" : ", no texture coordinates"));
    for (const std::string& note : model.notes) console.line("         note: " + note);
  }
  return models;
}

VerifyOptions verify_options(const Options& options, Console& console, CallFiles& files) {
  VerifyOptions result;
  std::vector<ViewChoice> views;
  for (const std::string& view : options.views) {
    views.push_back(parse_view(view));
    if (views.back().named.camera) files.add_input(view, "--view");
  }
  const FrameSize size = frame_size(options.size, views);
  result.width = size.width;
  result.height = size.height;
  result.adapt_faces = static_cast<std::size_t>(options.faces);
  result.bake_faces = result.adapt_faces;
  result.adapt_size = options.map_size;
  result.jobs.clear();
  for (const std::string& job : verify_jobs()) {  // each once, in the order they are done
    if (std::find(options.jobs.begin(), options.jobs.end(), job) != options.jobs.end()) result.jobs.push_back(job);
  }
  if (!options.views.empty()) result.views.clear();
  for (const ViewChoice& view : views) result.views.push_back(view.named);
  result.state.subtexel_bits = options.model.snap_bits;
  result.on_progress = [&console](const std::string& label, int done, int total) { console.progress(label, done, total); };
  result.on_case = [&console](const CaseResult& item) {
    const std::string compared = item.tally.texels == 0 ? "not compared"
                                 : item.tally.unexplained == 0
                                     ? fmt::format("gl {:.2f} s, {} texels differ, none unexplained", item.gl_seconds,
                                                   grouped(item.tally.texels - item.tally.identical))
                                     : fmt::format("gl {:.2f} s, {} texels UNEXPLAINED", item.gl_seconds, grouped(item.tally.unexplained));
    console.line(
        fmt::format("{:<8} {}: {}x{}, cpu {:.2f} s, {}", item.job, item.name(), item.width, item.height, item.cpu_seconds, compared));
  };
  return result;
}

void print_outcome(const VerifyResult& result, Console& console) {
  console.line("");
  for (const std::string& line : verify_table(result)) console.line(line);
  console.line("");
  for (const JobResult& job : result.jobs) {
    for (const CaseResult& item : job.cases) {
      if (!item.diagnosis.empty()) console.line(fmt::format("{} {}: {}", job.job, item.name(), item.diagnosis));
    }
  }
  if (!result.gl_unavailable.empty()) console.line(fmt::format("GL: not available ({}): compared nothing", result.gl_unavailable));
  if (result.bounds_measured) console.line("The device's bounds are not derived for it: agreement here is not proof.");
}

int exit_code(const VerifyResult& result) {
  switch (verdict(result)) {
    case Verdict::agreed: return kExitDone;
    case Verdict::not_compared: return kExitWarning;
    case Verdict::failed: return kExitCheckFailed;
  }
  return kExitCheckFailed;
}

// The report's folder may not exist yet; it does once the document is written.
bool is_in_folder(const std::string& file, const std::string& folder) {
  std::error_code error;
  const auto resolved = [&](const std::filesystem::path& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path, error), error);
  };
  return !file.empty() && file != "-" && !std::filesystem::exists(file, error) &&
         resolved(file).parent_path() == resolved(std::filesystem::path(folder) / "x").parent_path();
}

void print_quiet_outcome(const VerifyResult& result, const std::string& page) {
  const std::string text = quiet_outcome(result, page);
  if (text.empty()) return;
  if (verdict(result) == Verdict::failed)
    print_error(text);
  else
    print_warning(text);
}

int run(const Options& options) {
  apply(options.common);
  Console console(console_options(options.common));
  if (options.models.empty() && !options.model.texture.empty()) throw UsageError("--texture needs a MODEL");
  if (options.models.empty() && options.model.flip_v) throw UsageError("--flip-v needs a MODEL");
  CallFiles files;
  const VerifyOptions verify = verify_options(options, console, files);
  for (const std::string& path : options.models) files.add_input(path, "the model");
  for (const char* name : {"index.html", "verify.json", "classes.csv"})
    files.add_output((std::filesystem::path(options.report) / name).string(), "--report");
  files.add_output(options.common.json, "--json");
  require_writable_folder(options.report);
  if (!is_in_folder(options.common.json, options.report)) require_writable_file(options.common.json);
  const std::vector<VerifyModel> models = load_models(options, console, files);

  raster::CpuRenderer exact;
  OpenedDevice opened = open_device(options.gl, options.common.threads);
  console.line(fmt::format("device   {}", opened.renderer ? opened.renderer->name() : "GL: not available (" + opened.unavailable + ")"));
  const VerifyDevice device{opened.renderer.get(), opened.model, opened.unavailable};
  const auto compare = [&] { return run_verify(models, exact, device, verify); };
  const VerifyResult result = options.models.size() == 1 ? naming_the_model(options.models.front(), compare) : compare();
  print_outcome(result, console);

  RunInfo run_info = current_run(options.common.start);
  run_info.paths = options.models;
  run_info.device = result.gl_name;
  std::filesystem::path page;
  {
    console.progress("writing the report", 1, 1);
    const FinishWriting finish;
    page = write_verify_report(options.report, result, run_info);
  }
  console.line("report: " + file_url(page));
  write_document(options.common, verify_document(result, run_info));
  if (options.common.quiet) print_quiet_outcome(result, page.string());
  return exit_code(result);
}

}  // namespace

std::string quiet_outcome(const VerifyResult& result, const std::string& page) {
  switch (verdict(result)) {
    case Verdict::agreed: return "";
    case Verdict::failed: return fmt::format("{} unexplained, see {}", counted(result.total().unexplained, "texel"), page);
    case Verdict::not_compared: break;
  }
  const std::string reason = result.gl_unavailable.empty() ? "" : fmt::format(": GL: not available ({})", result.gl_unavailable);
  return fmt::format("compared nothing{}, see {}", reason, page);
}

Verb add_verify(CLI::App& root) {
  const auto options = std::make_shared<Options>();
  CLI::App* app = root.add_subcommand("verify", "Draw models on the exact rasterizer and on OpenGL, and explain every texel that differs");
  app->add_option("models", options->models, "Mesh files: .obj, .ply, .stl, .glb, .gltf (default: the embedded head and swirl)")
      ->type_name("MODEL");
  app->add_option("--jobs", options->jobs, fmt::format("Jobs to do, with commas: {} (default: all)", fmt::join(verify_jobs(), ", ")))
      ->type_name("LIST")
      ->delimiter(',')
      ->allow_extra_args(false)  // a model may follow
      ->check(CLI::IsMember(verify_jobs()));
  app->add_option("--faces", options->faces,
                  "Jobs adapt and bake: their coarsest level has at most so many triangles (default: a tenth; bake: 300 at most)")
      ->type_name("N")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{1} << 32));
  app->add_option("--map-size", options->map_size, "Job adapt: side of its map in texels (default 256)")
      ->type_name("N")
      ->check(CLI::Range(1, 8192));
  app->add_option("--size", options->size, "Frame, WxH or one number (default: the view file's, else 1024)")
      ->type_name("WxH")
      ->check(not_empty());
  app->add_option("--view", options->views, "front, fit, N/24 or a view file; may be repeated (default: fit and front)")
      ->type_name("NAME|FILE")
      ->take_all();
  app->add_option("--report", options->report, "Folder of the report (default etalon-report)")->type_name("DIR")->check(not_empty());
  add_model_options(*app, options->model);
  add_gl_options(*app, options->gl);
  add_common_options(*app, options->common,
                     "  etalon verify\n  etalon verify spot.obj --size 2048 --report spot-report\n  etalon verify scan.ply --jobs bake");
  return {app, [options] { return run(*options); }};
}

}  // namespace etalon::cli
