#include "cli/study_subjects.h"

#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>

#include "cli/attribution.h"
#include "cli/model_input.h"
#include "cli/work_bytes.h"
#include "core/base/error.h"
#include "core/io/inputs.h"
#include "core/io/mesh_file.h"
#include "core/mesh/weld.h"
#include "core/procedural/duck.h"
#include "core/procedural/monkey.h"
#include "core/procedural/statue.h"
#include "validation/report/json_report.h"

namespace etalon::cli {

namespace {

namespace fs = std::filesystem;
using validation::KimSubject;

constexpr const char* kEmbedded[] = {"monkey", "duck", "statue"};
constexpr const char* kReal[] = {"lee_perry_smith/lee_perry_smith_283k.ply", "milk_carton/milk_carton_grid.ply"};

bool is_embedded(const std::string& name) {
  for (const char* known : kEmbedded)
    if (name == known) return true;
  return false;
}

/// As the paper's: reductions of 90 %, 90 % and 97 %, rows 0 to 2 of its tables.
KimSubject make_subject(const std::string& name, bool quick, Console& console) {
  const procedural::ProcedureProgress progress = [&](int done, int total) { console.progress("making the " + name, done, total); };
  KimSubject subject;
  subject.name = name;
  if (name == "monkey") {
    subject.mesh = procedural::make_monkey({.faces = quick ? 20'000 : 101'002, .progress = progress});
    if (!quick) subject.paper_row = 0;
  } else if (name == "duck") {
    procedural::DuckOptions duck = quick ? procedural::duck_of_faces(10'000, true) : procedural::duck_of_paper(true);
    duck.progress = progress;
    subject.mesh = procedural::make_duck(duck);
    if (!quick) subject.paper_row = 1;
  } else {
    subject.mesh = procedural::make_statue({.faces = quick ? 40'000 : 2'351'302, .progress = progress});
    subject.reduction = 0.97;
    if (!quick) subject.paper_row = 2;
  }
  subject.inputs.push_back(
      {.name = name + " (embedded)", .sha256 = mesh_sha256(subject.mesh), .path = "", .role = "model", .attribution = ""});
  return subject;
}

std::string slug_among(const std::string& path, const std::vector<KimSubject>& others) {
  const std::string slug = slug_of(path);
  std::string unique = slug;
  const auto taken = [&] {
    for (const KimSubject& other : others)
      if (other.name == unique) return true;
    return false;
  };
  for (int i = 2; taken(); ++i) unique = fmt::format("{}-{}", slug, i);
  return unique;
}

KimSubject read_subject(const std::string& path, double reduction, const std::vector<KimSubject>& others, CallFiles& files) {
  files.add_input(path, "the model");
  io::LoadedModel model = io::read_mesh(path, kMinSimplifyBytesPerFace);
  add_side_files(files, model);
  if (model.mesh.colors.empty()) throw InputError(path + ": expected vertex colours, got none");
  KimSubject subject;
  subject.name = slug_among(path, others);
  subject.mesh = welded_by_position(model.mesh);
  subject.reduction = reduction;
  const std::string hash = io::file_sha256(path);
  subject.inputs.push_back(
      {.name = fs::path(path).filename().string(), .sha256 = hash, .path = path, .role = "model", .attribution = attribution_of(hash)});
  return subject;
}

}  // namespace

std::string slug_of(const std::string& path) {
  std::string slug;
  for (const char c : fs::path(path).stem().string()) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    slug += letter ? c : c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : '_';
  }
  return slug.empty() ? "model" : slug;
}

std::string data_folder(const std::string& given) {
  if (!given.empty()) return given;
  if (const char* data = std::getenv("ETALON_DATA")) return data;
  if (const char* cache = std::getenv("XDG_CACHE_HOME")) return std::string(cache) + "/etalon";
  if (const char* home = std::getenv("HOME")) return std::string(home) + "/.cache/etalon";
  return "";
}

std::vector<KimSubject> load_subjects(const SubjectOptions& options, Console& console, CallFiles& files) {
  std::vector<std::string> wanted = options.models;
  if (wanted.empty()) {
    wanted.assign(std::begin(kEmbedded), std::end(kEmbedded));
    if (!options.quick) {
      const std::string folder = data_folder(options.data);
      for (const char* file : kReal) {
        const fs::path path = fs::path(folder) / file;
        std::error_code error;
        if (!folder.empty() && fs::exists(path, error))
          wanted.push_back(path.string());
        else
          console.line(fmt::format("note: {} is not there: left out (ETALON_DATA or --data)", file));
      }
    }
  }
  std::vector<KimSubject> subjects;
  for (const std::string& name : wanted) {
    subjects.push_back(is_embedded(name) ? make_subject(name, options.quick, console)
                                         : read_subject(name, options.reduction, subjects, files));
    const KimSubject& subject = subjects.back();
    console.line(fmt::format("model    {}: {} vertices, {}", subject.name, validation::grouped(subject.mesh.vertex_count()),
                             validation::grouped(subject.mesh.face_count()) + " faces"));
    if (!subject.inputs.front().attribution.empty()) console.line("         by " + subject.inputs.front().attribution);
  }
  return subjects;
}

}  // namespace etalon::cli
