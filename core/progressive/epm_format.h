// The file format .epm, version 1: a progressive mesh as bytes, coarse to fine, checked block by block (docs/formats.md#epm).
// Does not touch files: bytes in, bytes out.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/progressive/progressive_mesh.h"

namespace etalon::progressive {

inline constexpr std::uint32_t kEpmVersion = 1;
/// Splits in a block; the last one may hold fewer.
inline constexpr std::size_t kEpmBlockSplits = 64;

/// A chunk of somebody else's: carried along, its checksum verified, not understood here.
struct EpmExtra {
  std::string
      tag;  ///< four ASCII letters: CELL (overlay cells of the splits before it), BMAP (a base map), or any that begins with a small one
  std::size_t after_splits =
      0;  ///< it stands behind the block that ends with this split; 0: behind the base. A multiple of kEpmBlockSplits or all
  std::string payload;
  friend bool operator==(const EpmExtra&, const EpmExtra&) = default;
};

struct EpmContent {
  ProgressiveMesh mesh;
  std::size_t splits_in_whole = 0;  ///< that the file has when it is whole
  bool complete = false;            ///< false for a prefix: it holds the splits of its whole blocks
  std::vector<EpmExtra> extras;     ///< in the order of the file
};

/// The bytes of a progressive mesh; equal data and extras give equal bytes. InputError for an extra with another tag, in another place, or not in the
/// order of their places.
[[nodiscard]] std::string encode_epm(const ProgressiveData& data, const std::vector<EpmExtra>& extras = {});

/// Reads a file or any prefix of one that reaches the end of the base. InputError "byte N: what, expected, got" for a shorter prefix, another
/// format or version, a wrong checksum (of a chunk that is passed over too), an unknown chunk that must be understood, bytes behind the end,
/// counts that do not fit, and for what ProgressiveMesh refuses. Memory is proportional to the bytes given.
[[nodiscard]] EpmContent decode_epm(std::span<const std::byte> bytes);

/// CRC-32 (ISO 3309, reflected polynomial 0xEDB88320), continued from `crc`.
[[nodiscard]] std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t crc = 0);

}  // namespace etalon::progressive
