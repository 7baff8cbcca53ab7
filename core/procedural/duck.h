// A painted wooden duck with vertex colours, of the sizes that two papers give their ducks; whole, or with the hole that a scanner leaves
// where it cannot look.
#pragma once

#include "core/mesh/mesh.h"
#include "core/procedural/iso_mesh.h"

namespace etalon::procedural {

struct DuckOptions {
  int rings = 259;     ///< from the tip of the bill to the tail, 24 to 8,000
  int segments = 321;  ///< vertices of a ring, 24 to 8,000
  int hole_rings = 0;  ///< quads of the rectangle left out under the belly, along and around; both 0: closed. Else at least 2 and at most a
  int hole_segments = 0;  ///< quarter of the rings and of the segments; one more triangle is left out at its rim
  ProcedureProgress progress;
};

/// Closed: 259 rings × 321 segments and 2 poles, 83,141 vertices and 166,278 faces. Open: 50,052 vertices and 99,997 faces, one boundary
/// loop of 105 edges, the size of the Wood Duck of [Kim, Choi & Lee 2008, table 1].
[[nodiscard]] DuckOptions duck_of_paper(bool open);
/// About `faces` triangles in the same proportions: 2,000 to 10,000,000, else InputError.
[[nodiscard]] DuckOptions duck_of_faces(int faces, bool open);

/// A drake of the wood duck as decoy carvers paint it: manifold, genus 0, looks toward +Z, +Y up, about 2.9 units long; 2·rings·segments faces
/// when closed. The plumage is drawn in colours, not in form. Equal bytes for any thread count. InputError where an option is out of range.
[[nodiscard]] Mesh make_duck(const DuckOptions& options = {});

}  // namespace etalon::procedural
