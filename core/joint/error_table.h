// The errors of a problem's pairs, each asked for once.
#pragma once

#include <cstdint>
#include <vector>

#include "core/joint/problem.h"

namespace etalon::joint {

class ErrorTable {
 public:
  explicit ErrorTable(const Problem& problem);

  /// Evaluates where that has not been done. InternalError for an error of 2^62 or more.
  [[nodiscard]] std::uint64_t at(Pair pair);
  [[nodiscard]] bool is_known(Pair pair) const { return known_[index(pair)] != 0; }
  [[nodiscard]] std::size_t evaluations() const { return evaluations_; }

 private:
  [[nodiscard]] std::size_t index(Pair pair) const { return pair.mesh * problem_.texture_bits.size() + pair.texture; }
  const Problem& problem_;
  std::vector<std::uint64_t> errors_;
  std::vector<std::uint8_t> known_;
  std::size_t evaluations_ = 0;
};

}  // namespace etalon::joint
