// The chunks that a file .epm is made of, for those who write and read it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

namespace etalon::progressive {

inline constexpr std::string_view kMagic = "etalonPM";
constexpr std::uint32_t tag(const char (&name)[5]) {
  return static_cast<std::uint32_t>(name[0]) | static_cast<std::uint32_t>(name[1]) << 8 | static_cast<std::uint32_t>(name[2]) << 16 |
         static_cast<std::uint32_t>(name[3]) << 24;
}
inline constexpr std::uint32_t kHead = tag("HEAD"), kBase = tag("BASE"), kNames = tag("mtls"), kSplits = tag("SPLT"), kDone = tag("DONE");
inline constexpr std::uint32_t kCells = tag("CELL"), kBaseMap = tag("BMAP");
inline constexpr std::uint32_t kHasUv = 1, kHasColors = 2, kHasMaterials = 4, kHasMoves = 8;
inline constexpr std::uint32_t kAllFlags = kHasUv | kHasColors | kHasMaterials | kHasMoves;
inline constexpr std::uint8_t kMovesParent = 1, kMovesLeft = 2, kMovesRight = 4;  ///< of a split, in a file that has moves
inline constexpr std::size_t kChunkHead = 16;

inline bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

inline std::string text_of(std::uint32_t name) {
  std::string text;
  for (int i = 0; i < 4; ++i) text += static_cast<char>(name >> (8 * i));
  return text;
}

// One that need not be understood: of four letters, the first small, or one of the two that are reserved.
inline bool may_pass(std::uint32_t name) {
  if (name == kCells || name == kBaseMap) return true;
  const std::string text = text_of(name);
  return std::all_of(text.begin(), text.end(), is_letter) && (name & 0x20u) != 0 && name != kNames;
}

}  // namespace etalon::progressive
