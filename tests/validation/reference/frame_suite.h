// Whole frames of overlapping triangles: every target of every texel after visibility, and the same bytes from any number of threads.
#pragma once

#include "core/draw/renderer.h"
#include "tests/validation/reference/tally.h"

namespace etalon::validation::reference {

struct FrameOptions {
  std::uint64_t first_seed = 1;
  std::uint64_t frames = 1;
  int width = 24;
  int height = 24;
  int triangle_count = 30;
};

/// Each frame drawn by the renderer and judged texel by texel.
[[nodiscard]] Tally run_frames(const FrameOptions& options, Renderer& renderer);

/// Each frame drawn with 1, 2 and 7 threads: `values` counts texels of targets compared with those of one thread.
/// Leaves the thread count at its default.
[[nodiscard]] Tally run_threads(const FrameOptions& options, Renderer& renderer);

}  // namespace etalon::validation::reference
