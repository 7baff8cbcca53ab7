// parallel_for: every index once, whatever the thread count; exceptions come back.
#include "core/base/parallel.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace {

// Restores the default at the end of a test case.
struct ThreadCount {
  explicit ThreadCount(int count) { etalon::set_thread_count(count); }
  ~ThreadCount() { etalon::set_thread_count(0); }
};

}  // namespace

TEST_CASE("parallel_for: each index exactly once, for 1, 2 and 7 threads") {
  for (const int threads : {1, 2, 7}) {
    const ThreadCount limit(threads);
    CHECK(etalon::thread_count() == threads);
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{1000}}) {
      std::vector<std::atomic<int>> visits(count);
      etalon::parallel_for(count, [&](std::size_t i) { ++visits.at(i); });
      for (const auto& n : visits) CHECK(n == 1);
    }
  }
}

TEST_CASE("parallel_for_blocks: consecutive blocks of the grain, equal for every thread count") {
  std::set<std::pair<std::size_t, std::size_t>> expected;
  for (std::size_t begin = 0; begin < 103; begin += 10) expected.emplace(begin, std::min<std::size_t>(begin + 10, 103));
  for (const int threads : {1, 2, 7}) {
    const ThreadCount limit(threads);
    std::mutex mutex;
    std::set<std::pair<std::size_t, std::size_t>> blocks;
    etalon::parallel_for_blocks(103, 10, [&](std::size_t begin, std::size_t end) {
      const std::lock_guard lock(mutex);
      blocks.emplace(begin, end);
    });
    CHECK(blocks == expected);
  }
}

TEST_CASE("parallel_for: an exception of a body is rethrown to the caller, and the next call works") {
  for (const int threads : {1, 2, 7}) {
    const ThreadCount limit(threads);
    const auto throws = [](std::size_t i) {
      if (i == 37) throw std::runtime_error("thirty-seven");
    };
    CHECK_THROWS_WITH_AS(etalon::parallel_for(100, throws), "thirty-seven", std::runtime_error);
    std::atomic<int> visits = 0;
    etalon::parallel_for(100, [&](std::size_t) { ++visits; });
    CHECK(visits == 100);
  }
}

TEST_CASE("parallel_for: one thread means the caller's own, whatever the number of indices") {
  const ThreadCount limit(1);
  std::vector<std::size_t> order;
  std::set<std::thread::id> ids;
  etalon::parallel_for(100, [&](std::size_t i) {
    order.push_back(i);
    ids.insert(std::this_thread::get_id());
  });
  CHECK(order.size() == 100);
  CHECK(ids.size() == 1);
}

TEST_CASE("parallel_for: more threads than cores really work at the same time when asked for") {
  // Two bodies that each wait for the other can only both return when two threads run them.
  const ThreadCount limit(7);
  std::mutex mutex;
  std::condition_variable both_here;
  int arrived = 0;
  bool met = true;
  etalon::parallel_for(2, [&](std::size_t) {
    std::unique_lock lock(mutex);
    ++arrived;
    both_here.notify_all();
    if (!both_here.wait_for(lock, std::chrono::seconds(20), [&] { return arrived == 2; })) met = false;
  });
  CHECK(met);
}

TEST_CASE("set_thread_count: 0 and less restore the default") {
  etalon::set_thread_count(5);
  etalon::set_thread_count(0);
  const int by_default = etalon::thread_count();
  CHECK(by_default >= 1);
  etalon::set_thread_count(-3);
  CHECK(etalon::thread_count() == by_default);
}
