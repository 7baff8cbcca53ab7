#include "cli/study_command.h"

#include <algorithm>
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "cli/call_files.h"
#include "cli/chen_subjects.h"
#include "cli/exit_code.h"
#include "cli/gl_options.h"
#include "cli/horbelt_subjects.h"
#include "cli/interrupt.h"
#include "cli/soucy_subjects.h"
#include "cli/study_subjects.h"
#include "cli/usage_error.h"
#include "raster/cpu_renderer.h"
#include "validation/report/html_report.h"
#include "validation/report/json_report.h"
#include "validation/report/study_index.h"
#include "validation/report/study_page.h"
#include "validation/studies/chen_report.h"
#include "validation/studies/horbelt_report.h"
#include "validation/studies/kim_report.h"
#include "validation/studies/soucy_report.h"

namespace etalon::cli {
namespace {

using namespace etalon::validation;

struct Options {
  std::string study;
  std::vector<std::string> models;
  double reduction = 0.9;
  std::vector<std::size_t> faces;
  std::vector<std::string> tolerances;
  RangeOptions range;  ///< but its texture
  std::string texture, data;
  std::vector<std::string> views;  ///< horbelt, as the following
  std::string size;
  TerrainOptions terrain;  ///< but its spacing
  bool flip_v = false, quick = false;
  std::string report;  ///< empty: etalon-study-NAME
  GlOptions gl;
  CommonOptions common;
};

std::string report_folder(const Options& options) { return options.report.empty() ? "etalon-study-" + options.study : options.report; }

TerrainOptions terrain_options(const Options& options) {
  TerrainOptions result = options.terrain;
  result.spacing_m = options.range.spacing;
  return result;
}

/// What a study leaves to write.
struct Studied {
  StudyReport report;
  std::string device_name;
  std::uint64_t unexplained = 0;  ///< texels between both renderers
  bool is_doubtful = false;       ///< an input was warned of
};

void print_subject(const KimSubjectResult& subject, Console& console) {
  for (const KimOutcome& o : subject.outcomes)
    console.line(fmt::format("{:<22} {:<15} {:>9} vertices {:>8.2f} s  mean {:.4f} %  RMS {:.4f} %  image RMS {:.2f} ({:.2f})",
                             subject.name, to_string(o.method), grouped(o.vertices), o.seconds, o.mean, o.rms, o.image_rms,
                             o.image_rms_views));
}

KimStudyOptions study_options(const Options& options, const OpenedDevice& device, Console& console) {
  KimStudyOptions result;
  if (options.quick) {
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

Studied study_kim(const Options& options, const OpenedDevice& device, Console& console, CallFiles& files) {
  const SubjectOptions which{.models = options.models, .data = options.data, .reduction = options.reduction, .quick = options.quick};
  const std::vector<KimSubject> subjects = load_subjects(which, console, files);
  raster::CpuRenderer exact;
  const KimStudyResult result = run_kim_study(subjects, exact, study_options(options, device, console));
  return {kim_report(result), result.device_name, result.unexplained()};
}

void print_subject(const ChenSubjectResult& subject, Console& console) {
  const auto db = [](const std::optional<double>& value) { return value ? fmt::format("{:6.2f}", *value) : std::string("  same"); };
  for (std::size_t t = 0; t < subject.textures.size(); ++t)
    for (std::size_t l = 0; l < subject.levels.size(); ++l) {
      std::string line = fmt::format("{:<10} {:<8} {:>6} faces, dB masked (whole):", subject.name, subject.textures[t], subject.levels[l]);
      for (const ChenMethod method : kChenMethods) {
        const ChenOutcome& o = subject.of(t, l, method);
        line += fmt::format("  {} {} ({})", to_string(method), db(o.masked_db), db(o.whole_db));
      }
      console.line(line);
    }
}

Studied study_chen(const Options& options, const OpenedDevice& device, Console& console, CallFiles& files) {
  raster::CpuRenderer exact;
  const ChenSubjectOptions which{.models = options.models,
                                 .levels = options.faces,
                                 .texture = options.texture,
                                 .flip_v = options.flip_v,
                                 .data = options.data,
                                 .quick = options.quick};
  ChenStudyOptions how;
  if (options.quick) how.map_size = 256, how.views_px = 192, how.view_count = 4, how.picture_px = 192, how.device_singles = 60;
  how.device = device.renderer.get();
  how.progress = [&console](const std::string& label, int done, int total) { console.progress(label, done, total); };
  how.on_subject = [&console](const ChenSubjectResult& subject) { print_subject(subject, console); };
  const ChenStudyResult result = run_chen_study(load_chen_subjects(which, exact, console, files), exact, how);
  return {chen_report(result), result.device_name, 0};
}

void print_view(const std::string& subject, const HorbeltViewResult& view, Console& console) {
  std::string line = fmt::format("{:<10} {:<9} {:4.1f} % visible, dB behind, mean (worst):", subject, view.view.name,
                                 100.0 * static_cast<double>(view.visible_faces) / static_cast<double>(view.faces));
  for (const HorbeltOutcome& o : view.outcomes)
    line += fmt::format("  {} {:.3f} ({:.2f})", to_string(o.method), o.gaps.mean_db, o.gaps.max_db);
  console.line(line);
}

Studied study_horbelt(const Options& options, const OpenedDevice& device, Console& console, CallFiles& files) {
  raster::CpuRenderer exact;
  HorbeltStudyOptions how;
  if (options.quick)
    how.width = 160, how.height = 120, how.view_count = 2, how.levels.meshes = 12, how.levels.textures = 8, how.flight_frames = 4;
  if (!options.size.empty()) {
    const FrameSize size = parse_size(options.size);
    how.width = size.width, how.height = size.height;
  }
  how.device = device.renderer.get();
  if (device.renderer) how.device_model = device.model;
  how.progress = [&console](const std::string& label, int done, int total) { console.progress(label, done, total); };
  how.on_view = [&console](const std::string& subject, const HorbeltViewResult& view) { print_view(subject, view, console); };
  const HorbeltSubjectOptions which{.models = options.models,
                                    .data = options.data,
                                    .terrain = terrain_options(options),
                                    .quick = options.quick,
                                    .views = options.views,
                                    .size = options.size,
                                    .frame = {how.width, how.height}};
  const std::vector<HorbeltSubject> subjects = load_horbelt_subjects(which, console, files);
  for (const HorbeltSubject& subject : subjects)
    for (const NamedTerrainView& view : subject.views)
      files.add_output((std::filesystem::path(report_folder(options)) / horbelt_view_file(subject.name, view.name)).string(), "--report");
  const HorbeltStudyResult result = run_horbelt_study(subjects, exact, how);
  const bool is_doubtful = std::ranges::any_of(subjects, [](const HorbeltSubject& subject) { return !subject.warnings.empty(); });
  return {horbelt_report(result), result.device_name, result.unexplained(), is_doubtful};
}

void print_subject(const SoucyScanResult& scan, Console& console) {
  for (const SoucyMapping& m : scan.mappings)
    console.line(fmt::format("{:<10} {:>6}  {:>6} faces, {:<10} {:>4}²: MSE {:>9.2f}", scan.name,
                             length_text(scan.levels[m.level].tolerance, scan.unit), grouped(scan.levels[m.level].faces),
                             to_string(m.pattern), m.map_size, m.error.mse()));
}

void print_subject(const SoucyModelResult& model, Console& console) {
  const auto db = [](const std::optional<double>& value) { return value ? fmt::format("{:.2f}", *value) : std::string("same"); };
  for (const SoucyModelMap& m : model.maps)
    console.line(fmt::format("{:<22} {:>6} faces, {:>4}²: {} dB (both show it: {}), vertex colours {} ({})", model.name,
                             grouped(model.baked_faces), m.map_size, db(m.sums.whole_db()), db(m.sums.masked_db()),
                             db(model.plain_sums.whole_db()), db(model.plain_sums.masked_db())));
}

Studied study_soucy(const Options& options, const OpenedDevice& device, Console& console, CallFiles& files) {
  SoucySubjectOptions which{.models = options.models, .data = options.data, .quick = options.quick};
  if (!options.faces.empty()) which.faces = options.faces.front();
  which.tolerances = options.tolerances;
  which.range = options.range;
  which.range.texture = options.texture;
  const SoucySubjects subjects = load_soucy_subjects(which, console, files);
  raster::CpuRenderer exact;
  SoucyStudyOptions how;
  if (options.quick) how.views_px = 128, how.view_count = 4, how.picture_px = 192, how.model_maps = {256};
  how.device = device.renderer.get();
  how.device_model = device.model;
  how.progress = [&console](const std::string& label, int done, int total) { console.progress(label, done, total); };
  how.on_scan = [&console](const SoucyScanResult& scan) { print_subject(scan, console); };
  how.on_model = [&console](const SoucyModelResult& model) { print_subject(model, console); };
  const SoucyStudyResult result = run_soucy_study(subjects.scans, subjects.models, exact, how);
  return {soucy_report(result, exact), result.device_name, result.unexplained()};
}

Studied run_study(const Options& options, const OpenedDevice& device, Console& console, CallFiles& files) {
  Studied studied = (options.study == "chen"      ? study_chen
                     : options.study == "horbelt" ? study_horbelt
                     : options.study == "kim"     ? study_kim
                                                  : study_soucy)(options, device, console, files);
  if (options.quick) {
    const std::string warning = "A quick run: small models, few samples. No figure of it counts.";
    studied.report.lede = warning + " " + studied.report.lede;
    console.line("note: " + warning);
  }
  for (const StudyClaim& claim : studied.report.claims)
    console.line(fmt::format("{:<6} {} {}", to_string(claim.verdict), claim.claim, claim.measured));
  return studied;
}

/// What to type to repeat it, paths by their last part.
std::string command_of(const Options& options) {
  std::string command = "etalon study " + options.study;
  for (const std::string& model : options.models) command += " " + std::filesystem::path(model).filename().string();
  for (const std::size_t faces : options.faces) command += fmt::format(" --faces {}", faces);
  for (const std::string& tolerance : options.tolerances) command += " --tolerance " + tolerance;
  if (options.range.depth_scale) command += fmt::format(" --depth-scale {}", *options.range.depth_scale);
  if (options.range.no_data) command += fmt::format(" --no-data {}", *options.range.no_data);
  if (options.range.max_jump) command += fmt::format(" --max-jump {}", *options.range.max_jump);
  if (!options.texture.empty()) command += " --texture " + std::filesystem::path(options.texture).filename().string();
  if (options.flip_v) command += " --flip-v";
  command += terrain_arguments(terrain_options(options));
  if (!options.size.empty()) command += " --size " + options.size;
  for (const std::string& view : options.views)
    command += " --view " + (std::filesystem::exists(view) ? std::filesystem::path(view).filename().string() : view);
  return command + (options.quick ? " --quick" : "");
}

void check_options(const Options& options) {
  if (options.study == "all" && !options.models.empty())
    throw UsageError("study all: models belong to one study (chen, kim, soucy or horbelt), got " + options.models.front());
  const bool chen = options.study == "chen";
  if (!chen && options.study != "soucy" && (!options.faces.empty() || !options.texture.empty()))
    throw UsageError(fmt::format("study {}: --faces and --texture belong to study chen and study soucy", options.study));
  if (options.study == "soucy" && options.faces.size() > 1) throw UsageError("study soucy: expected one --faces, got several");
  if (!chen && options.flip_v) throw UsageError(fmt::format("study {}: --flip-v belongs to study chen", options.study));
  const RangeOptions& range = options.range;
  if (options.study != "soucy" && options.study != "horbelt" && range.spacing)
    throw UsageError(fmt::format("study {}: --spacing belongs to study soucy and study horbelt", options.study));
  if (options.study != "soucy" && (range.depth_scale || range.no_data || range.max_jump || !options.tolerances.empty()))
    throw UsageError(fmt::format("study {}: --tolerance, --depth-scale, --no-data and --max-jump belong to study soucy", options.study));
  if (options.study != "horbelt" && (!options.views.empty() || !options.size.empty() || !terrain_arguments(options.terrain).empty()))
    throw UsageError(
        fmt::format("study {}: --view, --size, --grid, --texture-size and --height-scale belong to study horbelt", options.study));
  if (options.study != "kim" && options.reduction != Options{}.reduction)
    throw UsageError(fmt::format("study {}: --reduction belongs to study kim", options.study));
}

RunInfo run_of(const Studied& studied, std::chrono::steady_clock::time_point start) {
  RunInfo run = current_run(start);
  for (const VerifyInput& input : studied.report.inputs)
    if (!input.path.empty()) run.paths.push_back(input.path);
  run.device = studied.device_name;
  return run;
}

/// Each study in its own folder, written as soon as it is done; what is left of it goes into the index.
Studied run_all(const Options& options, const OpenedDevice& device, Console& console, CallFiles& files) {
  Studied all{.report = make_study_index()};
  for (const char* name : {"soucy", "chen", "kim", "horbelt"}) {
    Options one = options;
    one.study = name;
    one.report = (std::filesystem::path(report_folder(options)) / name).string();
    console.line(fmt::format("study    {}", name));
    const auto start = std::chrono::steady_clock::now();
    const Studied studied = run_study(one, device, console, files);
    {
      const FinishWriting finish;
      console.line("report: " + file_url(write_study(one.report, studied.report, run_of(studied, start), command_of(one))));
    }
    add_to_index(all.report, studied.report);
    if (all.device_name.empty()) all.device_name = studied.device_name;
    all.unexplained += studied.unexplained;
    all.is_doubtful = all.is_doubtful || studied.is_doubtful;
  }
  if (options.quick) all.report.lede = "A quick run: small models, few samples. No figure of it counts. " + all.report.lede;
  return all;
}

int run(const Options& options) {
  apply(options.common);
  check_options(options);
  const std::string folder = report_folder(options);
  require_writable_folder(folder);
  Console console(console_options(options.common));
  CallFiles files;
  for (const char* name : {"index.html", "study.json", "study.md"})
    files.add_output((std::filesystem::path(folder) / name).string(), "--report");
  files.add_output(options.common.json, "--json");
  require_writable_file(options.common.json);
  const OpenedDevice device = open_device(options.gl, options.common.threads);
  console.line(fmt::format("device   {}", device.renderer ? device.renderer->name() : "GL: not available (" + device.unavailable + ")"));

  const Studied studied = (options.study == "all" ? run_all : run_study)(options, device, console, files);
  const RunInfo run_info = run_of(studied, options.common.start);
  std::filesystem::path page;
  {
    const FinishWriting finish;
    page = write_study(folder, studied.report, run_info, command_of(options));
  }
  console.line("report: " + file_url(page));
  write_document(options.common, study_document(studied.report, run_info));
  if (studied.unexplained > 0) {
    print_error(fmt::format("{} unexplained between both renderers", counted(studied.unexplained, "texel")));
    return kExitCheckFailed;
  }
  return studied.is_doubtful ? kExitWarning : kExitDone;
}

}  // namespace

Verb add_study(CLI::App& root) {
  const auto options = std::make_shared<Options>();
  CLI::App* app =
      root.add_subcommand("study", "Repeat a paper's measurements: its tables and figures beside ours, each claim with a verdict");
  app->add_option(
         "study", options->study,
         "chen: Chen & Chuang, texture adaptation for progressive meshes; kim: Kim, Choi & Lee, mesh simplification with vertex "
         "colour; soucy: Soucy, Godin & Rioux, coloured scans baked; horbelt: Horbelt, Balmelli & Vetterli, joint mesh and texture "
         "compression; all: the four, each in its folder of the report, and an index over them")
      ->required()
      ->type_name("chen|kim|soucy|horbelt|all")
      ->check(CLI::IsMember({"chen", "kim", "soucy", "horbelt", "all"}));
  app->add_option(
         "models", options->models,
         "chen: textured meshes, or swirl, head, parasaur, bunny, spot; kim: meshes with vertex colours, or monkey, duck, statue; soucy: "
         "the same, range images (.png .tif .exr), or shuttle, hand, soldier, teapot, telephone, duck; horbelt: DEM IMAGE, or davosdorf, "
         "alps "
         "(default: those at the paper's sizes, real ones where they are found)")
      ->type_name("MODEL");
  app->add_option("--faces", options->faces,
                  "chen: a level of the mesh files (repeat it; default a quarter, an eighth, a sixteenth); soucy: triangles of the models "
                  "(default 1000)")
      ->type_name("N")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{1} << 32));
  app->add_option("--texture", options->texture,
                  "chen: image that replaces the mesh files' own textures; soucy: the colours of a range image")
      ->type_name("IMG")
      ->check(not_empty());
  app->add_flag("--flip-v", options->flip_v,
                "chen: the mesh files' texture coordinates run from top to bottom against their format's convention");
  add_range_file_options(*app, options->range);
  app->get_option("--spacing")
      ->description(
          "soucy: of a range image, model units from sample to sample (EXR: default its attribute rangeSpacing); horbelt: metres between "
          "the "
          "samples of a DEM of one's own (default 10)");
  app->add_option("--tolerance", options->tolerances,
                  "soucy: how far a sample of a range image file may be from the surface: model units, or 0.5% of the diagonal (repeat it, "
                  "ascending; default 0.5%, 1%, 2%)")
      ->type_name("D")
      ->check(not_empty());
  app->add_option("--reduction", options->reduction, "kim: share of the vertices of a mesh file that goes (default 0.9)")
      ->type_name("R")
      ->check(number_between(0.01, 0.999));
  app->add_option("--view", options->views,
                  "horbelt: a view file (etalon/view/1), or fit, front, N/24, instead of the study's own five (repeat it)")
      ->type_name("FILE|NAME")
      ->check(not_empty());
  app->add_option("--size", options->size, "horbelt: frames in pixels (default: a view file's, else 640x480)")
      ->type_name("WxH")
      ->check(not_empty());
  add_terrain_options(*app, options->terrain);
  app->add_option("--data", options->data, "Folder of the real inputs (default $ETALON_DATA, else etalon in your cache)")
      ->type_name("DIR")
      ->check(not_empty());
  app->add_flag("--quick", options->quick, "Small models and few samples: seconds, to see whether it works; no figure of it counts");
  app->add_option("--report", options->report, "Folder of the report (default etalon-study-NAME)")->type_name("DIR")->check(not_empty());
  add_gl_options(*app, options->gl);
  add_common_options(*app, options->common,
                     "  etalon study chen --quick\n  etalon study chen fox.obj --faces 2000 --faces 500 --report fox-study\n  etalon study "
                     "kim scan.ply --reduction 0.95 --report scan-study\n  etalon study soucy scan.ply --faces 2000\n  etalon study soucy "
                     "depth.tif --spacing 0.7 --texture colour.png\n  etalon study horbelt dem.tif photo.png --view pass.json --report "
                     "pass-study\n  etalon study all --quick");
  return {app, [options] { return run(*options); }};
}

}  // namespace etalon::cli
