#include "cli/chen_subjects.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "cli/model_input.h"
#include "cli/study_subjects.h"
#include "core/base/error.h"
#include "core/io/image_file.h"
#include "core/mesh/weld.h"
#include "core/procedural/head.h"
#include "core/procedural/swirl.h"
#include "core/simplify/simplify.h"
#include "validation/report/json_report.h"
#include "validation/studies/normal_texture.h"
#include "validation/verify/verify_maps.h"

namespace etalon::cli {

namespace {

namespace fs = std::filesystem;
using validation::ChenSubject;
using validation::ChenTexture;

constexpr const char* kKnown[] = {"parasaur", "bunny", "spot", "swirl", "head"};
constexpr const char* kHead = "lee_perry_smith/LeePerrySmith.glb";
constexpr const char* kHeadColors = "lee_perry_smith/Map-COL.jpg";
constexpr const char* kHeadNormals = "lee_perry_smith/Infinite-Level_02_Tangent_SmoothUV.jpg";
constexpr const char* kSpot = "spot/spot_triangulated.obj";
constexpr const char* kSpotColors = "spot/spot_texture.png";
constexpr std::size_t kParasaurFaces = 7685;

bool is_known(const std::string& name) { return std::find(std::begin(kKnown), std::end(kKnown), name) != std::end(kKnown); }

std::vector<std::string> real_files(const std::string& name) {
  if (name == "parasaur") return {kHead, kHeadColors, kHeadNormals};
  if (name == "bunny") return {kHead, kHeadColors};
  if (name == "spot") return {kSpot, kSpotColors};
  return {};
}

/// 32 × 32 fields: what is straight on the full mesh.
Image checker(int size) {
  Image image(size, size, kRgb8);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const bool dark = ((x * 32 / size) + (y * 32 / size)) % 2 == 0;
      auto* const c = image.channels<std::uint8_t>(x, y);
      c[0] = dark ? 32 : 246, c[1] = dark ? 74 : 240, c[2] = dark ? 120 : 226;
    }
  return image;
}

class Loader {
 public:
  Loader(const ChenSubjectOptions& options, Renderer& exact, CallFiles& files)
      : options_(options), exact_(exact), files_(files), folder_(data_folder(options.data)) {}

  [[nodiscard]] bool found(const std::string& name) const {
    const std::vector<std::string> needed = real_files(name);
    return std::all_of(needed.begin(), needed.end(), [&](const std::string& file) {
      std::error_code error;
      return !folder_.empty() && fs::exists(fs::path(folder_) / file, error);
    });
  }

  ChenSubject load(const std::string& name) {
    if (name == "swirl") return swirl();
    if (name == "head") return head();
    if (!is_known(name)) return own(name);
    if (!found(name))
      throw InputError(
          fmt::format("{}: expected {} in the folder of real inputs (ETALON_DATA or --data), got none", name, real_files(name).front()));
    return name == "spot" ? spot() : real_head(name);
  }

 private:
  ChenSubject swirl() const {
    const int faces = options_.quick ? 1152 : 7688;
    ChenSubject subject = embedded(procedural::make_swirl({.faces = faces, .texture_size = options_.quick ? 256 : 1024}));
    subject.levels = {options_.quick ? 100u : 399u};
    subject.paper_figure = 15, subject.shows_parameterization = true, subject.view = "front";
    return subject;
  }

  ChenSubject head() const {
    const int faces = options_.quick ? 1600 : 7685;
    ChenSubject subject = embedded(procedural::make_head({.faces = faces, .texture_size = options_.quick ? 256 : 1024}));
    subject.levels = options_.quick ? std::vector<std::size_t>{400, 160} : std::vector<std::size_t>{2000, 1000, 499};
    subject.textures.push_back({"normals", validation::object_normals(exact_, subject.mesh, nullptr, options_.quick ? 256 : 1024), true});
    return subject;
  }

  static ChenSubject embedded(procedural::Model model) {
    validation::VerifyModel source = embedded_model(std::move(model));
    ChenSubject subject;
    subject.name = source.name;
    subject.mesh = welded_by_position(source.mesh);
    subject.inputs = source.inputs;
    subject.textures = {{"colour", *source.materials.front().texture, false}};
    return subject;
  }

  [[nodiscard]] std::string path_of(const char* file) const { return (fs::path(folder_) / file).string(); }

  ChenSubject read(const std::string& path, const ModelOptions& how) {
    const validation::VerifyModel source = load_model(path, how, files_);
    if (!source.mesh.has_uv) throw InputError(path + ": expected texture coordinates, got none");
    ChenSubject subject;
    subject.mesh = welded_by_position(source.mesh);
    subject.mesh.colors.clear();
    subject.inputs = source.inputs;
    std::shared_ptr<const Image> texture;
    for (const Material& material : source.materials) {
      if (material.texture != nullptr && texture != nullptr && *material.texture != *texture)
        throw InputError(
            fmt::format("{}: expected one texture, got {} materials with several (try --texture IMG)", path, source.materials.size()));
      if (material.texture != nullptr) texture = material.texture;
    }
    subject.mesh.face_materials.clear();
    if (texture == nullptr) texture = validation::checkerboard();
    subject.textures = {{"colour", *texture, false}};
    return subject;
  }

  ChenSubject spot() {
    ChenSubject subject = read(path_of(kSpot), {.texture = path_of(kSpotColors)});
    subject.name = "spot", subject.levels = {574}, subject.paper_figure = 13;
    return subject;
  }

  ChenSubject real_head(const std::string& name) {
    ChenSubject subject = read(path_of(kHead), {.texture = path_of(kHeadColors), .flip_v = true});
    subject.name = name, subject.view = "front";
    if (name == "bunny") {
      subject.levels = {500}, subject.paper_figure = 14, subject.shows_parameterization = true, subject.paper_row = 1;
      subject.textures.push_back({"checker", checker(subject.textures.front().image.width()), false});
      return subject;
    }
    files_.add_input(path_of(kHeadNormals), "the normal map");
    const Image tangent = io::read_image(path_of(kHeadNormals));
    subject.inputs.push_back(file_input(path_of(kHeadNormals), "normal map"));
    subject.textures.push_back({"normals", validation::object_normals(exact_, subject.mesh, &tangent, 0), true});
    simplify::SimplifyOptions reduce;
    reduce.metric = simplify::MetricName::qem5, reduce.target_faces = kParasaurFaces;
    subject.mesh = simplify::simplify_mesh(subject.mesh, reduce).mesh;
    subject.levels = {2000, 1000, 499}, subject.paper_figure = 11, subject.paper_row = 0;
    return subject;
  }

  ChenSubject own(const std::string& path) {
    ChenSubject subject = read(path, {.texture = options_.texture, .flip_v = options_.flip_v});
    subject.name = slug_of(path);
    subject.levels = options_.levels;
    const std::size_t faces = subject.mesh.face_count();
    if (subject.levels.empty()) subject.levels = {faces / 4, faces / 8, faces / 16};
    return subject;
  }

  const ChenSubjectOptions& options_;
  Renderer& exact_;
  CallFiles& files_;
  std::string folder_;
};

}  // namespace

std::vector<ChenSubject> load_chen_subjects(const ChenSubjectOptions& options, Renderer& exact, Console& console, CallFiles& files) {
  Loader loader(options, exact, files);
  std::vector<std::string> wanted = options.models;
  if (wanted.empty() && options.quick) wanted = {"swirl", "head"};
  if (wanted.empty())
    for (const char* name : kKnown) {
      if (loader.found(name))
        wanted.emplace_back(name);
      else
        console.line(fmt::format("note: {} is not there: {} is left out (ETALON_DATA or --data)", real_files(name).front(), name));
    }
  std::vector<ChenSubject> subjects;
  for (const std::string& name : wanted) {
    ChenSubject subject = loader.load(name);
    const std::string slug = subject.name;
    for (int i = 2; std::any_of(subjects.begin(), subjects.end(), [&](const ChenSubject& other) { return other.name == subject.name; });
         ++i)
      subject.name = fmt::format("{}-{}", slug, i);
    subject.title = fmt::format("{}, {} faces", subject.name, validation::grouped(subject.mesh.face_count()));
    console.line(fmt::format("model    {}", subject.title));
    for (const validation::VerifyInput& input : subject.inputs)
      if (!input.attribution.empty()) {
        console.line("         by " + input.attribution);
        break;
      }
    subjects.push_back(std::move(subject));
  }
  return subjects;
}

}  // namespace etalon::cli
