// Index handles that cannot be mixed up: a VertexId is no FaceId, and a default-made one is invalid.
#pragma once

#include <compare>
#include <cstdint>

namespace etalon {

template <class Tag>
struct StrongId {
  static constexpr std::uint32_t kInvalid = 0xFFFFFFFFu;
  std::uint32_t index = kInvalid;

  constexpr StrongId() = default;
  constexpr explicit StrongId(std::uint32_t i) : index(i) {}
  constexpr explicit StrongId(std::size_t i) : index(static_cast<std::uint32_t>(i)) {}
  [[nodiscard]] constexpr bool valid() const { return index != kInvalid; }
  friend constexpr auto operator<=>(StrongId, StrongId) = default;
};

}  // namespace etalon
