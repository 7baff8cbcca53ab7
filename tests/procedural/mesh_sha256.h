// The bytes of a mesh as one hash, for goldens.
#pragma once

#include <string>

#include "core/base/sha256.h"
#include "core/mesh/mesh.h"

namespace etalon::test {

inline std::string mesh_sha256(const Mesh& mesh) {
  static_assert(sizeof(Vec3f) == 12 && sizeof(Wedge) == 12 && sizeof(mesh.faces[0]) == 12, "no padding is hashed");
  Sha256 hash;
  hash.update(mesh.positions.data(), mesh.positions.size() * sizeof(Vec3f));
  hash.update(mesh.wedges.data(), mesh.wedges.size() * sizeof(Wedge));
  hash.update(mesh.faces.data(), mesh.faces.size() * 12);
  return hash.hex();
}

}  // namespace etalon::test
