#include "core/mesh/weld.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>

#include "core/base/error.h"
#include "core/base/index_table.h"

namespace etalon {

namespace {

std::uint32_t bits_of(float x) { return x == 0 ? 0u : std::bit_cast<std::uint32_t>(x); }

/// For each key the index, in order of first appearance, of the class of equal keys it belongs to; and each class's first member.
struct Classes {
  std::vector<std::uint32_t> class_of;
  std::vector<std::uint32_t> first;
};

template <class Key>
Classes classes_of_equal(const std::vector<Key>& keys) {
  Classes result;
  result.class_of.reserve(keys.size());
  IndexTable table;
  for (std::uint32_t i = 0; i < keys.size(); ++i) {
    const auto next = static_cast<std::uint32_t>(result.first.size());
    const std::uint32_t found =
        table.find_or_add(hash_words(keys[i]), next, [&](std::uint32_t other) { return keys[result.first[other]] == keys[i]; });
    if (found == next) result.first.push_back(i);
    result.class_of.push_back(found);
  }
  return result;
}

}  // namespace

Mesh welded_by_position(const Mesh& mesh) {
  std::vector<std::array<std::uint32_t, 7>> vertex_keys(mesh.vertex_count());
  for (std::size_t v = 0; v < vertex_keys.size(); ++v) {
    for (int k = 0; k < 3; ++k) vertex_keys[v][static_cast<std::size_t>(k)] = bits_of(mesh.positions[v][k]);
    if (!mesh.colors.empty())
      for (int k = 0; k < 4; ++k) vertex_keys[v][static_cast<std::size_t>(3 + k)] = bits_of(mesh.colors[v][k]);
  }
  const Classes vertices = classes_of_equal(vertex_keys);

  std::vector<std::array<std::uint32_t, 3>> wedge_keys(mesh.wedge_count());
  for (std::size_t w = 0; w < wedge_keys.size(); ++w) {
    const Wedge& wedge = mesh.wedges[w];
    if (wedge.vertex.index >= mesh.vertex_count())
      throw InputError(fmt::format("wedge {}: vertex: expected below {}, got {}", w, mesh.vertex_count(), wedge.vertex.index));
    wedge_keys[w][0] = vertices.class_of[wedge.vertex.index];
    if (mesh.has_uv) {
      wedge_keys[w][1] = bits_of(wedge.uv.x);
      wedge_keys[w][2] = bits_of(wedge.uv.y);
    }
  }
  const Classes wedges = classes_of_equal(wedge_keys);

  Mesh result;
  result.has_uv = mesh.has_uv;
  result.face_materials = mesh.face_materials;
  for (const std::uint32_t v : vertices.first) {
    result.positions.push_back(mesh.positions[v]);
    if (!mesh.colors.empty()) result.colors.push_back(mesh.colors[v]);
  }
  for (const std::uint32_t w : wedges.first)
    result.wedges.push_back({VertexId(vertices.class_of[mesh.wedges[w].vertex.index]), mesh.wedges[w].uv});
  result.faces.reserve(mesh.face_count());
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    std::array<WedgeId, 3> face;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t w = mesh.faces[f][k].index;
      if (w >= mesh.wedge_count()) throw InputError(fmt::format("face {}: wedge: expected below {}, got {}", f, mesh.wedge_count(), w));
      face[k] = WedgeId(wedges.class_of[w]);
    }
    result.faces.push_back(face);
  }
  return result;
}

}  // namespace etalon
