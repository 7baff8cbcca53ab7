#include "core/terrain/domain_pruning.h"

#include <algorithm>

namespace etalon::terrain {

namespace {
constexpr std::uint32_t kMark = 0x80000000u;
}

DomainPruning::DomainPruning(int bits, std::span<const std::int64_t> costs) : bits_(bits), costs_(costs), nodes_(costs.size()) {
  const int side = (1 << bits) + 1;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      const GridPoint p{i, j};
      if (split_of(bits_, p).level < 0) continue;
      const std::uint32_t v = point_index(bits_, p);
      const auto add = [&](GridPoint q) {
        Node& node = nodes_[point_index(bits_, q)];
        node.sum += costs_[v];
        ++node.count;
      };
      add(p);
      for_each_ancestor(bits_, p, add);
    }
  heap_.reserve(nodes_.size());
  for (std::uint32_t v = 0; v < nodes_.size(); ++v) {
    Node& node = nodes_[v];
    if (node.count == 0) continue;
    node.key = ratio(node);
    node.slot = static_cast<std::uint32_t>(heap_.size());
    heap_.push_back(v);
  }
  for (std::size_t slot = heap_.size() / 2; slot-- > 0;) sift_down(slot);
}

bool DomainPruning::before(std::uint32_t a, std::uint32_t b) const {
  if (nodes_[a].key != nodes_[b].key) return nodes_[a].key < nodes_[b].key;
  const int level_a = split_of(bits_, point_at(bits_, a)).level, level_b = split_of(bits_, point_at(bits_, b)).level;
  return level_a != level_b ? level_a > level_b : a < b;
}

void DomainPruning::place(std::size_t slot, std::uint32_t v) {
  heap_[slot] = v;
  nodes_[v].slot = static_cast<std::uint32_t>(slot);
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
  const std::size_t slot = nodes_[v].slot;
  nodes_[v].slot = kMark;
  const std::uint32_t last = heap_.back();
  heap_.pop_back();
  if (last == v) return;
  place(slot, last);
  sift_up(slot);
  sift_down(nodes_[last].slot);
}

// What is left of v's domain: level by level down the hierarchy, then finest first, and cheapest first within a level.
void DomainPruning::collect_domain(std::uint32_t v) {
  domain_.assign(1, v);
  if (nodes_[v].count == 1) return;
  nodes_[v].slot |= kMark;  // heaps are shorter than 2^31
  for (std::size_t n = 0; n < domain_.size(); ++n) {
    const GridPoint p = point_at(bits_, domain_[n]);
    for_each_child(bits_, p, split_of(bits_, p), [&](GridPoint child) {
      const std::uint32_t c = point_index(bits_, child);
      if (nodes_[c].slot >= kMark) return;  // gone, or here already
      nodes_[c].slot |= kMark;
      domain_.push_back(c);
    });
  }
  for (const std::uint32_t d : domain_) nodes_[d].slot &= ~kMark;
  std::sort(domain_.begin(), domain_.end(), [&](std::uint32_t a, std::uint32_t b) {
    const int level_a = split_of(bits_, point_at(bits_, a)).level, level_b = split_of(bits_, point_at(bits_, b)).level;
    if (level_a != level_b) return level_a > level_b;
    if (costs_[a] != costs_[b]) return costs_[a] < costs_[b];
    return a < b;
  });
}

void DomainPruning::take(std::uint32_t v, std::vector<std::uint32_t>& out) {
  collect_domain(v);
  for (const std::uint32_t d : domain_) {
    erase(d);
    nodes_[d].count = 0;
    out.push_back(d);
  }
  // A ratio that has risen waits in the heap under its old key until it comes to the top; one that has fallen must move now. (While only part of the
  // domain has been subtracted it may fall below what it will be: that only makes it wait.)
  for (const std::uint32_t d : domain_)
    for_each_ancestor(bits_, point_at(bits_, d), [&](GridPoint ancestor) {
      const std::uint32_t a = point_index(bits_, ancestor);
      Node& node = nodes_[a];
      if (node.count == 0) return;
      node.sum -= costs_[d];
      --node.count;
      const double now = ratio(node);
      if (now >= node.key) return;
      node.key = now;
      sift_up(node.slot);
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
    const double now = ratio(nodes_[top]);
    if (now > nodes_[top].key) {
      nodes_[top].key = now;
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
