// A closed mesh of an implicit surface with exactly as many triangles as asked for, evenly spread, as from a scanner.
#pragma once

#include "core/procedural/iso_lattice.h"

namespace etalon::procedural {

/// Called with how many of `total` steps are done; may be empty.
using ProcedureProgress = std::function<void(int done, int total)>;

struct IsoMeshOptions {
  IsoLattice lattice;        ///< its spacing is chosen here
  std::size_t faces = 0;     ///< even, at least 1,000
  int relaxation_steps = 8;  ///< each vertex toward the mean of its neighbours, along the surface, then back to it
  ProcedureProgress progress;
};

/// Marching tetrahedra at the spacing that gives a little fewer vertices than faces/2 + 2, the longest edges halved until there are as many,
/// then relaxation. Of genus 0 where the field's surface is and is not thinner than a few spacings: then the face count is exact.
/// Equal bytes for any thread count. InputError for an odd or too small count, and where the surface is of another genus at this size.
[[nodiscard]] IsoTriangles make_iso_mesh(const IsoMeshOptions& options);

}  // namespace etalon::procedural
