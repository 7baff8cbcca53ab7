// PLY, binary little-endian: corner coordinates as the face list `texcoord` with `texnumber` and `comment TextureFile`, as MeshLab has them,
// so that a seam need not split its vertices.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "core/io/atomic_file.h"
#include "core/io/mesh_formats.h"

namespace etalon::io {
namespace {

namespace fs = std::filesystem;

template <class T>
void append(std::string& out, T value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  out.append(bytes, sizeof value);
}

}  // namespace

bool colors_are_bytes(const Mesh& mesh) {
  return std::all_of(mesh.colors.begin(), mesh.colors.end(), [](const Vec4f& c) {
    for (int k = 0; k < 4; ++k)
      if (static_cast<float>(color_byte(c[k])) / 255.0f != c[k]) return false;
    return true;
  });
}

std::uint8_t color_byte(float value) { return static_cast<std::uint8_t>(std::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f); }

void write_ply(const fs::path& path, const Mesh& mesh, const std::vector<Material>& materials, const std::string& credit) {
  static_assert(std::endian::native == std::endian::little);
  const bool has_color = !mesh.colors.empty();
  const bool has_alpha = std::any_of(mesh.colors.begin(), mesh.colors.end(), [](const Vec4f& c) { return c.w != 1; });
  const bool bytes = colors_are_bytes(mesh);
  const std::vector<TextureFile> textures = texture_files(path, materials);
  std::vector<std::int32_t> texture_numbers;  // of each material; -1: none
  std::vector<std::pair<fs::path, std::string>> files;

  std::string out = "ply\nformat binary_little_endian 1.0\n";
  if (!credit.empty()) out += fmt::format("comment credit: {}\n", credit);
  std::int32_t texture_count = 0;
  for (const TextureFile& t : textures) {
    texture_numbers.push_back(t.name.empty() ? -1 : texture_count++);
    if (!t.name.empty()) out += fmt::format("comment TextureFile {}\n", t.name);
    if (!t.content.empty()) files.emplace_back(path.parent_path() / t.name, t.content);
  }
  out += fmt::format("element vertex {}\nproperty float x\nproperty float y\nproperty float z\n", mesh.positions.size());
  const char* const color_type = bytes ? "uchar" : "float";
  if (has_color) out += fmt::format("property {0} red\nproperty {0} green\nproperty {0} blue\n", color_type);
  if (has_alpha) out += fmt::format("property {} alpha\n", color_type);
  out += fmt::format("element face {}\nproperty list uchar int vertex_indices\n", mesh.faces.size());
  if (mesh.has_uv) out += "property list uchar float texcoord\n";
  if (texture_count != 0) out += "property int texnumber\n";
  out += "end_header\n";

  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    for (int k = 0; k < 3; ++k) append(out, mesh.positions[v][k]);
    for (int k = 0; k < (has_color ? (has_alpha ? 4 : 3) : 0); ++k) {
      if (bytes)
        append(out, color_byte(mesh.colors[v][k]));
      else
        append(out, mesh.colors[v][k]);
    }
  }
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    append(out, std::uint8_t{3});
    for (const WedgeId w : mesh.faces[f]) append(out, mesh.wedges[w.index].vertex.index);
    if (mesh.has_uv) {
      append(out, std::uint8_t{6});
      for (const WedgeId w : mesh.faces[f]) {
        append(out, mesh.wedges[w.index].uv.x);
        append(out, mesh.wedges[w.index].uv.y);
      }
    }
    if (texture_count != 0) append(out, texture_numbers[mesh.face_materials.empty() ? 0 : mesh.face_materials[f]]);
  }
  files.emplace_back(path, std::move(out));
  write_files(files);
}

}  // namespace etalon::io
