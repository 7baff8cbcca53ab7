#include "core/base/parallel.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <memory>

#include "core/base/float_environment.h"

namespace etalon {
namespace {

int requested_threads = 0;
std::unique_ptr<tbb::global_control> limit;
std::unique_ptr<tbb::task_arena> arena;

}  // namespace

void set_thread_count(int count) {
  requested_threads = std::max(count, 0);
  arena.reset();
  limit.reset();
  if (requested_threads == 0) return;
  limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(requested_threads));
  // An arena of its own, so that more threads than cores are really used when asked for.
  arena = std::make_unique<tbb::task_arena>(requested_threads);
}

int thread_count() { return requested_threads > 0 ? requested_threads : tbb::info::default_concurrency(); }

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  const auto guarded = [&body](std::size_t i) {
    const DefaultFloatEnvironment environment;
    body(i);
  };
  if (count == 1) return guarded(0);  // nothing to share, and waking threads costs more than small work
  const auto work = [&] { tbb::parallel_for(std::size_t{0}, count, guarded, tbb::simple_partitioner()); };
  if (arena)
    arena->execute(work);
  else
    work();
}

void parallel_for_blocks(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body) {
  const std::size_t blocks = (count + grain - 1) / grain;
  parallel_for(blocks, [&](std::size_t b) { body(b * grain, std::min(count, (b + 1) * grain)); });
}

}  // namespace etalon
