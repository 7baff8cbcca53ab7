// Threads: the only door to TBB. It parallelises; it never decides: callers write disjoint results and combine them in a fixed order.
#pragma once

#include <cstddef>
#include <functional>

namespace etalon {

/// Limits all later parallel work to `count` threads (>= 1); 0 restores the default, the number of cores.
void set_thread_count(int count);
[[nodiscard]] int thread_count();

/// Calls body(i) once for every i in [0, count), in any order, from several threads; an exception of a body is rethrown here.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

/// Calls body(begin, end) on consecutive blocks of at most `grain` indices that cover [0, count); the blocks do not depend on the thread count.
void parallel_for_blocks(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body);

}  // namespace etalon
