#include "core/terrain/domain_pruning.h"

#include <algorithm>

namespace etalon::terrain {

namespace {
constexpr std::uint32_t kNoSlot = 0xFFFFFFFFu;
constexpr std::uint8_t kCorner = 255;
}  // namespace

DomainPruning::DomainPruning(int bits, std::span<const std::int64_t> costs)
    : bits_(bits),
      costs_(costs),
      sums_(costs.size()),
      counts_(costs.size()),
      keys_(costs.size()),
      slots_(costs.size(), kNoSlot),
      levels_(costs.size(), kCorner) {
  for (std::uint32_t v = 0; v < costs_.size(); ++v) {
    const GridPoint p = point_at(bits_, v);
    const Split split = split_of(bits_, p);
    if (split.level < 0) continue;
    levels_[v] = static_cast<std::uint8_t>(split.level);
    sums_[v] += costs_[v];
    ++counts_[v];
    for_each_ancestor(bits_, p, [&](GridPoint ancestor) {
      const std::uint32_t a = point_index(bits_, ancestor);
      sums_[a] += costs_[v];
      ++counts_[a];
    });
  }
  heap_.reserve(costs_.size());
  for (std::uint32_t v = 0; v < costs_.size(); ++v) {
    if (levels_[v] == kCorner) continue;
    keys_[v] = ratio(v);
    slots_[v] = static_cast<std::uint32_t>(heap_.size());
    heap_.push_back(v);
  }
  for (std::size_t slot = heap_.size() / 2; slot-- > 0;) sift_down(slot);
}

bool DomainPruning::before(std::uint32_t a, std::uint32_t b) const {
  if (keys_[a] != keys_[b]) return keys_[a] < keys_[b];
  if (levels_[a] != levels_[b]) return levels_[a] > levels_[b];
  return a < b;
}

void DomainPruning::place(std::size_t slot, std::uint32_t v) {
  heap_[slot] = v;
  slots_[v] = static_cast<std::uint32_t>(slot);
}

void DomainPruning::sift_up(std::size_t slot) {
  const std::uint32_t v = heap_[slot];
  while (slot > 0) {
    const std::size_t parent = (slot - 1) / 2;
    if (!before(v, heap_[parent])) break;
    place(slot, heap_[parent]);
    slot = parent;
  }
  place(slot, v);
}

void DomainPruning::sift_down(std::size_t slot) {
  const std::uint32_t v = heap_[slot];
  while (2 * slot + 1 < heap_.size()) {
    std::size_t child = 2 * slot + 1;
    if (child + 1 < heap_.size() && before(heap_[child + 1], heap_[child])) ++child;
    if (!before(heap_[child], v)) break;
    place(slot, heap_[child]);
    slot = child;
  }
  place(slot, v);
}

void DomainPruning::erase(std::uint32_t v) {
  const std::size_t slot = slots_[v];
  slots_[v] = kNoSlot;
  const std::uint32_t last = heap_.back();
  heap_.pop_back();
  if (last == v) return;
  place(slot, last);
  sift_up(slot);
  sift_down(slots_[last]);
}

// What is left of v's domain: level by level down the hierarchy, then finest first, and cheapest first within a level.
void DomainPruning::collect_domain(std::uint32_t v) {
  domain_.assign(1, v);
  slots_[v] |= 0x80000000u;  // marks membership; heaps are shorter than 2^31
  for (std::size_t n = 0; n < domain_.size(); ++n) {
    const GridPoint p = point_at(bits_, domain_[n]);
    for_each_child(bits_, p, split_of(bits_, p), [&](GridPoint child) {
      const std::uint32_t c = point_index(bits_, child);
      if (slots_[c] >= 0x80000000u) return;  // gone, or here already
      slots_[c] |= 0x80000000u;
      domain_.push_back(c);
    });
  }
  for (const std::uint32_t d : domain_) slots_[d] &= 0x7FFFFFFFu;
  std::sort(domain_.begin(), domain_.end(), [&](std::uint32_t a, std::uint32_t b) {
    if (levels_[a] != levels_[b]) return levels_[a] > levels_[b];
    if (costs_[a] != costs_[b]) return costs_[a] < costs_[b];
    return a < b;
  });
}

void DomainPruning::take(std::uint32_t v, std::vector<std::uint32_t>& out) {
  collect_domain(v);
  for (const std::uint32_t d : domain_) {
    erase(d);
    counts_[d] = 0;
    out.push_back(d);
  }
  for (const std::uint32_t d : domain_)
    for_each_ancestor(bits_, point_at(bits_, d), [&](GridPoint ancestor) {
      const std::uint32_t a = point_index(bits_, ancestor);
      if (counts_[a] == 0) return;
      sums_[a] -= costs_[d];
      --counts_[a];
    });
  // A ratio that has risen waits in the heap under its old key until it comes to the top; one that has fallen must move now.
  for (const std::uint32_t d : domain_)
    for_each_ancestor(bits_, point_at(bits_, d), [&](GridPoint ancestor) {
      const std::uint32_t a = point_index(bits_, ancestor);
      if (counts_[a] == 0) return;
      const double now = ratio(a);
      if (now >= keys_[a]) return;
      keys_[a] = now;
      sift_up(slots_[a]);
    });
}

std::vector<std::uint32_t> DomainPruning::order(const std::function<void(std::size_t, std::size_t)>& progress) {
  constexpr std::size_t kReport = 1u << 16;
  std::vector<std::uint32_t> out;
  const std::size_t total = heap_.size();
  out.reserve(total);
  std::size_t next_report = kReport;
  while (!heap_.empty()) {
    const std::uint32_t top = heap_.front();
    const double now = ratio(top);
    if (now > keys_[top]) {
      keys_[top] = now;
      sift_down(0);
      continue;
    }
    take(top, out);
    if (progress && out.size() >= next_report) {
      progress(out.size(), total);
      next_report = out.size() + kReport;
    }
  }
  return out;
}

}  // namespace etalon::terrain
