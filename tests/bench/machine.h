// Where and when figures were measured: without that they mean nothing.
#pragma once

#include <string>

namespace etalon::bench {

struct Machine {
  std::string date;      ///< UTC, "2026-11-22"
  std::string cpu;       ///< the processor's own name
  int cores = 0;         ///< that this process may use
  std::string system;    ///< "Debian GNU/Linux 12 (bookworm)"
  std::string compiler;  ///< of this program
  double load = 0;       ///< mean number of runnable threads of the last minute: what else the machine did
};

/// Unknown texts are "unknown".
[[nodiscard]] Machine this_machine();

/// What other programs take of the processors' time, since the last question.
class OtherPrograms {
 public:
  OtherPrograms() { (void)share(); }
  /// In [0, 1] of all processors; steps of 1/100 s on each. 0 where the system does not say.
  [[nodiscard]] double share();

 private:
  double busy_seconds_ = 0;  ///< of all processors
  double own_seconds_ = 0;
  double total_seconds_ = 0;
};

}  // namespace etalon::bench
