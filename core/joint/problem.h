// The joint problem of [Horbelt, Balmelli & Vetterli, section 1]: meshes and textures in levels of rising cost, and the error of each pair.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace etalon::joint {

/// Levels of mesh and texture, coarsest first, with their cost in bits: C_M and C_T of equation 2. A level of as many bits as the one before it
/// is the same level (streams are progressive): searches pass over it.
struct Problem {
  std::vector<std::uint64_t> mesh_bits;     ///< N + 1, at least one, ascending; sums with texture_bits below 2^63
  std::vector<std::uint64_t> texture_bits;  ///< M + 1
  /// D(M_i, T_j): an integer, say the sum of squared differences of a picture's bytes, below 2^62. Called from one thread.
  std::function<std::uint64_t(std::size_t mesh, std::size_t texture)> error;
  /// The same of one mesh with every texture, coarsest first, where that is faster than one by one; may be empty.
  std::function<std::vector<std::uint64_t>(std::size_t mesh)> errors_of_mesh;

  [[nodiscard]] std::uint64_t bits(std::size_t mesh, std::size_t texture) const { return mesh_bits[mesh] + texture_bits[texture]; }
};

/// InputError: no levels, bits that descend or are too many, no error.
void validate(const Problem& problem);

/// Indices of the levels that differ from their finer neighbour in bits; of equal ones the finest. Ascending, the last level among them.
[[nodiscard]] std::vector<std::size_t> distinct_levels(const std::vector<std::uint64_t>& bits);

struct Pair {
  std::size_t mesh = 0, texture = 0;
  friend bool operator==(const Pair&, const Pair&) = default;
};

/// A pair on a path. No error where it was stored without being evaluated.
struct PathPoint {
  Pair pair;
  std::uint64_t bits = 0;
  std::optional<std::uint64_t> error;
  friend bool operator==(const PathPoint&, const PathPoint&) = default;
};

/// Each pair differs from the one before it in one level of mesh or texture, or (rule `budget`) in several of both.
struct Path {
  std::vector<PathPoint> points;  ///< smallest pair first, largest last
  std::size_t evaluations = 0;    ///< pairs whose error was asked for; none is asked for twice
};

}  // namespace etalon::joint
