// What stands before the first level of a terrain stream.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/terrain/height_field.h"
#include "core/terrain/terrain_view.h"

namespace etalon::terrain {

struct StreamHeader {
  HeightField grid;  ///< without heights
  std::int32_t lowest = 0, highest = 0;
  std::size_t level_count = 0;
  std::optional<TerrainView> view;
  std::size_t bytes = 0;  ///< its length, set by read_header
};

[[nodiscard]] std::string header_bytes(const StreamHeader& header);
/// InputError as decode_terrain().
[[nodiscard]] StreamHeader read_header(std::span<const std::byte> stream, int max_bits);

}  // namespace etalon::terrain
