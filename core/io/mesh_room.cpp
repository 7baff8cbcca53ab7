#include "core/io/mesh_room.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/memory_limit.h"
#include "core/io/triangle_soup.h"

namespace etalon::io {

std::uint64_t mesh_need_bytes(const MeshCounts& counts, std::uint64_t file_bytes, std::uint64_t work_bytes_per_face) {
  const std::uint64_t vertex_bytes = sizeof(Vec3f) + (counts.has_colors ? sizeof(Vec4f) : 0);
  const std::uint64_t mesh = counts.vertices * (vertex_bytes + sizeof(Wedge)) + counts.faces * 3 * sizeof(WedgeId);
  // to_mesh() moves positions and colours and copies the rest.
  const std::uint64_t soup_face_bytes = 3 * (sizeof(std::uint32_t) + (counts.has_corner_uvs ? sizeof(Vec2f) : 0));
  const std::uint64_t soup = counts.vertices * (counts.has_vertex_uvs ? sizeof(Vec2f) : 0) + counts.faces * soup_face_bytes;
  return mesh + std::max(file_bytes + soup, counts.faces * work_bytes_per_face);
}

void require_room(const std::filesystem::path& path, const MeshCounts& counts, std::uint64_t file_bytes, std::uint64_t work_bytes_per_face,
                  std::uint64_t held_bytes) {
  const std::uint64_t need = mesh_need_bytes(counts, file_bytes, work_bytes_per_face);
  require_memory(fmt::format("{}: {} triangles, {} vertices", path.string(), counts.faces, counts.vertices),
                 need > file_bytes + held_bytes ? need - file_bytes - held_bytes : 0);
}

}  // namespace etalon::io
