#include "cli/study_command.h"

#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "cli/call_files.h"
#include "cli/exit_code.h"
#include "cli/gl_options.h"
#include "cli/interrupt.h"
#include "cli/study_subjects.h"
#include "cli/usage_error.h"
#include "raster/cpu_renderer.h"
#include "validation/report/html_report.h"
#include "validation/report/json_report.h"
#include "validation/report/study_page.h"
#include "validation/studies/kim_report.h"

namespace etalon::cli {
namespace {

using namespace etalon::validation;

struct Options {
  std::string study;
  SubjectOptions subjects;
  std::string report;  ///< empty: etalon-study-NAME
  GlOptions gl;
  CommonOptions common;
};

void print_subject(const KimSubjectResult& subject, Console& console) {
  for (const KimOutcome& o : subject.outcomes)
    console.line(fmt::format("{:<22} {:<15} {:>9} vertices {:>8.2f} s  mean {:.4f} %  RMS {:.4f} %  image RMS {:.2f} ({:.2f})",
                             subject.name, to_string(o.method), grouped(o.vertices), o.seconds, o.mean, o.rms, o.image_rms,
                             o.image_rms_views));
}

KimStudyOptions study_options(const Options& options, const OpenedDevice& device, Console& console) {
  KimStudyOptions result;
  if (options.subjects.quick) {
    result.picture_px = 192;
    result.views_px = 96;
    result.view_count = 4;
    result.metro_samples = 30'000;
    result.sweep_samples = 10'000;
    result.sweep_faces = 25'000;
    result.time_repeats = 1;
  }
  result.device = device.renderer.get();
  result.device_model = device.model;
  result.progress = [&console](const std::string& label, int done, int total) { console.progress(label, done, total); };
  result.on_subject = [&console](const KimSubjectResult& subject) { print_subject(subject, console); };
  return result;
}

/// What to type to repeat it, paths by their last part.
std::string command_of(const Options& options) {
  std::string command = "etalon study " + options.study;
  for (const std::string& model : options.subjects.models) command += " " + std::filesystem::path(model).filename().string();
  return command + (options.subjects.quick ? " --quick" : "");
}

int run(const Options& options) {
  apply(options.common);
  const std::string folder = options.report.empty() ? "etalon-study-" + options.study : options.report;
  require_writable_folder(folder);
  Console console(console_options(options.common));
  CallFiles files;
  for (const char* name : {"index.html", "study.json", "study.md"})
    files.add_output((std::filesystem::path(folder) / name).string(), "--report");
  files.add_output(options.common.json, "--json");
  require_writable_file(options.common.json);
  const std::vector<KimSubject> subjects = load_subjects(options.subjects, console, files);
  const OpenedDevice device = open_device(options.gl, options.common.threads);
  console.line(fmt::format("device   {}", device.renderer ? device.renderer->name() : "GL: not available (" + device.unavailable + ")"));

  raster::CpuRenderer exact;
  const KimStudyResult result = run_kim_study(subjects, exact, study_options(options, device, console));
  StudyReport report = kim_report(result);
  if (options.subjects.quick) {
    const std::string warning = "A quick run: small models, few samples. No figure of it counts.";
    report.lede = warning + " " + report.lede;
    console.line("note: " + warning);
  }
  for (const StudyClaim& claim : report.claims)
    console.line(fmt::format("{:<6} {} {}", to_string(claim.verdict), claim.claim, claim.measured));

  RunInfo run_info = current_run(options.common.start);
  for (const KimSubject& subject : subjects)
    for (const VerifyInput& input : subject.inputs)
      if (!input.path.empty()) run_info.paths.push_back(input.path);
  run_info.device = result.device_name;
  std::filesystem::path page;
  {
    const FinishWriting finish;
    page = write_study(folder, report, run_info, command_of(options));
  }
  console.line("report: " + file_url(page));
  write_document(options.common, study_document(report, run_info));
  if (result.unexplained() > 0) {
    print_error(fmt::format("{} unexplained between both renderers", counted(result.unexplained(), "texel")));
    return kExitCheckFailed;
  }
  return kExitDone;
}

}  // namespace

Verb add_study(CLI::App& root) {
  const auto options = std::make_shared<Options>();
  CLI::App* app =
      root.add_subcommand("study", "Repeat a paper's measurements: its tables and figures beside ours, each claim with a verdict");
  app->add_option("study", options->study, "kim: Kim, Choi & Lee, mesh simplification with vertex colour")
      ->required()
      ->type_name("kim")
      ->check(CLI::IsMember({"kim"}));
  app->add_option(
         "models", options->subjects.models,
         "Meshes with vertex colours, or monkey, duck, statue (default: these three at the paper's sizes, and the real ones found)")
      ->type_name("MODEL");
  app->add_option("--reduction", options->subjects.reduction, "Share of the vertices of a mesh file that goes (default 0.9)")
      ->type_name("R")
      ->check(number_between(0.01, 0.999));
  app->add_option("--data", options->subjects.data, "Folder of the real inputs (default $ETALON_DATA, else etalon in your cache)")
      ->type_name("DIR")
      ->check(not_empty());
  app->add_flag("--quick", options->subjects.quick,
                "Small models and few samples: seconds, to see whether it works; no figure of it counts");
  app->add_option("--report", options->report, "Folder of the report (default etalon-study-NAME)")->type_name("DIR")->check(not_empty());
  add_gl_options(*app, options->gl);
  add_common_options(*app, options->common, "  etalon study kim --quick\n  etalon study kim scan.ply --reduction 0.95 --report scan-study");
  return {app, [options] { return run(*options); }};
}

}  // namespace etalon::cli
