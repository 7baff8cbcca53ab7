// What one sample of one triangle stores into every target. Each number is first enclosed in doubles; where that cannot decide, the
// same number is formed from wide integers. Both ways give the same bytes: that is what the tests of this file are about.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/draw/draw_list.h"
#include "raster/storage.h"
#include "raster/triangle_setup.h"

namespace etalon::raster {

/// How values are found; the bytes do not depend on it.
enum class Evaluation : std::uint8_t {
  vectorised,  ///< raster/fast: planes with bounds in vectors of doubles; where those cannot decide, as `filtered`
  filtered,    ///< double enclosures first, wide integers where they cannot decide
  exact,  ///< wide integers for every stored value and texel choice: a second opinion on the enclosures (not on depth and edge distance)
};

/// How often the enclosures decided; sums over tiles are exact integers, so they too are the same for every thread count.
struct EvaluationCounters {
  std::uint64_t values = 0;      ///< numbers stored or decided (a texel choice counts as one per axis)
  std::uint64_t scalar = 0;      ///< of these, not decided by the vector kernels (all of them where there are none: `filtered`)
  std::uint64_t narrow = 0;      ///< of these, decided by 128-bit integers: most true ties (narrow_split.h)
  std::uint64_t exact_path = 0;  ///< of these, decided by wide integers: the last resort
  EvaluationCounters& operator+=(const EvaluationCounters& o) {
    values += o.values, scalar += o.scalar, narrow += o.narrow, exact_path += o.exact_path;
    return *this;
  }
};

/// The depths a sample knows from the visibility pass.
struct SampleDepth {
  float stored = 1;
  float gap = 0;  ///< to the runner-up; +inf where there is none
};

/// Writes texel (i, j) of one target of the frame for a triangle that covers it.
void store_target(const DrawList& list, const Draw& draw, const Frame& frame, const TargetSpec& target, const TriangleSetup& setup,
                  std::uint32_t triangle, int i, int j, SampleDepth depth, Evaluation evaluation, std::byte* texel,
                  EvaluationCounters& counters);

/// The same for every target. `texels[n]`: first byte of the texel in target n.
void store_sample(const DrawList& list, const Draw& draw, const Frame& frame, const TriangleSetup& setup, std::uint32_t triangle, int i,
                  int j, SampleDepth depth, Evaluation evaluation, std::byte* const* texels, EvaluationCounters& counters);

/// Writes what a texel without any triangle holds.
void store_clear(const Frame& frame, std::byte* const* texels);

}  // namespace etalon::raster
