#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>

#include "core/io/atomic_file.h"
#include "core/io/mesh_formats.h"

namespace etalon::io {
namespace {

namespace fs = std::filesystem;

/// Names as usemtl can carry them: not empty, one line, no blanks at the ends, all different.
std::vector<std::string> material_names(const std::vector<Material>& materials) {
  std::vector<std::string> result;
  std::set<std::string> taken;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    std::string name = materials[i].name;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, '_');
    const std::size_t first = name.find_first_not_of(' ');
    name = first == name.npos ? fmt::format("material_{}", i) : name.substr(first, name.find_last_not_of(' ') - first + 1);
    // A '\' at the end would join the next line.
    if (name.back() == '\\') name.back() = '_';
    while (!taken.insert(name).second) name += fmt::format("_{}", i);
    result.push_back(name);
  }
  return result;
}

std::string obj_text(const Mesh& mesh, const std::vector<std::string>& names, const std::string& mtl_name, const std::string& credit) {
  fmt::memory_buffer out;
  const auto end = std::back_inserter(out);
  if (!credit.empty()) fmt::format_to(end, "# credit: {}\n", credit);
  if (!names.empty()) fmt::format_to(end, "mtllib {}\n", mtl_name);
  const bool has_alpha = std::any_of(mesh.colors.begin(), mesh.colors.end(), [](const Vec4f& c) { return c.w != 1; });
  // "{}" is the shortest decimal number that reads back as the same float.
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3f& p = mesh.positions[v];
    fmt::format_to(end, "v {} {} {}", p.x, p.y, p.z);
    if (!mesh.colors.empty()) fmt::format_to(end, " {} {} {}", mesh.colors[v].x, mesh.colors[v].y, mesh.colors[v].z);
    if (has_alpha) fmt::format_to(end, " {}", mesh.colors[v].w);
    out.push_back('\n');
  }
  if (mesh.has_uv)
    for (const Wedge& w : mesh.wedges) fmt::format_to(end, "vt {} {}\n", w.uv.x, w.uv.y);
  std::uint32_t current = WedgeId::kInvalid;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const std::uint32_t material = mesh.face_materials.empty() ? 0 : mesh.face_materials[f];
    if (!names.empty() && material != current) {
      fmt::format_to(end, "usemtl {}\n", names[material]);
      current = material;
    }
    out.push_back('f');
    for (int k = 0; k < 3; ++k) {
      const WedgeId w = mesh.faces[f][k];
      const std::uint32_t v = mesh.wedges[w.index].vertex.index;
      if (mesh.has_uv)
        fmt::format_to(end, " {}/{}", v + 1, w.index + 1);
      else
        fmt::format_to(end, " {}", v + 1);
    }
    out.push_back('\n');
  }
  return fmt::to_string(out);
}

}  // namespace

void write_obj(const fs::path& path, const Mesh& mesh, const std::vector<Material>& materials, const std::string& credit) {
  const std::vector<std::string> names = material_names(materials);
  const std::vector<TextureFile> textures = texture_files(path, materials);
  const fs::path mtl_path = fs::path(path).replace_extension(".mtl");
  std::vector<std::pair<fs::path, std::string>> files;
  std::string mtl;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    mtl += fmt::format("newmtl {}\nKd 1 1 1\n", names[i]);
    if (!textures[i].name.empty()) mtl += fmt::format("map_Kd {}\n", textures[i].name);
    if (!textures[i].content.empty()) files.emplace_back(path.parent_path() / textures[i].name, textures[i].content);
  }
  if (!materials.empty()) files.emplace_back(mtl_path, mtl);
  files.emplace_back(path, obj_text(mesh, names, mtl_path.filename().string(), credit));
  write_files(files);
}

}  // namespace etalon::io
