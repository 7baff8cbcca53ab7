// A robed figure in veined marble with gilded hems, on a plinth; as large as the Ari of [Kim, Choi & Lee 2008, table 1] and beyond.
#pragma once

#include "core/mesh/mesh.h"
#include "core/procedural/iso_mesh.h"

namespace etalon::procedural {

struct StatueOptions {
  int faces = 200'000;  ///< even, 40,000 to 10,000,000; 2,351,302 has the 1,175,653 vertices of the paper's Ari
  ProcedureProgress progress;
};

/// Closed, manifold, genus 0; looks toward +Z, +Y up; about 4.4 units tall. Vertex colours: veins, gold patterns and inlay are colour, not form.
/// InputError where an option is out of range.
[[nodiscard]] Mesh make_statue(const StatueOptions& options = {});

}  // namespace etalon::procedural
