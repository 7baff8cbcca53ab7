#include <fmt/format.h>

#include "core/terrain/level_coder.h"
#include "core/terrain/terrain_stream.h"

namespace etalon::terrain {

namespace {

struct Segment {
  std::span<const std::byte> bytes;
  std::size_t end = 0;
};

// The segment that begins at `at`, or nothing where it is cut.
std::optional<Segment> segment_at(std::span<const std::byte> stream, std::size_t at) {
  std::size_t length = 0;
  for (int i = 0;; ++i) {
    if (at == stream.size()) return std::nullopt;
    const auto byte = std::to_integer<std::size_t>(stream[at++]);
    length |= (byte & 127) << (7 * i);
    if (byte < 128) {
      if (byte == 0 && i > 0) throw InputError(fmt::format("terrain stream: byte {}: expected the shortest form of a length", at - 1));
      break;
    }
    if (i == 4) throw InputError(fmt::format("terrain stream: byte {}: expected a length of at most 5 bytes", at - 1));
  }
  if (length > stream.size() - at) return std::nullopt;
  return Segment{stream.subspan(at, length), at + length};
}

}  // namespace

DecodedTerrain decode_terrain(std::span<const std::byte> bytes, const DecodeLimits& limits) {
  const StreamHeader header = read_header(bytes, limits.max_bits);
  std::size_t at = header.bytes;
  if (!segment_at(bytes, at))
    throw InputError(fmt::format("terrain stream: byte {}: expected at least the whole first level, got {} bytes", at, bytes.size() - at));
  LevelCoder coder(header);
  DecodedTerrain result;
  result.levels.bits = header.grid.bits;
  result.view = header.view;
  result.levels_in_whole = header.level_count;
  while (result.levels.count() < header.level_count) {
    const std::optional<Segment> segment = segment_at(bytes, at);
    if (!segment) break;
    const auto level = static_cast<std::uint16_t>(result.levels.count());
    if (!segment->bytes.empty()) {
      const std::uint32_t before = coder.vertex_count();
      DecodeSide side(segment->bytes, segment->end - segment->bytes.size());
      if (level == 0) coder.corners(side, nullptr);
      coder.level(
          side, level, [](std::uint32_t) { return false; }, nullptr);
      side.check(side.coder.at_end() && coder.vertex_count() > before);
    } else if (level == 0) {
      throw InputError(fmt::format("terrain stream: byte {}: expected a first level, got none", at));
    }
    result.levels.vertex_counts.push_back(coder.vertex_count());
    at = segment->end;
  }
  result.is_complete = result.levels.count() == header.level_count;
  if (result.is_complete && at != bytes.size())
    throw InputError(fmt::format("terrain stream: byte {}: expected the end of the stream, got {} more bytes", at, bytes.size() - at));
  result.bytes_used = at;
  result.field = coder.take_field();
  result.levels.first_level = coder.take_first_level();
  return result;
}

}  // namespace etalon::terrain
