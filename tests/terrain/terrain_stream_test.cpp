#include "core/terrain/terrain_stream.h"

#include <doctest/doctest.h>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/sha256.h"
#include "core/terrain/quadtree.h"
#include "core/terrain/removal_order.h"
#include "tests/support/skip.h"
#include "tests/terrain/terrain_fixture.h"

using namespace etalon;
using namespace etalon::terrain;

namespace {

std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

// What the first `count` levels say, as a decoder of a prefix knows it.
void check_decoded(const DecodedTerrain& decoded, const HeightField& field, const Levels& levels, std::size_t count) {
  REQUIRE(decoded.levels.count() == count);
  CHECK(decoded.levels_in_whole == levels.count());
  CHECK(decoded.is_complete == (count == levels.count()));
  for (std::size_t l = 0; l < count; ++l) CHECK(decoded.levels.vertex_counts[l] == levels.vertex_counts[l]);
  for (std::size_t v = 0; v < field.heights.size(); ++v) {
    const bool is_there = levels.first_level[v] < count;
    CHECK(decoded.levels.first_level[v] == (is_there ? levels.first_level[v] : kNoLevel));
    CHECK(decoded.field.heights[v] == (is_there ? field.heights[v] : 0));
  }
  CHECK(level_mesh(decoded.field, decoded.levels, count - 1) == level_mesh(field, levels, count - 1));
}

}  // namespace

TEST_CASE("terrain stream: every level that went in comes out, byte for byte, with and without a view, of any rule and size") {
  for (const int bits : {2, 3, 6})
    for (const bool has_view : {false, true})
      for (const PruningRule rule : {PruningRule::merging_domains, PruningRule::saturated}) {
        const HeightField field = bits == 3 ? test::random_field(bits, kMaxHeight - 1, 5) : test::rough_field(bits);
        std::optional<TerrainView> view;
        if (has_view) view = test::low_view(field);
        const RemovalOrder order = removal_order(field, {.rule = rule});
        const auto all = static_cast<std::uint32_t>(field.point_count());
        const Levels levels = make_levels(bits, order, std::vector<std::uint32_t>{5, 5, 6, all / 3, all / 3, all / 2, all});
        const TerrainStream stream = encode_terrain(field, levels, view);
        REQUIRE(stream.level_ends_bytes.size() == 7);
        CHECK(stream.level_ends_bytes[1] == stream.level_ends_bytes[0] + 1);  // a level that adds nothing is one byte
        CHECK(stream.level_ends_bytes.back() == stream.bytes.size());
        const DecodedTerrain decoded = decode_terrain(bytes_of(stream.bytes));
        check_decoded(decoded, field, levels, 7);
        CHECK(decoded.view == view);
        CHECK(decoded.field == field);
        CHECK(encode_terrain(decoded.field, decoded.levels, decoded.view).bytes == stream.bytes);
      }
}

TEST_CASE("terrain stream: the coarsest level may be the four corners, the field flat") {
  const HeightField flat = test::random_field(2, 0, 1);
  const Levels corners = make_levels(2, removal_order(flat), std::vector<std::uint32_t>{4});
  const TerrainStream stream = encode_terrain(flat, corners);
  check_decoded(decode_terrain(bytes_of(stream.bytes)), flat, corners, 1);
}

TEST_CASE("terrain stream: every prefix of the bytes opens at its last whole level, or is refused before the first") {
  const HeightField field = test::rough_field(4);
  const Levels levels = make_levels(4, removal_order(field), std::vector<std::uint32_t>{6, 10, 10, 40, 90, 200});
  for (const bool has_view : {false, true}) {
    const TerrainStream stream = encode_terrain(field, levels, has_view ? std::optional(test::low_view(field)) : std::nullopt);
    for (std::size_t kept = 0; kept <= stream.bytes.size(); ++kept) {
      std::size_t whole = 0;
      while (whole < 6 && stream.level_ends_bytes[whole] <= kept) ++whole;
      const auto prefix = bytes_of(stream.bytes).first(kept);
      if (whole == 0) {
        CHECK_THROWS_AS((void)decode_terrain(prefix), InputError);
        continue;
      }
      const DecodedTerrain decoded = decode_terrain(prefix);
      check_decoded(decoded, field, levels, whole);
      CHECK(decoded.bytes_used == stream.level_ends_bytes[whole - 1]);
    }
  }
}

TEST_CASE("terrain stream: the bytes are the same everywhere, for any number of threads") {
  const HeightField field = test::rough_field(7);
  const TerrainView view = test::low_view(field);
  for (const int threads : {1, 3}) {
    set_thread_count(threads);
    const Levels surface = make_levels(7, removal_order(field), geometric_counts(7, 0.002, 0.2, 20));
    const std::vector<double> weights = screen_weights(field, view);
    const Levels screen = make_levels(7, removal_order(field, {.weights = weights}), geometric_counts(7, 0.002, 0.2, 20));
    CHECK(sha256_hex(bytes_of(encode_terrain(field, surface).bytes)) == "e4ea3ad0d07ab85922690f9f232a154162e7be95ce2e5575b8b6a5049986c36b");
    CHECK(sha256_hex(bytes_of(encode_terrain(field, screen, view).bytes)) ==
          "23235dd15541bff8d5767fdbe6902891305843b05183b0f38883bfa0c18a195c");
  }
  set_thread_count(0);
}

TEST_CASE("terrain stream: davosdorf's sixty levels in less than 10 bits a vertex, heights in metres") {
  const auto field = test::davosdorf();
  if (!field) return test::report_skip("davosdorf's stream", "davosdorf/davosdorf.tif is not there");
  const HeightField metres = with_unit(*field, 1);
  const Levels levels = make_levels(8, removal_order(*field), geometric_counts(8));
  const TerrainStream stream = encode_terrain(metres, levels);
  check_decoded(decode_terrain(bytes_of(stream.bytes)), metres, levels, 60);
  CHECK(8 * stream.bytes.size() < 10 * levels.vertex_counts.back());
}

TEST_CASE("terrain stream: what cannot be coded is refused") {
  const HeightField field = test::rough_field(3);
  const Levels good = make_levels(3, removal_order(field), std::vector<std::uint32_t>{9, 30});
  Levels bad = good;
  bad.first_level.assign(81, kNoLevel);
  CHECK_THROWS_AS((void)encode_terrain(field, bad), InputError);  // no corners
  bad = good;
  bad.first_level[point_index(3, {4, 4})] = 1;  // the middle of all, later than its children
  CHECK_THROWS_AS((void)encode_terrain(field, bad), InputError);
  CHECK_THROWS_AS((void)encode_terrain(test::rough_field(2), good), InputError);
  bad = good;
  bad.vertex_counts.clear();
  CHECK_THROWS_AS((void)encode_terrain(field, bad), InputError);
  bad = good;
  bad.vertex_counts = {9, 31};
  CHECK_THROWS_AS((void)encode_terrain(field, bad), InputError);
  HeightField broken = field;
  broken.unit = 0;
  CHECK_THROWS_AS((void)encode_terrain(broken, good), InputError);
  TerrainView nowhere = test::low_view(field);
  nowhere.target = nowhere.eye;
  CHECK_THROWS_AS((void)encode_terrain(field, good, nowhere), InputError);
}
