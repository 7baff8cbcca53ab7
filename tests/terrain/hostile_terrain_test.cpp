// Streams that are cut, damaged or made up: refused, or a valid terrain; never a crash and never much memory.
#include <doctest/doctest.h>

#include <cstdlib>

#include "core/base/error.h"
#include "core/base/rng.h"
#include "core/base/sha256.h"
#include "core/mesh/adjacency.h"
#include "core/terrain/removal_order.h"
#include "core/terrain/terrain_stream.h"
#include "tests/terrain/terrain_fixture.h"

using namespace etalon;
using namespace etalon::terrain;

namespace {

constexpr DecodeLimits kSmall{.max_bits = 5};
constexpr std::size_t kPlainEnd = 49, kViewEnd = 149;  // where the checksum stands

std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

// Its checksum made right again, so that the levels are decoded under a damaged header.
void repair_header(std::string& stream) {
  const std::size_t end = stream.size() > 5 && (stream[5] & 1) != 0 ? kViewEnd : kPlainEnd;
  if (stream.size() < end + 4) return;
  const std::string digits = sha256_hex(bytes_of(stream).first(end)).substr(0, 8);
  const unsigned long check = std::stoul(digits, nullptr, 16);
  for (std::size_t i = 0; i < 4; ++i) stream[end + i] = static_cast<char>((check >> (8 * i)) & 0xFF);
}

std::string small_stream(bool has_view, std::uint64_t seed) {
  const HeightField field = test::rough_field(4, seed);
  const Levels levels = make_levels(4, removal_order(field), std::vector<std::uint32_t>{5, 9, 9, 30, 80, 200, 289});
  return encode_terrain(with_unit(field, 1), levels, has_view ? std::optional(test::low_view(field)) : std::nullopt).bytes;
}

// True if it was decoded; then it is a terrain without cracks within its own limits.
bool decodes(const std::string& stream, bool looks_close) {
  try {
    const DecodedTerrain decoded = decode_terrain(bytes_of(stream), kSmall);
    validate(decoded.field);
    REQUIRE(decoded.levels.count() >= 1);
    if (looks_close) {
      const Mesh mesh = level_mesh(decoded.field, decoded.levels, decoded.levels.count() - 1);
      REQUIRE(mesh.vertex_count() == decoded.levels.vertex_counts.back());
      REQUIRE(Adjacency(mesh).boundary_loops().size() == 1);
    }
    return true;
  } catch (const InputError&) {
    return false;
  }
}

std::string refusal_of(const std::string& stream) {
  try {
    (void)decode_terrain(bytes_of(stream), kSmall);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("hostile terrain: each field of the header is checked, and named") {
  const std::string good = small_stream(true, 1);
  const auto refusal = [&](std::size_t at, int value, bool is_repaired = true) {
    std::string bad = good;
    bad[at] = static_cast<char>(value);
    if (is_repaired) repair_header(bad);
    return refusal_of(bad);
  };
  CHECK(refusal_of(good) == "");
  CHECK(refusal_of("") == "terrain stream: byte 0: expected 1 more bytes of the header, got 0");
  CHECK(refusal(0, 'x') == "terrain stream: byte 0: expected the signature eTTM");
  CHECK(refusal(4, 2) == "terrain stream: byte 4: expected version 1, got 2");
  CHECK(refusal(5, 3) == "terrain stream: byte 5: expected flags 0 or 1, got 3");
  CHECK(refusal(6, 6) == "terrain stream: byte 6: expected a grid of k 2 to 5, got 6");
  CHECK(refusal(6, 1) == "terrain stream: byte 6: expected a grid of k 2 to 5, got 1");
  CHECK(refusal(7, 0) == "terrain stream: byte 7: expected 1 to 4096 levels, got 0");
  CHECK(refusal(8, 255) == "terrain stream: byte 7: expected 1 to 4096 levels, got 65287");
  CHECK(refusal(16, 255).find("terrain stream: header: height field: expected spacing and unit") == 0);
  CHECK(refusal(44, 127).find("terrain stream: byte 41: expected heights from lowest to highest") == 0);
  CHECK(refusal(52, 1, false) == "terrain stream: byte 149: the header's checksum is wrong");
  std::string blind = good;
  for (std::size_t i = 0; i < 24; ++i) blind[kPlainEnd + 24 + i] = blind[kPlainEnd + i];  // target = eye
  repair_header(blind);
  CHECK(refusal_of(blind) == "terrain stream: header: view: expected a target away from the eye");
}

TEST_CASE("hostile terrain: segments that are none") {
  const std::string good = small_stream(false, 1);
  const std::size_t body = kPlainEnd + 4;
  CHECK(refusal_of(good + "x").find("expected the end of the stream, got 1 more bytes") != std::string::npos);
  CHECK(refusal_of(good.substr(0, body)).find("expected at least the whole first level, got 0 bytes") != std::string::npos);
  CHECK(refusal_of(good.substr(0, body) + std::string(1, '\0')) == "terrain stream: byte 53: expected a first level, got none");
  CHECK(refusal_of(good.substr(0, body) + "\x81" + std::string(1, '\0')).find("the shortest form of a length") != std::string::npos);
  CHECK(refusal_of(good.substr(0, body) + std::string(5, '\xFF')).find("a length of at most 5 bytes") != std::string::npos);
  // A byte too many in a segment, and one that asks for more than it holds.
  std::string longer = good.substr(0, body);
  const auto first = static_cast<std::size_t>(good[body]);
  longer += static_cast<char>(first + 2);
  longer += good.substr(body + 1, first) + "xy";
  CHECK(refusal_of(longer).find("terrain stream: byte 54: expected a level, got bytes that are none") == 0);
  CHECK(refusal_of(good.substr(0, body) + "\x01" + std::string(1, '\0')).find("bytes that are none") != std::string::npos);
}

TEST_CASE("mutants are refused or decode to a terrain without cracks") {
  std::vector<std::string> seeds;
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    for (const bool has_view : {false, true}) seeds.push_back(small_stream(has_view, seed));
  Rng rng(2026);
  const char* full = std::getenv("ETALON_FULL");
  const int mutants = full != nullptr && *full != '\0' ? 1'000'000 : 20'000;
  int decoded = 0, refused = 0;
  for (int i = 0; i < mutants; ++i) {
    std::string stream = seeds[rng.below(seeds.size())];
    if (rng.coin()) stream.resize(1 + rng.below(stream.size()));
    const std::size_t body = (stream.size() > 5 && (stream[5] & 1) != 0 ? kViewEnd : kPlainEnd) + 4;
    for (std::uint64_t n = rng.below(4); n > 0; --n) {
      const bool in_body = stream.size() > body && rng.below(4) != 0;
      const std::size_t at = in_body ? body + rng.below(stream.size() - body) : rng.below(stream.size());
      const std::uint64_t kind = rng.below(4);
      if (kind == 0) stream[at] = static_cast<char>(rng.next() & 0xFF);
      if (kind == 1) stream[at] = static_cast<char>(stream[at] ^ (1 << rng.below(8)));
      if (kind == 2) stream.insert(at, 1, static_cast<char>(rng.next() & 0xFF));
      if (kind == 3 && stream.size() > 1) stream.erase(at, 1);
    }
    if (rng.below(4) != 0) repair_header(stream);
    (decodes(stream, i % 16 == 0) ? decoded : refused) += 1;
  }
  // Both must occur often, or the mutants test nothing.
  CHECK(decoded > mutants / 10);
  CHECK(refused > mutants / 10);
}
