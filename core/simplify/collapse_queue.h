// The priority queue of collapses: each vertex at most once, with its best candidate; entries are changed in place, never duplicated.
#pragma once

#include <cstdint>
#include <vector>

namespace etalon::simplify {

/// What a vertex would do next. Total order: cost, then vertex.
struct QueuedCollapse {
  double cost = 0;  ///< never NaN
  std::uint32_t vertex = 0, target = 0;
  friend bool operator<(const QueuedCollapse& a, const QueuedCollapse& b) {
    return a.cost != b.cost ? a.cost < b.cost : a.vertex < b.vertex;
  }
};

/// A 4-ary heap: four children are one cache line. The order in which equal sets of entries come out does not depend on how they came in.
class CollapseQueue {
 public:
  explicit CollapseQueue(std::uint32_t vertex_capacity) : slots_(vertex_capacity) {}

  [[nodiscard]] bool empty() const { return heap_.empty(); }
  [[nodiscard]] std::size_t size() const { return heap_.size(); }
  [[nodiscard]] const QueuedCollapse& top() const { return heap_.front(); }
  [[nodiscard]] bool contains(std::uint32_t vertex) const { return slots_[vertex].place != kAbsent; }
  [[nodiscard]] const QueuedCollapse& of(std::uint32_t vertex) const { return heap_[slots_[vertex].place]; }
  /// Whether the vertex is in the queue, with that target; reads no entry.
  [[nodiscard]] bool goes_to(std::uint32_t vertex, std::uint32_t target) const {
    return slots_[vertex].target == target && contains(vertex);
  }

  /// Replaces all entries; O(n).
  void assign(std::vector<QueuedCollapse> entries) {
    heap_ = std::move(entries);
    for (std::uint32_t i = 0; i < heap_.size(); ++i) slots_[heap_[i].vertex] = {i, heap_[i].target};
    for (std::uint32_t i = static_cast<std::uint32_t>((heap_.size() + 2) / 4); i-- > 0;) sink(i, heap_[i]);
  }

  /// Inserts the entry of a vertex, or changes it.
  void set(const QueuedCollapse& entry) {
    std::uint32_t at = slots_[entry.vertex].place;
    slots_[entry.vertex].target = entry.target;
    if (at == kAbsent) {
      at = static_cast<std::uint32_t>(heap_.size());
      heap_.push_back(entry);
      rise(at, entry);
    } else if (entry < heap_[at]) {
      rise(at, entry);
    } else {
      sink(at, entry);
    }
  }

  void remove(std::uint32_t vertex) {
    const std::uint32_t at = slots_[vertex].place;
    if (at == kAbsent) return;
    slots_[vertex].place = kAbsent;
    const QueuedCollapse last = heap_.back();
    heap_.pop_back();
    if (at == heap_.size()) return;
    if (last < heap_[at])
      rise(at, last);
    else
      sink(at, last);
  }

  /// Whether every entry is in its place and none before its parent; O(n), for tests.
  [[nodiscard]] bool ok() const {
    for (std::uint32_t i = 0; i < heap_.size(); ++i)
      if (slots_[heap_[i].vertex].place != i || slots_[heap_[i].vertex].target != heap_[i].target ||
          (i > 0 && heap_[i] < heap_[(i - 1) / 4]))
        return false;
    return true;
  }

  [[nodiscard]] std::size_t memory_bytes() const { return heap_.capacity() * sizeof(QueuedCollapse) + slots_.capacity() * sizeof(Slot); }

 private:
  static constexpr std::uint32_t kAbsent = 0xFFFFFFFFu;
  struct Slot {
    std::uint32_t place = kAbsent;  // index into heap_
    std::uint32_t target = 0;       // of the entry there
  };

  void put(std::uint32_t at, const QueuedCollapse& entry) {
    heap_[at] = entry;
    slots_[entry.vertex].place = at;
  }
  void rise(std::uint32_t at, const QueuedCollapse& entry) {
    while (at > 0) {
      const std::uint32_t parent = (at - 1) / 4;
      if (!(entry < heap_[parent])) break;
      put(at, heap_[parent]);
      at = parent;
    }
    put(at, entry);
  }
  void sink(std::uint32_t at, const QueuedCollapse entry) {
    const auto size = static_cast<std::uint32_t>(heap_.size());
    for (;;) {
      const std::uint32_t first = 4 * at + 1;
      if (first >= size) break;
      std::uint32_t least = first;
      const std::uint32_t behind = first + 4 < size ? first + 4 : size;
      for (std::uint32_t i = first + 1; i < behind; ++i)
        if (heap_[i] < heap_[least]) least = i;
      if (!(heap_[least] < entry)) break;
      put(at, heap_[least]);
      at = least;
    }
    put(at, entry);
  }

  std::vector<QueuedCollapse> heap_;
  std::vector<Slot> slots_;  // by vertex
};

}  // namespace etalon::simplify
