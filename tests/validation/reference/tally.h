// What a suite saw: counts that are sums, so they do not depend on threads, and the first disagreement in words.
#pragma once

#include <cstdint>
#include <string>

namespace etalon::validation::reference {

struct Tally {
  std::uint64_t triangles = 0;
  std::uint64_t samples = 0;     ///< coverage decisions compared
  std::uint64_t covered = 0;     ///< of these, covered
  std::uint64_t edge_ties = 0;   ///< samples exactly on a triangle's border
  std::uint64_t values = 0;      ///< target texels compared
  std::uint64_t texel_ties = 0;  ///< texture coordinates exactly on a border between texels (of targets `margins`)
  std::uint64_t mismatches = 0;
  std::string first_mismatch;  ///< seed, triangle, texel, expected and got: enough to run it again

  Tally& operator+=(const Tally& other);
  void mismatch(const std::string& words);
};

/// "T triangles, S samples, C covered, …: M mismatches".
[[nodiscard]] std::string to_string(const Tally& tally);

}  // namespace etalon::validation::reference
