#include "tests/validation/reference/tally.h"

#include <fmt/format.h>

namespace etalon::validation::reference {

Tally& Tally::operator+=(const Tally& other) {
  triangles += other.triangles, samples += other.samples, covered += other.covered, edge_ties += other.edge_ties;
  values += other.values, texel_ties += other.texel_ties, mismatches += other.mismatches;
  if (first_mismatch.empty()) first_mismatch = other.first_mismatch;
  return *this;
}

void Tally::mismatch(const std::string& words) {
  if (mismatches++ == 0) first_mismatch = words;
}

std::string to_string(const Tally& t) {
  return fmt::format("{} triangles, {} samples, {} covered, {} on edges, {} values, {} on texel borders: {} mismatches{}{}", t.triangles,
                     t.samples, t.covered, t.edge_ties, t.values, t.texel_ties, t.mismatches,
                     t.mismatches == 0 ? "" : "; first: ", t.first_mismatch);
}

}  // namespace etalon::validation::reference
