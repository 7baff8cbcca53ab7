// The judge's suites cut into blocks that can be run, logged and repeated one by one.
#pragma once

#include <functional>
#include <iosfwd>
#include <set>
#include <string>
#include <vector>

#include "tests/validation/reference/tally.h"

namespace etalon::validation::reference {

enum class Suite {
  mass,          ///< CpuRenderer's code for one sample (double enclosures first) against the judge: random triangles
  mass_exact,    ///< the same with wide integers always
  mass_fast,     ///< the same with the fast path, at every SIMD level of this machine
  judge,         ///< the judge in rationals against the judge in integers
  lattice,       ///< every triangle on a lattice
  lattice_fast,  ///< the same with the fast path, at every SIMD level
  tilings,       ///< shared edges covered exactly once
  frames,        ///< whole frames after visibility, at every SIMD level, as the tilings
  threads,       ///< the same bytes with 1, 2 and 7 threads
};

enum class Length {
  quick,  ///< seconds: part of every test run
  full,   ///< the numbers that docs/testing.md claims
};

struct Block {
  std::string name;  ///< unique, says suite and seeds
  std::function<Tally()> run;
};

[[nodiscard]] std::vector<Block> blocks_of(Suite suite, Length length);

[[nodiscard]] const std::vector<Suite>& all_suites();
[[nodiscard]] const char* to_string(Suite suite);

/// One line about a finished block, "NAME | counts: M mismatches | S s"; the log of a long run is made of such lines.
[[nodiscard]] std::string log_line(const Block& block, const Tally& tally, double seconds);
/// The names of the blocks that a log records as agreed; a line cut short by an interruption does not count.
[[nodiscard]] std::set<std::string> agreed_blocks(std::istream& log);

}  // namespace etalon::validation::reference
