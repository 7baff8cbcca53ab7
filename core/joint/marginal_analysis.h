// Marginal analysis [Horbelt, Balmelli & Vetterli, section 3]: from the finest pair down (pruning), or from the coarsest up (growing), always the
// step of mesh or texture that pays best, judged by the error of the two or three pairs it could lead to.
#pragma once

#include <cstdint>

#include "core/joint/problem.h"

namespace etalon::joint {

/// Which step pays best. Ties: the mesh's.
enum class StepRule : std::uint8_t {
  /// Least rise of error per bit removed (growing: greatest fall per bit added), ΔD₁·Δb₂ against ΔD₂·Δb₁ in signed 128-bit integers; so a step
  /// that does not raise the error goes before any that does. What "moving bits from mesh to texture" (section 2.3) asks for.
  slope,
  /// Least error, whatever the step costs in bits: the loop as printed. The same as slope only where all steps have as many bits.
  printed,
  /// "given a target complexity reduction of B bits, the best of reducing the mesh or the texture description by B bits is chosen (or possibly,
  /// reducing both by B/2)": whole levels until B (both: B/2 each) bits are reached or none is left, compared by slope.
  budget,
};

enum class Direction : std::uint8_t { prune, grow };

struct SearchOptions {
  StepRule rule = StepRule::slope;
  Direction direction = Direction::prune;
  /// B of rule `budget`; 0: the difference of largest and smallest pair, divided by the number of levels of both.
  std::uint64_t budget_bits = 0;
};

/// The path from the largest pair to the smallest, in rising order of bits whatever the direction. When only one of the two has levels left the path
/// goes on along that border without evaluating anything (the paper stops there): so that a stream in the path's order is complete.
/// slope, printed: at most 2·(N + M) evaluations where N + 1 meshes and M + 1 textures differ. InputError: validate() refuses.
[[nodiscard]] Path marginal_analysis(const Problem& problem, const SearchOptions& options = {});

/// One after the other, without evaluations: the whole texture goes before the mesh loses a level, or the other way round.
enum class OneSided : std::uint8_t { texture_pruned_first, mesh_pruned_first };
[[nodiscard]] Path one_sided_path(const Problem& problem, OneSided order);

/// As if mesh and texture did not interact: pruning by slope where the rise of error of a mesh's step is the one beside the finest texture, and the
/// other way round (N + M + 1 evaluations). The points carry only the errors that were evaluated.
[[nodiscard]] Path independent_path(const Problem& problem);

}  // namespace etalon::joint
