// The readers and writers behind read_mesh and write_mesh, one pair per format; not for use outside core/io.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/io/inputs.h"
#include "core/io/mesh_file.h"

namespace etalon::io {

/// `path` names the file in messages and the folder in which the files that it names are looked for; `work_bytes_per_face` as of read_mesh.
[[nodiscard]] LoadedModel read_obj(const std::filesystem::path& path, const FileBytes& content, std::uint64_t work_bytes_per_face = 0);
/// `max_jump`: of range grids (range_grid.h).
[[nodiscard]] LoadedModel read_ply(const std::filesystem::path& path, const FileBytes& content, std::optional<double> max_jump = {},
                                   std::uint64_t work_bytes_per_face = 0);
[[nodiscard]] LoadedModel read_stl(const std::filesystem::path& path, const FileBytes& content, std::uint64_t work_bytes_per_face = 0);
[[nodiscard]] LoadedModel read_gltf(const std::filesystem::path& path, const FileBytes& content, std::uint64_t work_bytes_per_face = 0);

/// `credit`: one line, or empty.
void write_obj(const std::filesystem::path& path, const Mesh& mesh, const std::vector<Material>& materials, const std::string& credit);
void write_ply(const std::filesystem::path& path, const Mesh& mesh, const std::vector<Material>& materials, const std::string& credit);
void write_glb(const std::filesystem::path& path, const Mesh& mesh, const std::vector<Material>& materials, const std::string& credit);

/// Control characters become blanks.
[[nodiscard]] std::string one_line(std::string text);

/// The colour textures (map_Kd) of a material library, by material name; an empty path for a material without. Unknown statements are skipped.
[[nodiscard]] std::map<std::string, std::filesystem::path> read_mtl(const std::filesystem::path& path);

/// The existing regular file that a model in `folder` means by `name`: quotes taken off, as written, with '\' as '/', or its last part in
/// the folder itself; an empty path where there is none.
[[nodiscard]] std::filesystem::path find_beside(const std::filesystem::path& folder, std::string_view name);

/// Where the texture of material `index` goes and what is written for it; used by the writers of formats that name texture files.
struct TextureFile {
  std::string name;     ///< as written into the model file; empty: no texture
  std::string content;  ///< PNG bytes to be written as `name` beside the model; empty: the file exists already
};
/// Whether every colour is exactly i/255 (float32 division): then 8-bit colours lose nothing.
[[nodiscard]] bool colors_are_bytes(const Mesh& mesh);
/// The nearest i of i/255.
[[nodiscard]] std::uint8_t color_byte(float value);

[[nodiscard]] std::vector<TextureFile> texture_files(const std::filesystem::path& model_path, const std::vector<Material>& materials);

}  // namespace etalon::io
