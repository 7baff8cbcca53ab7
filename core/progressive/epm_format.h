// The file format .epm, version 1: a progressive mesh as bytes, coarse to fine, checked block by block (docs/formats.md#epm).
// Does not touch files: bytes in, bytes out.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "core/progressive/progressive_mesh.h"

namespace etalon::progressive {

inline constexpr std::uint32_t kEpmVersion = 1;
/// Splits in a block; the last one may hold fewer.
inline constexpr std::size_t kEpmBlockSplits = 64;

struct EpmContent {
  ProgressiveMesh mesh;
  std::size_t splits_in_whole = 0;  ///< that the file has when it is whole
  bool complete = false;            ///< false for a prefix: it holds the splits of its whole blocks
};

/// The bytes of a progressive mesh; equal data give equal bytes.
[[nodiscard]] std::string encode_epm(const ProgressiveData& data);

/// Reads a file or any prefix of one that reaches the end of the base. InputError "byte N: what, expected, got" for a shorter prefix, another
/// format or version, a wrong checksum, an unknown chunk that must be understood, bytes behind the end, counts that do not fit, and for what
/// ProgressiveMesh refuses. Memory is proportional to the bytes given.
[[nodiscard]] EpmContent decode_epm(std::span<const std::byte> bytes);

/// CRC-32 (ISO 3309, reflected polynomial 0xEDB88320), continued from `crc`.
[[nodiscard]] std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t crc = 0);

}  // namespace etalon::progressive
