#include "core/joint/error_table.h"

#include <string>

#include "core/base/error.h"

namespace etalon::joint {

ErrorTable::ErrorTable(const Problem& problem)
    : problem_(problem),
      errors_(problem.mesh_bits.size() * problem.texture_bits.size()),
      known_(problem.mesh_bits.size() * problem.texture_bits.size()) {}

std::uint64_t ErrorTable::at(Pair pair) {
  const std::size_t n = index(pair);
  if (known_[n] == 0) {
    errors_[n] = problem_.error(pair.mesh, pair.texture);
    ETALON_CHECK(errors_[n] < std::uint64_t{1} << 62, std::to_string(errors_[n]));
    known_[n] = 1;
    ++evaluations_;
  }
  return errors_[n];
}

}  // namespace etalon::joint
