#include "core/joint/problem.h"

#include <fmt/format.h>

#include "core/base/error.h"

namespace etalon::joint {
namespace {

void validate_levels(const std::vector<std::uint64_t>& bits, const char* what) {
  if (bits.empty()) throw InputError(fmt::format("joint: expected at least one {} level", what));
  for (std::size_t n = 0; n < bits.size(); ++n) {
    if (n > 0 && bits[n] < bits[n - 1])
      throw InputError(fmt::format("joint: {} levels must ascend in bits, got {} after {}", what, bits[n], bits[n - 1]));
    if (bits[n] >= std::uint64_t{1} << 62)
      throw InputError(fmt::format("joint: {} level {} of {} bits, expected below 2^62", what, n, bits[n]));
  }
}

}  // namespace

void validate(const Problem& problem) {
  validate_levels(problem.mesh_bits, "mesh");
  validate_levels(problem.texture_bits, "texture");
  if (!problem.error) throw InputError("joint: expected a function for the error of a pair");
}

std::vector<std::size_t> distinct_levels(const std::vector<std::uint64_t>& bits) {
  std::vector<std::size_t> levels;
  for (std::size_t n = 0; n < bits.size(); ++n)
    if (n + 1 == bits.size() || bits[n + 1] != bits[n]) levels.push_back(n);
  return levels;
}

}  // namespace etalon::joint
