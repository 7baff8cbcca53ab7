#include "core/io/triangle_soup.h"

#include <bit>
#include <cstddef>
#include <map>
#include <utility>

namespace etalon::io {
namespace {

/// Finds the wedge of a vertex with a given uv, or makes it. A vertex has few wedges, so a list per vertex is searched; whatever exceeds a
/// short list (the pole of a sphere) goes to a map, or a file could make the search quadratic.
class WedgeFinder {
 public:
  explicit WedgeFinder(Mesh& mesh) : mesh_(mesh), newest_of_(mesh.positions.size(), kNone) {}

  WedgeId find_or_make(std::uint32_t vertex, Vec2f uv) {
    int step_count = 0;
    for (std::uint32_t w = newest_of_[vertex]; w != kNone; w = older_[w], ++step_count)
      if (mesh_.wedges[w].uv == uv) return WedgeId(w);
    if (step_count < kLongestList) {
      older_.resize(mesh_.wedges.size(), kNone);
      older_.push_back(newest_of_[vertex]);
      newest_of_[vertex] = next_number();
      return make(vertex, uv);
    }
    const auto [known, is_new] = others_.try_emplace({vertex, key_bits(uv.x), key_bits(uv.y)}, next_number());
    return is_new ? make(vertex, uv) : WedgeId(known->second);
  }

 private:
  static constexpr std::uint32_t kNone = WedgeId::kInvalid;
  static constexpr int kLongestList = 16;

  // Equal bits exactly where the finite floats compare equal.
  static std::uint32_t key_bits(float value) { return value == 0 ? 0u : std::bit_cast<std::uint32_t>(value); }

  [[nodiscard]] std::uint32_t next_number() const { return static_cast<std::uint32_t>(mesh_.wedges.size()); }

  WedgeId make(std::uint32_t vertex, Vec2f uv) {
    mesh_.wedges.push_back({VertexId(vertex), uv});
    return WedgeId(mesh_.wedges.size() - 1);
  }
  Mesh& mesh_;
  std::vector<std::uint32_t> newest_of_;  // for each vertex
  std::vector<std::uint32_t> older_;      // for each wedge: the one before it in its vertex's list
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> others_;
};

}  // namespace

Mesh to_mesh(TriangleSoup&& soup) {
  Mesh mesh;
  mesh.positions = std::move(soup.positions);
  mesh.colors = std::move(soup.colors);
  mesh.face_materials = std::move(soup.face_materials);
  mesh.faces.reserve(soup.faces.size());
  mesh.has_uv = !soup.vertex_uvs.empty() || !soup.corner_uvs.empty();
  if (soup.corner_uvs.empty()) {
    mesh.wedges.reserve(mesh.positions.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
      mesh.wedges.push_back({VertexId(v), mesh.has_uv ? soup.vertex_uvs[v] : Vec2f(0)});
    for (const auto& f : soup.faces) mesh.faces.push_back({WedgeId(f[0]), WedgeId(f[1]), WedgeId(f[2])});
    return mesh;
  }
  WedgeFinder finder(mesh);
  for (std::size_t f = 0; f < soup.faces.size(); ++f) {
    std::array<WedgeId, 3> face;
    for (int corner = 0; corner < 3; ++corner) face[corner] = finder.find_or_make(soup.faces[f][corner], soup.corner_uvs[f][corner]);
    mesh.faces.push_back(face);
  }
  return mesh;
}

}  // namespace etalon::io
