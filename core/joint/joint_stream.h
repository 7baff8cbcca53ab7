// One progressive file of mesh and texture: the segments of both streams in the order of a path, so that every prefix is a pair of it.
// Format: docs/formats.md#joint-stream. Bytes in, bytes out; touches no files.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/joint/joint_levels.h"

namespace etalon::joint {

inline constexpr std::size_t kJointHeaderBytes = 20;  ///< signature, numbers of levels, checksum
inline constexpr std::size_t kSegmentHeadBytes = 9;   ///< kind, length, checksum

/// The file of a path: first the smallest pair, then at each point the segments that lead to it (mesh before texture). After the point of pair (i, j)
/// the file is (mesh_bits[i] + texture_bits[j]) / 8 bytes long. InputError for a path that does not begin with the smallest pair, goes down, or
/// names a level that is not there.
[[nodiscard]] std::vector<std::byte> encode_joint(const JointLevels& levels, const Path& path);

/// True for bytes that begin with the signature.
[[nodiscard]] bool has_joint_signature(std::span<const std::byte> bytes);

struct DecodedJoint {
  terrain::DecodedTerrain terrain;
  Image texture;
  Pair pair;                                        ///< the finest levels that are there
  std::size_t mesh_levels = 0, texture_levels = 0;  ///< that the whole file has
  bool is_complete = false;                         ///< all levels of both
  std::size_t bytes_used = 0;                       ///< up to the end of the last whole segment
};

/// Reads a file, or a prefix of one that holds at least the smallest pair: it opens at its last whole segment. The texture's delays come from
/// the header of the mesh stream alone. InputError "joint stream: byte N: …": a shorter prefix, another signature, a segment whose checksum, kind
/// or length is wrong, more segments than levels, streams of another view or that are none. Any bytes are refused or give a valid pair.
[[nodiscard]] DecodedJoint decode_joint(std::span<const std::byte> bytes, const wavelet::DecodeLimits& limits = {});

}  // namespace etalon::joint
