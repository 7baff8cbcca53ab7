#include "tests/bench/timing.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

namespace etalon::bench {

void measure_round(std::vector<Way>& ways) {
  for (Way& way : ways) {
    // TBB's workers look for work for some time before they sleep; they must not take the next way's cores.
    std::this_thread::sleep_for(std::chrono::milliseconds(3));
    const auto start = std::chrono::steady_clock::now();
    for (int n = 0; n < way.runs; ++n) way.run();
    way.milliseconds.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count() / way.runs);
  }
}

void choose_runs(std::vector<Way>& ways) {
  constexpr double kMostRuns = 1000;
  for (Way& way : ways) {
    way.runs = static_cast<int>(std::clamp(std::ceil(kLeastTurn_ms / std::max(way.milliseconds.front(), 1e-3)), 1.0, kMostRuns));
    way.milliseconds.clear();
  }
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

std::vector<double> ratios(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> result;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) result.push_back(a[i] / b[i]);
  return result;
}

Quartiles quartiles(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {values[(values.size() - 1) / 4], values[(values.size() - 1) * 3 / 4]};
}

}  // namespace etalon::bench
