#include "core/joint/geometric.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"

namespace etalon::joint {

std::vector<double> geometric_progression(double from, double to, std::size_t count) {
  if (!(from > 0) || !(to > from) || !(to <= 1e300) || count < 2)
    throw InputError(
        fmt::format("geometric progression: expected at least 2 numbers from 0 < from < to, got {} from {} to {}", count, from, to));
  const auto power = [&](double base) {
    double product = 1;
    for (std::size_t n = 1; n < count; ++n) product *= base;
    return product;
  };
  double below = 1, above = to / from;
  for (;;) {
    const double middle = below + (above - below) / 2;
    if (middle <= below || middle >= above) break;
    (power(middle) <= to / from ? below : above) = middle;
  }
  std::vector<double> numbers = {from};
  while (numbers.size() + 1 < count) numbers.push_back(std::min(numbers.back() * below, to));
  numbers.push_back(to);
  return numbers;
}

}  // namespace etalon::joint
