// Whether there is room for a mesh, asked before it is parsed; not for use outside core/io.
#pragma once

#include <cstdint>
#include <filesystem>

namespace etalon::io {

/// What a file says, or shows at a glance, that it holds; never more than it does.
struct MeshCounts {
  std::uint64_t vertices = 0, faces = 0;
  bool has_colors = false, has_vertex_uvs = false, has_corner_uvs = false;
};

/// The least that reading holds at once (the file, a TriangleSoup, the mesh made of it), or afterwards the mesh with
/// `work_bytes_per_face` for the work on it.
[[nodiscard]] std::uint64_t mesh_need_bytes(const MeshCounts& counts, std::uint64_t file_bytes, std::uint64_t work_bytes_per_face);

/// InputError that states the need where a limit on this process (core/base/memory_limit.h) leaves less; of the need the file and
/// `held_bytes` are there already.
void require_room(const std::filesystem::path& path, const MeshCounts& counts, std::uint64_t file_bytes, std::uint64_t work_bytes_per_face,
                  std::uint64_t held_bytes = 0);

}  // namespace etalon::io
