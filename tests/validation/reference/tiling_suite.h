// Shared edges: in a mesh that tiles the frame each sample is covered exactly once, under every fill rule.
#pragma once

#include <functional>
#include <memory>

#include "core/draw/renderer.h"
#include "tests/validation/reference/tally.h"

namespace etalon::validation::reference {

struct TilingOptions {
  std::uint64_t first_seed = 1;
  std::uint64_t seeds = 1;  ///< each: one mesh of every kind, drawn under each of the four fill rules
  int size = 512;           ///< frame of size × size texels
};

/// Draws without depth test in the list's order and in reverse order. The last triangle that covers a sample is seen in the one, the
/// first in the other: covered exactly once means that both are there and the same. `samples` counts each texel once per fill rule.
[[nodiscard]] Tally run_tilings(const TilingOptions& options, Renderer& renderer);

}  // namespace etalon::validation::reference
