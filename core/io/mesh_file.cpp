#include "core/io/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/base/error.h"
#include "core/io/image_file.h"
#include "core/io/input_error.h"
#include "core/io/inputs.h"
#include "core/io/mesh_formats.h"

namespace etalon::io {
namespace {

namespace fs = std::filesystem;

std::string lower_extension(const fs::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension;
}

/// Names that nobody types for another picture: a drawing of STEM.obj is likely to be called STEM.png. Empty: not embedded.
std::vector<std::string> embedded_texture_names(const fs::path& model_path, const std::vector<Material>& materials) {
  const auto embedded_count = std::count_if(materials.begin(), materials.end(), [](const Material& m) { return !m.texture.empty(); });
  const std::string stem = model_path.stem().string();
  std::vector<std::string> names(materials.size());
  int number = 0;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    if (materials[i].texture.empty()) continue;
    names[i] = embedded_count == 1 ? stem + "_texture.png" : fmt::format("{}_texture_{}.png", stem, number++);
  }
  return names;
}

enum class MeshFormat { obj, ply, gltf, stl };

/// The format that the content shows without doubt, else `fallback`.
MeshFormat format_of(std::string_view text, MeshFormat fallback) {
  if (text.starts_with("ply\n") || text.starts_with("ply\r")) return MeshFormat::ply;
  if (text.starts_with("glTF")) return MeshFormat::gltf;
  return fallback;
}

void check_mesh(const fs::path& path, const Mesh& mesh, const std::vector<Material>& materials) {
  const auto refuse = [&](const std::string& what) { throw WriteError(fmt::format("{}: cannot write: {}", path.string(), what)); };
  if (mesh.faces.empty()) refuse("the mesh has no faces");
  if (!mesh.colors.empty() && mesh.colors.size() != mesh.positions.size())
    refuse(fmt::format("colours: expected {}, got {}", mesh.positions.size(), mesh.colors.size()));
  if (!mesh.face_materials.empty() && mesh.face_materials.size() != mesh.faces.size())
    refuse(fmt::format("face materials: expected {}, got {}", mesh.faces.size(), mesh.face_materials.size()));
  if (!materials.empty())
    for (const std::uint32_t m : mesh.face_materials)
      if (m >= materials.size()) refuse(fmt::format("face material: expected below {}, got {}", materials.size(), m));
  for (const Vec3f& p : mesh.positions)
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) refuse("expected finite positions");
  for (const Vec4f& c : mesh.colors)
    for (int k = 0; k < 4; ++k)
      if (!(c[k] >= 0 && c[k] <= 1)) refuse(fmt::format("colours: expected 0 to 1, got {}", c[k]));
  for (const Wedge& w : mesh.wedges)
    if (!std::isfinite(w.uv.x) || !std::isfinite(w.uv.y)) refuse("expected finite texture coordinates");
  for (const Wedge& w : mesh.wedges)
    if (w.vertex.index >= mesh.positions.size())
      refuse(fmt::format("wedge: vertex expected below {}, got {}", mesh.positions.size(), w.vertex.index));
  for (const auto& f : mesh.faces)
    for (const WedgeId w : f)
      if (w.index >= mesh.wedges.size()) refuse(fmt::format("face: wedge expected below {}, got {}", mesh.wedges.size(), w.index));
}

}  // namespace

LoadedModel read_mesh(const fs::path& path, std::uint64_t work_bytes_per_face) {
  const std::string extension = lower_extension(path);
  MeshFormat expected = MeshFormat::obj;
  if (extension == ".ply")
    expected = MeshFormat::ply;
  else if (extension == ".glb" || extension == ".gltf")
    expected = MeshFormat::gltf;
  else if (extension == ".stl")
    expected = MeshFormat::stl;
  else if (extension != ".obj")
    fail_file(path.string(), fmt::format("mesh format: expected .obj, .ply, .stl, .glb or .gltf, got '{}'", printable(extension)));
  const FileBytes content = read_file(path);
  const MeshFormat format = format_of(content.text(), expected);
  LoadedModel model;
  switch (format) {
    case MeshFormat::obj: model = read_obj(path, content, work_bytes_per_face); break;
    case MeshFormat::ply: model = read_ply(path, content, {}, work_bytes_per_face); break;
    case MeshFormat::gltf: model = read_gltf(path, content, work_bytes_per_face); break;
    case MeshFormat::stl: model = read_stl(path, content, work_bytes_per_face); break;
  }
  if (format != expected)
    model.notes.insert(model.notes.begin(), fmt::format("{}: read as {}, which is what the file holds", path.filename().string(),
                                                        format == MeshFormat::ply ? "PLY" : "GLB"));
  return model;
}

Image load_texture(const Material& material) {
  if (!material.texture.empty()) return material.texture;
  if (material.texture_path) return read_image(*material.texture_path);
  return {};
}

void flip_v(Mesh& mesh) {
  for (Wedge& w : mesh.wedges) w.uv.y = 1.0f - w.uv.y;
}

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }, ' ');
  // A '\' at the end would join the next line.
  if (!text.empty() && text.back() == '\\') text += ' ';
  return text;
}

void write_mesh(const fs::path& path, const Mesh& mesh, const std::vector<Material>& materials, const std::string& credit) {
  const std::string extension = lower_extension(path);
  if (extension != ".obj" && extension != ".ply" && extension != ".glb")
    throw WriteError(
        fmt::format("{}: cannot write: mesh format: expected .obj, .ply or .glb, got '{}'", path.string(), printable(extension)));
  check_mesh(path, mesh, materials);
  if (extension == ".obj") return write_obj(path, mesh, materials, one_line(credit));
  if (extension == ".ply") return write_ply(path, mesh, materials, one_line(credit));
  write_glb(path, mesh, materials, one_line(credit));
}

std::vector<fs::path> mesh_output_files(const fs::path& path, const std::vector<Material>& materials) {
  std::vector<fs::path> files{path};
  const std::string extension = lower_extension(path);
  if (extension == ".obj" && !materials.empty()) files.push_back(fs::path(path).replace_extension(".mtl"));
  if (extension == ".obj" || extension == ".ply")
    for (const std::string& name : embedded_texture_names(path, materials))
      if (!name.empty()) files.push_back(path.parent_path() / name);
  return files;
}

std::vector<TextureFile> texture_files(const fs::path& model_path, const std::vector<Material>& materials) {
  std::vector<TextureFile> result(materials.size());
  const std::vector<std::string> names = embedded_texture_names(model_path, materials);
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const Material& m = materials[i];
    if (!m.texture.empty()) {
      result[i] = {names[i], encode_png(m.texture, model_path.string())};
    } else if (m.texture_path) {
      const fs::path folder = fs::absolute(model_path).parent_path();
      result[i].name = fs::proximate(fs::absolute(*m.texture_path), folder).generic_string();
    }
  }
  return result;
}

}  // namespace etalon::io
