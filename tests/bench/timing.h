// Wall-clock times of things that are measured in turns: A B C A B C …, so that whatever else the machine does hits all of them.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace etalon::bench {

/// Something that is timed, and its time in each round.
struct Way {
  std::string name;
  std::function<void()> run;
  std::vector<double> milliseconds;  ///< by round, of one run
  int runs = 1;                      ///< one after the other in a turn
};

/// One round: each way takes its turn, in order, after a pause in which the threads of the one before go to sleep.
void measure_round(std::vector<Way>& ways);

/// Makes turns long enough that waking threads and filling caches is a small part of them, as it is where frame follows frame: as many runs
/// as the first round's times say that kLeastTurn_ms takes. Forgets those times.
inline constexpr double kLeastTurn_ms = 60;
void choose_runs(std::vector<Way>& ways);

/// The middle of the sorted values (the mean of the middle two); `values` is not empty.
[[nodiscard]] double median(std::vector<double> values);

/// a[i] / b[i].
[[nodiscard]] std::vector<double> ratios(const std::vector<double>& a, const std::vector<double>& b);

/// The values that a quarter and three quarters of the sorted values do not exceed.
struct Quartiles {
  double lower = 0;
  double upper = 0;
};
[[nodiscard]] Quartiles quartiles(std::vector<double> values);

}  // namespace etalon::bench
