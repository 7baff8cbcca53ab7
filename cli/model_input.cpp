#include "cli/model_input.h"

#include <filesystem>

#include <fmt/format.h>

#include "cli/attribution.h"
#include "cli/common_options.h"
#include "cli/work_bytes.h"
#include "core/base/error.h"
#include "core/base/sha256.h"
#include "core/io/image_file.h"
#include "core/io/inputs.h"
#include "core/io/mesh_file.h"
#include "validation/verify/verify_maps.h"

namespace etalon::cli {
namespace {

namespace fs = std::filesystem;
using validation::VerifyInput;
using validation::VerifyModel;

Material textured(Image texture) {
  Material material;
  material.texture = std::make_shared<const Image>(std::move(texture));
  return material;
}

std::vector<Material> given_texture(const std::string& path, std::size_t count, VerifyModel& model) {
  const Material material = textured(io::read_image(path));
  model.inputs.push_back(file_input(path, "texture"));
  return std::vector<Material>(count, material);
}

std::vector<Material> own_textures(const std::vector<io::Material>& loaded, VerifyModel& model) {
  std::vector<Material> materials;
  for (const io::Material& source : loaded) {
    Image texture = io::load_texture(source);
    if (source.texture_path) model.inputs.push_back(file_input(source.texture_path->string(), "texture"));
    materials.push_back(texture.empty() ? Material{} : textured(std::move(texture)));
  }
  if (materials.empty()) materials.emplace_back();
  return materials;
}

// Seen along z, the longer side of the box in [0, 2]: there is a pattern to look at, and texture coordinates to check.
void project_uv(Mesh& mesh) {
  const BoundingBox box = bounding_box(mesh);
  const double size = std::max({double{box.hi.x} - box.lo.x, double{box.hi.y} - box.lo.y, 1e-30});
  for (Wedge& wedge : mesh.wedges) {
    const Vec3f& p = mesh.positions[wedge.vertex.index];
    wedge.uv = {static_cast<float>(2 * (double{p.x} - box.lo.x) / size), static_cast<float>(2 * (double{p.y} - box.lo.y) / size)};
  }
}

void stand_in_for_textures(VerifyModel& model) {
  bool any_texture = false;
  for (const Material& material : model.materials) any_texture = any_texture || material.texture != nullptr;
  if (any_texture || !model.mesh.colors.empty()) return;
  if (!model.mesh.has_uv) {
    project_uv(model.mesh);
    model.notes.push_back(
        "no texture, colours or texture coordinates: drawn with a checkerboard projected along z (try --texture with a model that has "
        "coordinates)");
  } else {
    model.notes.push_back("no texture and no colours: drawn with a checkerboard (try --texture IMG)");
  }
  const auto texture = validation::checkerboard();
  for (Material& material : model.materials) material.texture = texture;
}

}  // namespace

VerifyInput file_input(const std::string& path, const std::string& role) {
  VerifyInput input;
  input.name = fs::path(path).filename().string();
  input.path = path;
  input.role = role;
  input.sha256 = io::file_sha256(path);
  input.attribution = attribution_of(input.sha256);
  return input;
}

void add_model_options(CLI::App& verb, ModelOptions& options) {
  verb.add_option("--texture", options.texture, "Image that replaces the model's own textures")->type_name("IMG")->check(not_empty());
  verb.add_flag("--flip-v", options.flip_v, "The model's texture coordinates run from top to bottom against its format's convention");
  verb.add_option("--snap-bits", options.snap_bits, "Sub-texel bits of raster positions (default 8)")
      ->type_name("N")
      ->check(CLI::Range(1, 16));
}

void add_side_files(CallFiles& files, const io::LoadedModel& model) {
  for (const fs::path& path : model.side_files) files.add_input(path.string(), "a file of the model");
  for (const io::Material& material : model.materials)
    if (material.texture_path) files.add_input(material.texture_path->string(), "the model's texture");
}

VerifyModel load_model(const std::string& path, const ModelOptions& options, CallFiles& files) {
  files.add_input(path, "the model");
  files.add_input(options.texture, "--texture");
  VerifyModel model;
  io::LoadedModel loaded = io::read_mesh(path, kMinDrawBytesPerFace);
  add_side_files(files, loaded);
  model.name = fs::path(path).stem().string();
  model.mesh = std::move(loaded.mesh);
  model.notes = std::move(loaded.notes);
  model.inputs.push_back(file_input(path, "model"));
  if (options.flip_v) io::flip_v(model.mesh);
  if (!options.texture.empty()) {
    if (!model.mesh.has_uv) throw InputError(fmt::format("{}: --texture needs texture coordinates, and the model has none", path));
    model.materials = given_texture(options.texture, std::max<std::size_t>(loaded.materials.size(), 1), model);
  } else {
    model.materials = own_textures(loaded.materials, model);
  }
  stand_in_for_textures(model);
  return model;
}

VerifyModel embedded_model(procedural::Model source) {
  VerifyModel model;
  model.name = source.name;
  Sha256 hash;
  const std::string mesh_hash = mesh_sha256(source.mesh);
  const std::string texture_hash = source.texture.sha256();
  hash.update(mesh_hash.data(), mesh_hash.size());
  hash.update(texture_hash.data(), texture_hash.size());
  model.inputs.push_back({.name = source.name + " (embedded)", .sha256 = hash.hex(), .path = "", .role = "model", .attribution = ""});
  model.mesh = std::move(source.mesh);
  model.materials = {textured(std::move(source.texture))};
  return model;
}

std::string mesh_sha256(const Mesh& mesh) {
  Sha256 hash;
  const auto add = [&](const auto& array) {
    const std::uint64_t count = array.size();
    hash.update(&count, sizeof count);
    hash.update(array.data(), array.size() * sizeof(array[0]));
  };
  add(mesh.positions);
  add(mesh.colors);
  add(mesh.wedges);
  add(mesh.faces);
  add(mesh.face_materials);
  return hash.hex();
}

}  // namespace etalon::cli
