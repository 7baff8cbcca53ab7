#include "core/io/triangle_soup.h"

#include <bit>
#include <cstddef>
#include <utility>

namespace etalon::io {
namespace {

/// Numbers different wedges (vertex, u, v) in order of appearance: open addressing; the numbers do not depend on the hash.
class WedgeIndex {
 public:
  using Key = std::array<std::uint32_t, 3>;

  explicit WedgeIndex(std::size_t expected) { slots_.resize(std::bit_ceil(expected * 2 + 16), kEmpty); }

  /// The number of `key`: that of an equal earlier key, else the next free one, counting from 0.
  std::uint32_t number_of(const Key& key) {
    if (keys_.size() * 2 >= slots_.size()) grow();
    std::size_t slot = hash(key) & (slots_.size() - 1);
    while (slots_[slot] != kEmpty) {
      if (keys_[slots_[slot]] == key) return slots_[slot];
      slot = (slot + 1) & (slots_.size() - 1);
    }
    slots_[slot] = static_cast<std::uint32_t>(keys_.size());
    keys_.push_back(key);
    return slots_[slot];
  }

 private:
  static constexpr std::uint32_t kEmpty = 0xFFFFFFFFu;

  static std::size_t hash(const Key& key) {
    std::uint64_t h = 0x9E3779B97F4A7C15ull;
    for (const std::uint32_t word : key) {
      h = (h ^ word) * 0xBF58476D1CE4E5B9ull;
      h ^= h >> 32;
    }
    return static_cast<std::size_t>(h);
  }
  void grow() {
    slots_.assign(slots_.size() * 2, kEmpty);
    for (std::uint32_t i = 0; i < keys_.size(); ++i) {
      std::size_t slot = hash(keys_[i]) & (slots_.size() - 1);
      while (slots_[slot] != kEmpty) slot = (slot + 1) & (slots_.size() - 1);
      slots_[slot] = i;
    }
  }
  std::vector<std::uint32_t> slots_;
  std::vector<Key> keys_;
};

// Equal bits exactly where the finite floats compare equal.
std::uint32_t key_bits(float value) { return value == 0 ? 0u : std::bit_cast<std::uint32_t>(value); }

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
  WedgeIndex index(mesh.positions.size());
  for (std::size_t f = 0; f < soup.faces.size(); ++f) {
    std::array<WedgeId, 3> face;
    for (int corner = 0; corner < 3; ++corner) {
      const std::uint32_t v = soup.faces[f][corner];
      const Vec2f uv = soup.corner_uvs[f][corner];
      const std::uint32_t w = index.number_of({v, key_bits(uv.x), key_bits(uv.y)});
      if (w == mesh.wedges.size()) mesh.wedges.push_back({VertexId(v), uv});
      face[corner] = WedgeId(w);
    }
    mesh.faces.push_back(face);
  }
  return mesh;
}

}  // namespace etalon::io
