// Finds equal things again by a hash, in the order of their first appearance: for welding what files store apart.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace etalon {

/// The words of a key, mixed as MurmurHash3's finalizer does. Not for secrets: equal hashes of different keys can be made.
template <std::size_t N>
[[nodiscard]] std::uint64_t hash_words(const std::array<std::uint32_t, N>& key) {
  std::uint64_t h = 0;
  for (const std::uint32_t word : key) {
    h = (h ^ word) * 0xff51afd7ed558ccdu;
    h ^= h >> 33;
  }
  return h * 0xc4ceb9fe1a85ec53u;
}

/// Indices of distinct keys, which the caller keeps: open addressing, at most half full. The hash decides where is looked, never the answer.
class IndexTable {
 public:
  /// The index of the key that `is_equal(index)` says is the same; where there is none, `next`, which the caller then gives that key.
  template <class IsEqual>
  std::uint32_t find_or_add(std::uint64_t hash, std::uint32_t next, const IsEqual& is_equal) {
    if (2 * count_ >= slots_.size()) grow();
    std::size_t at = place_of(hash);
    for (; slots_[at].index != kEmpty; at = (at + 1) & (slots_.size() - 1))
      if (slots_[at].hash == hash && is_equal(slots_[at].index)) return slots_[at].index;
    slots_[at] = {hash, next};
    ++count_;
    return next;
  }

 private:
  static constexpr std::uint32_t kEmpty = UINT32_MAX;
  struct Slot {
    std::uint64_t hash = 0;
    std::uint32_t index = kEmpty;
  };

  // The high bits of a product depend on all that was multiplied.
  [[nodiscard]] std::size_t place_of(std::uint64_t hash) const { return hash >> (64 - std::countr_zero(slots_.size())); }
  void grow() {
    std::vector<Slot> old(2 * slots_.size());
    old.swap(slots_);
    for (const Slot& slot : old) {
      if (slot.index == kEmpty) continue;
      std::size_t at = place_of(slot.hash);
      while (slots_[at].index != kEmpty) at = (at + 1) & (slots_.size() - 1);
      slots_[at] = slot;
    }
  }

  std::vector<Slot> slots_ = std::vector<Slot>(1024);
  std::size_t count_ = 0;
};

}  // namespace etalon
