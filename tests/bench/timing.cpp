#include "tests/bench/timing.h"

#include <algorithm>
#include <chrono>
#include <thread>

namespace etalon::bench {

void measure_round(std::vector<Way>& ways) {
  for (Way& way : ways) {
    // TBB's workers look for work for some time before they sleep; they must not take the next way's cores.
    std::this_thread::sleep_for(std::chrono::milliseconds(3));
    const auto start = std::chrono::steady_clock::now();
    way.run();
    way.milliseconds.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
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
