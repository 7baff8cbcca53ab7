// Numbers in geometric progression, the same on every machine.
#pragma once

#include <cstddef>
#include <vector>

namespace etalon::joint {

/// `count` >= 2 numbers from `from` > 0 to `to` > from: the first and the last exactly, the others by multiplying with the root of to/from that
/// bisection finds. InputError.
[[nodiscard]] std::vector<double> geometric_progression(double from, double to, std::size_t count);

}  // namespace etalon::joint
