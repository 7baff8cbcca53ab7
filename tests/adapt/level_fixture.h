// Models and their levels, made once for all tests.
#pragma once

#include "core/adapt/adapt_sequence.h"
#include "core/procedural/model.h"

namespace etalon::test {

/// A model with the levels that qem5 gives it, and their cells.
struct ModelLevels {
  procedural::Model model;
  progressive::ProgressiveMesh mesh;
  adapt::AdaptSequence sequence;
  ModelLevels(procedural::Model input, std::size_t base_faces, simplify::CollapseKind collapse = simplify::CollapseKind::half);
};

/// The paper's swirl (Figure 15): 7,688 faces down to 399; the texture is 512².
[[nodiscard]] ModelLevels& swirl();
/// The procedural head, 7,684 faces down to 499, with seams; the texture is 1024². Made at the first call, as the swirl is.
[[nodiscard]] ModelLevels& head();

}  // namespace etalon::test
