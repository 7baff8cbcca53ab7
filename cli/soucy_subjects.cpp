#include "cli/soucy_subjects.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "cli/attribution.h"
#include "cli/length_option.h"
#include "cli/model_input.h"
#include "cli/study_subjects.h"
#include "cli/usage_error.h"
#include "core/base/error.h"
#include "core/io/inputs.h"
#include "core/io/mesh_file.h"
#include "core/io/range_file.h"
#include "core/mesh/weld.h"
#include "core/procedural/duck.h"
#include "core/procedural/range_scan.h"
#include "validation/report/json_report.h"

namespace etalon::cli {
namespace {

namespace fs = std::filesystem;
using validation::SoucyModel;
using validation::SoucyScan;

constexpr const char* kReal[] = {"lee_perry_smith/lee_perry_smith_283k.ply", "milk_carton/milk_carton_grid.ply"};

const procedural::RangeKind* range_named(const std::string& name) {
  for (const procedural::RangeKind& kind : procedural::range_kinds())
    if (procedural::range_name(kind) == name) return &kind;
  return nullptr;
}

validation::VerifyInput embedded(const std::string& name, const Mesh& mesh) {
  return {.name = name + " (embedded)", .sha256 = mesh_sha256(mesh), .path = "", .role = "model", .attribution = ""};
}

SoucyScan make_scan(procedural::RangeKind kind, bool quick) {
  const RangeImage range = procedural::make_range_scan(kind);
  SoucyScan scan;
  scan.name = procedural::range_name(kind);
  scan.mesh = triangulate(range);
  scan.grid = {range.width, range.height, range.spacing};
  scan.tolerances = quick ? std::vector<double>{2, 4} : std::vector<double>{1, 2, 4};  // the paper's
  scan.unit = "mm";
  scan.inputs = {embedded(scan.name, scan.mesh)};
  return scan;
}

SoucyModel make_duck(const SoucySubjectOptions& options, Console& console) {
  procedural::DuckOptions how = options.quick ? procedural::duck_of_faces(10'000, false) : procedural::duck_of_paper(false);
  how.progress = [&](int done, int total) { console.progress("making the duck", done, total); };
  SoucyModel model;
  model.name = "duck";
  model.mesh = procedural::make_duck(how);
  model.target_faces = options.faces;
  model.pictured = true;
  model.inputs = {embedded("duck", model.mesh)};
  return model;
}

class Names {
 public:
  std::string unique(const std::string& slug) {
    std::string name = slug;
    for (int n = 2; std::find(taken_.begin(), taken_.end(), name) != taken_.end(); ++n) name = fmt::format("{}-{}", slug, n);
    taken_.push_back(name);
    return name;
  }

 private:
  std::vector<std::string> taken_;
};

std::vector<validation::VerifyInput> inputs_of(const std::string& path, const std::string& texture) {
  std::vector<validation::VerifyInput> inputs;
  for (const std::string& file : {path, texture}) {
    if (file.empty()) continue;
    const std::string hash = io::file_sha256(file);
    inputs.push_back({.name = fs::path(file).filename().string(),
                      .sha256 = hash,
                      .path = file,
                      .role = inputs.empty() ? "model" : "texture",
                      .attribution = attribution_of(hash)});
  }
  return inputs;
}

SoucyModel read_model(const std::string& path, const SoucySubjectOptions& options, CallFiles& files, Console& console) {
  const io::LoadedModel loaded = load_scan(path, options.range, files);
  for (const std::string& note : loaded.notes) console.line("note: " + note);
  add_side_files(files, loaded);
  if (loaded.mesh.colors.empty()) throw InputError(path + ": expected vertex colours, got none");
  return {.name = slug_of(path),
          .mesh = loaded.mesh,
          .target_faces = options.faces,
          .pictured = true,
          .inputs = inputs_of(path, options.range.texture)};
}

std::vector<double> tolerances_of(const std::vector<std::string>& texts, double diagonal) {
  if (texts.empty()) return {0.005 * diagonal, 0.01 * diagonal, 0.02 * diagonal};
  std::vector<double> tolerances;
  for (const std::string& text : texts) {
    const double tolerance = parse_length(text, diagonal, "study soucy: --tolerance");
    if (!(tolerance > (tolerances.empty() ? 0 : tolerances.back())))
      throw UsageError(
          fmt::format("study soucy: --tolerance: expected a length above {}, got {}", tolerances.empty() ? "0" : "the one before", text));
    tolerances.push_back(tolerance);
  }
  return tolerances;
}

SoucyScan read_scan(const std::string& path, const SoucySubjectOptions& options) {
  const RangeOptions& how = options.range;
  const RangeImage range =
      io::read_range_image(path, {.spacing = how.spacing, .depth_scale = how.depth_scale.value_or(1), .no_data = how.no_data}).range;
  SoucyScan scan;
  scan.name = slug_of(path);
  scan.mesh = triangulate(range, {}, {.max_jump = how.max_jump});
  if (scan.mesh.face_count() == 0) throw InputError(path + ": a range image: expected neighbours without a jump in depth, got none");
  scan.grid = {range.width, range.height, range.spacing};
  scan.tolerances = tolerances_of(options.tolerances, bounding_box(scan.mesh).diagonal());
  scan.inputs = inputs_of(path, "");
  return scan;
}

std::vector<std::string> wanted(const SoucySubjectOptions& options, Console& console) {
  if (!options.models.empty()) return options.models;
  if (options.quick) return {"telephone", "duck"};
  std::vector<std::string> names;
  for (const procedural::RangeKind kind : procedural::range_kinds()) names.emplace_back(procedural::range_name(kind));
  names.emplace_back("duck");
  const std::string folder = data_folder(options.data);
  for (const char* file : kReal) {
    const fs::path path = fs::path(folder) / file;
    std::error_code error;
    if (!folder.empty() && fs::exists(path, error))
      names.push_back(path.string());
    else
      console.line(fmt::format("note: {} is not there: left out (ETALON_DATA or --data)", file));
  }
  return names;
}

}  // namespace

SoucySubjects load_soucy_subjects(const SoucySubjectOptions& options, Console& console, CallFiles& files) {
  SoucySubjects subjects;
  Names names;
  const auto announce = [&](const std::string& name, std::size_t faces, const std::vector<validation::VerifyInput>& inputs) {
    console.line(fmt::format("model    {}, {} faces", name, validation::grouped(faces)));
    if (!inputs.front().attribution.empty()) console.line("         by " + inputs.front().attribution);
  };
  for (const std::string& each : wanted(options, console)) {
    if (const procedural::RangeKind* kind = range_named(each); kind != nullptr) {
      SoucyScan scan = make_scan(*kind, options.quick);
      scan.name = names.unique(scan.name);
      announce(scan.name, scan.mesh.face_count(), scan.inputs);
      subjects.scans.push_back(std::move(scan));
      continue;
    }
    if (each != "duck") files.add_input(each, "the model");
    if (each != "duck" && io::names_range_image(each)) {
      SoucyScan scan = read_scan(each, options);
      scan.name = names.unique(scan.name);
      announce(scan.name, scan.mesh.face_count(), scan.inputs);
      subjects.scans.push_back(std::move(scan));
      if (options.range.texture.empty()) continue;
    }
    SoucyModel model = each == "duck" ? make_duck(options, console) : read_model(each, options, files, console);
    model.name = names.unique(model.name);
    announce(model.name, model.mesh.face_count(), model.inputs);
    subjects.models.push_back(std::move(model));
  }
  return subjects;
}

}  // namespace etalon::cli
