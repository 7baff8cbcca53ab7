// Every ordered triangle on a small lattice: 13 × 13 points of 2 sub-texel bits over 3 × 3 texels, so vertices lie on the corners, the
// centres and the quarters of texels, edges pass through samples in every way they can, and a third of the triangles has no area.
#pragma once

#include "core/draw/state.h"
#include "tests/validation/reference/subject.h"
#include "tests/validation/reference/tally.h"

namespace etalon::validation::reference {

inline constexpr int kLatticeSide = 13;
inline constexpr int kLatticePoints = kLatticeSide * kLatticeSide;  ///< 169³ = 4,826,809 ordered triangles

struct LatticeOptions {
  int first_point = 0;  ///< index of the first vertex: blocks are ranges of it
  int point_count = kLatticePoints;
  FillRule fill_rule = FillRule::left_ymin;
  int one_triangle_in = 1;  ///< 1: all; n: a seeded share of 1 / n
  int one_value_in = 100;   ///< of the triangles compared, the share whose target bytes are compared too
};

/// Coverage of all 9 samples of each triangle, values of some.
[[nodiscard]] Tally run_lattice(const LatticeOptions& options, const MakeSubject& make_subject);

}  // namespace etalon::validation::reference
