#include <fmt/format.h>

#include "core/terrain/level_coder.h"
#include "core/terrain/terrain_stream.h"

namespace etalon::terrain {

namespace {

void require_levels(const HeightField& field, const Levels& levels) {
  if (levels.bits != field.bits || levels.first_level.size() != field.point_count() || levels.count() < 1 || levels.count() > kMaxLevels)
    throw InputError(fmt::format("terrain stream: expected 1 to {} levels of a grid of k = {}, got {} of k = {}", kMaxLevels, field.bits,
                                 levels.count(), levels.bits));
  for (std::uint32_t v = 0; v < levels.first_level.size(); ++v) {
    const GridPoint p = point_at(field.bits, v);
    const Split split = split_of(field.bits, p);
    bool is_open = split.level < 0 && levels.first_level[v] != 0;
    if (split.level >= 0)
      for_each_parent(field.bits, p, split,
                      [&](GridPoint q) { is_open = is_open || levels.first_level[point_index(field.bits, q)] > levels.first_level[v]; });
    if (is_open) throw InputError(fmt::format("terrain stream: a level has point {}, {} without its parents", p.i, p.j));
  }
}

// The counts that the points' first levels give.
bool counts_fit(const Levels& levels) {
  std::vector<std::uint32_t> counts(levels.count(), 0);
  for (const std::uint16_t first : levels.first_level)
    if (first < counts.size()) ++counts[first];
  for (std::size_t l = 1; l < counts.size(); ++l) counts[l] += counts[l - 1];
  return counts == levels.vertex_counts;
}

// Seven bits a byte, the lowest first.
void append_length(std::size_t length, std::string& bytes) {
  for (; length >= 128; length >>= 7) bytes += static_cast<char>((length & 127) | 128);
  bytes += static_cast<char>(length);
}

}  // namespace

TerrainStream encode_terrain(const HeightField& field, const Levels& levels, const std::optional<TerrainView>& view) {
  validate(field);
  require_levels(field, levels);
  if (!counts_fit(levels)) throw InputError("terrain stream: the levels' vertex counts are not those of their points");
  StreamHeader header;
  header.grid = field;
  header.grid.heights.clear();
  header.level_count = levels.count();
  header.view = view;
  bool first = true;
  for (std::uint32_t v = 0; v < field.heights.size(); ++v) {
    if (levels.first_level[v] >= levels.count()) continue;
    header.lowest = first ? field.heights[v] : std::min(header.lowest, field.heights[v]);
    header.highest = first ? field.heights[v] : std::max(header.highest, field.heights[v]);
    first = false;
  }
  TerrainStream stream;
  stream.bytes = header_bytes(header);
  LevelCoder coder(header);
  EncodeSide side;
  for (std::size_t level = 0; level < levels.count(); ++level) {
    const std::uint32_t before = coder.vertex_count();
    if (level == 0) coder.corners(side, &field);
    std::string segment;
    if (before != levels.vertex_counts[level]) {
      coder.level(
          side, static_cast<std::uint16_t>(level), [&](std::uint32_t v) { return levels.first_level[v] <= level; }, &field);
      segment = side.coder.finish();
    }
    append_length(segment.size(), stream.bytes);
    stream.bytes += segment;
    stream.level_ends_bytes.push_back(stream.bytes.size());
  }
  return stream;
}

}  // namespace etalon::terrain
