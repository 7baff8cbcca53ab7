// The levels of a terrain as one progressive stream: the bytes of a level's segment, and of all before it, are its C_M
// [Horbelt, Balmelli & Vetterli, sec. 1]. Format: docs/formats.md#terrain-stream. Bytes in, bytes out; touches no files.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/terrain/height_field.h"
#include "core/terrain/levels.h"
#include "core/terrain/terrain_view.h"

namespace etalon::terrain {

struct TerrainStream {
  std::string bytes;
  std::vector<std::size_t> level_ends_bytes;  ///< level l is the first level_ends_bytes[l] bytes: header, flushes and lengths included
};

/// Codes, level by level, which edges are split (a point with its parents there can follow; nothing is coded for the others), and the heights of the new
/// points: arithmetic coding in contexts that both sides derive from what has been coded. With a view these also know how much a metre is worth on
/// the screen: from the view in the header and heights already decoded, so that no mask is sent. The order of the levels may come from anywhere.
/// Equal input, equal bytes. InputError: validate() refuses the field or the view, levels of another grid, a level that has a point without its parents, no
/// levels.
[[nodiscard]] TerrainStream encode_terrain(const HeightField& field, const Levels& levels, const std::optional<TerrainView>& view = {});

struct DecodeLimits {
  int max_bits = kMaxGridBits;  ///< larger grids are refused before memory is taken: about 7 bytes a grid point
};

struct DecodedTerrain {
  HeightField field;  ///< heights of the points that the levels have; 0 at all others
  Levels levels;      ///< the whole ones
  std::optional<TerrainView> view;
  std::size_t levels_in_whole = 0;  ///< that the stream has when it is whole
  bool is_complete = false;         ///< false: a prefix, or one that ends inside a segment
  std::size_t bytes_used = 0;       ///< up to the end of the last whole level
};

/// Reads a stream, or a prefix of one that holds at least the first level: it opens at its last whole level. Heights, levels and meshes are those that were
/// encoded. InputError "terrain stream: byte N: …": a shorter prefix, another signature or version, a header whose checksum or numbers are wrong,
/// a grid above the limit, a segment that is no segment, bytes behind the last one. Any bytes are refused or give a valid terrain.
[[nodiscard]] DecodedTerrain decode_terrain(std::span<const std::byte> bytes, const DecodeLimits& limits = {});

}  // namespace etalon::terrain
