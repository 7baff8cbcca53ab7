// Isolated samples of random triangles, the subject against the judge: coverage and the bytes of every target.
#pragma once

#include "tests/validation/reference/subject.h"
#include "tests/validation/reference/tally.h"

namespace etalon::validation::reference {

inline constexpr int kTrianglesPerBlock = 32;

struct MassOptions {
  std::uint64_t first_seed = 1;  ///< block n is random_block(first_seed + n, kTrianglesPerBlock): any range can be run again alone
  std::uint64_t blocks = 1;
  int samples_per_triangle = 64;  ///< all samples of a box that has no more, else half near the edges, half in the box
};

[[nodiscard]] Tally run_mass(const MassOptions& options, const MakeSubject& make_subject);

}  // namespace etalon::validation::reference
