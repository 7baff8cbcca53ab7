#include "core/joint/joint_stream.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>

#include "core/base/error.h"
#include "core/base/rng.h"
#include "core/joint/marginal_analysis.h"

using namespace etalon;
using namespace etalon::joint;

namespace {

/// A hill with a ridge, 33² points 10 m apart.
terrain::HeightField small_field() {
  terrain::HeightField field{.bits = 5, .spacing = 10, .unit = 0x1p-6, .uv_start = 0.5 / 33, .uv_step = 1.0 / 33, .heights = {}};
  Rng rng(9);
  for (int j = 0; j < 33; ++j)
    for (int i = 0; i < 33; ++i) {
      const int hill = 20 * 64 - 2 * ((i - 16) * (i - 16) + (j - 12) * (j - 12)), ridge = std::max(0, 300 - 100 * std::abs(i + j - 30));
      field.heights.push_back(hill + ridge + static_cast<int>(rng.below(40)));
    }
  return field;
}

Image small_image(int width, int height) {
  Image image(width, height, kRgb8);
  Rng rng(4);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      auto* texel = image.channels<std::uint8_t>(x, y);
      for (int c = 0; c < 3; ++c) texel[c] = static_cast<std::uint8_t>((x * 5 + y * (3 + c)) / 3 % 200 + static_cast<int>(rng.below(30)));
    }
  return image;
}

terrain::TerrainView small_view() {
  return {.eye = {0, 120, 260},
          .target = {0, 20, 0},
          .up = {0, 1, 0},
          .tan_half_fov_y = 0.5,
          .near = 1,
          .far = 2000,
          .width = 64,
          .height = 48};
}

JointLevels small_levels() {
  return make_joint_levels(small_field(), small_image(48, 40), small_view(), {.meshes = 6, .textures = 5, .from = 0.01, .to = 0.4});
}

/// Mesh and texture by turns.
Path zigzag(const JointLevels& levels) {
  Problem problem = problem_of(levels, [&](std::size_t i, std::size_t j) -> std::uint64_t { return i * 10 > j * 11 ? 1 : 2; });
  return marginal_analysis(problem);
}

bool full_suite() { return std::getenv("ETALON_FULL") != nullptr && *std::getenv("ETALON_FULL") != '\0'; }

/// A file changed at one to four places, or cut.
std::vector<std::byte> mutant(std::vector<std::byte> bytes, Rng& rng) {
  const std::uint64_t kind = rng.below(4);
  if (kind == 0) {
    bytes.resize(rng.below(bytes.size()));
    return bytes;
  }
  for (std::uint64_t n = 1 + rng.below(4); n > 0; --n) {
    std::byte& b = bytes[rng.below(bytes.size())];
    b = kind == 1 ? b ^ static_cast<std::byte>(1u << rng.below(8)) : static_cast<std::byte>(rng.below(256));
  }
  return bytes;
}

/// Checksums made right again, so that what lies behind them is reached.
void repair(std::vector<std::byte>& bytes) {
  const auto crc = [&](std::size_t begin, std::size_t length) {
    std::uint32_t state = 0xFFFFFFFFu;
    for (std::size_t n = begin; n < begin + length; ++n) {
      state ^= std::to_integer<std::uint32_t>(bytes[n]);
      for (int k = 0; k < 8; ++k) state = (state & 1) != 0 ? (state >> 1) ^ 0xEDB88320u : state >> 1;
    }
    return ~state;
  };
  const auto put = [&](std::size_t at, std::uint32_t value) {
    for (std::size_t n = 0; n < 4; ++n) bytes[at + n] = static_cast<std::byte>((value >> (8 * n)) & 0xFF);
  };
  if (bytes.size() < kJointHeaderBytes) return;
  put(16, crc(0, 16));
  for (std::size_t at = kJointHeaderBytes; at + kSegmentHeadBytes <= bytes.size();) {
    std::size_t length = 0;
    for (std::size_t n = 4; n-- > 0;) length = (length << 8) | std::to_integer<std::size_t>(bytes[at + 1 + n]);
    if (bytes.size() - at - kSegmentHeadBytes < length) return;
    put(at + 5, crc(at + kSegmentHeadBytes, length));
    at += kSegmentHeadBytes + length;
  }
}

}  // namespace

TEST_CASE("every point of the path is a prefix of the file, as long as its bits say, and opens as that pair") {
  const JointLevels levels = small_levels();
  REQUIRE(levels.mesh_bits.size() == 6);
  REQUIRE(levels.texture_bits.size() == 5);
  const std::vector<Image> textures = texture_levels(levels);
  const Path path = zigzag(levels);
  const std::vector<std::byte> file = encode_joint(levels, path);
  CHECK(8 * file.size() == path.points.back().bits);
  for (const PathPoint& point : path.points) {
    REQUIRE(point.bits % 8 == 0);
    const DecodedJoint decoded = decode_joint(std::span(file).first(point.bits / 8));
    CHECK(decoded.pair == point.pair);
    CHECK(decoded.bytes_used == point.bits / 8);
    CHECK(decoded.is_complete == (point.bits == path.points.back().bits));
    CHECK(decoded.texture == textures[point.pair.texture]);
    CHECK(decoded.mesh_levels == 6);
    CHECK(decoded.texture_levels == 5);
    const Mesh mesh = terrain::level_mesh(decoded.terrain.field, decoded.terrain.levels, point.pair.mesh),
               encoded = terrain::level_mesh(levels.field, levels.levels, point.pair.mesh);
    CHECK(mesh.positions == encoded.positions);
    CHECK(mesh.faces == encoded.faces);
    REQUIRE(decoded.terrain.view.has_value());
    CHECK(*decoded.terrain.view == small_view());
  }
}

TEST_CASE("textures by distance: every level is from nearer than the one before, and the file says of which pyramid they are") {
  const LevelOptions options{.meshes = 4, .textures = 9, .from = 0.01, .to = 0.4, .pyramid = TexturePyramid::distance};
  const JointLevels levels = make_joint_levels(small_field(), small_image(48, 40), small_view(), options);
  const std::size_t count = levels.texture_bits.size();
  REQUIRE(count >= 3);
  CHECK(distance_of(levels, count - 1) == 1);
  for (std::size_t j = 1; j < count; ++j) {
    CHECK(distance_of(levels, j) < distance_of(levels, j - 1));
    CHECK(levels.significant[j] >= levels.significant[j - 1]);
  }
  CHECK(distance_of(levels, 0) <= 10.1);  // 2^(10/3) = 10.08
  CHECK(distance_of(small_levels(), 0) == 1);
  const std::vector<Image> textures = texture_levels(levels);
  const Path path = zigzag(levels);
  std::vector<std::byte> file = encode_joint(levels, path);
  CHECK(file[14] == std::byte{8});
  for (const PathPoint& point : path.points)
    CHECK(decode_joint(std::span(file).first(point.bits / 8)).texture == textures[point.pair.texture]);

  // Another pyramid's delays have another checksum; one of more steps than delays can hold is refused before they are made.
  for (const int steps : {0, 7, 43}) {
    file[14] = static_cast<std::byte>(steps);
    repair(file);
    CHECK_THROWS_AS((void)decode_joint(file), InputError);
  }
  for (const std::size_t textures_asked : {std::size_t{1}, kMostDistances + 1}) {
    LevelOptions wrong = options;
    wrong.textures = textures_asked;
    CHECK_THROWS_AS((void)make_joint_levels(small_field(), small_image(48, 40), small_view(), wrong), InputError);
  }
}

TEST_CASE("any prefix opens at its last whole segment; one without a whole pair is refused") {
  const JointLevels levels = small_levels();
  const Path path = zigzag(levels);
  const std::vector<std::byte> file = encode_joint(levels, path);
  for (std::size_t length = 0; length <= file.size(); ++length) {
    const std::span<const std::byte> prefix = std::span(file).first(length);
    const PathPoint* point = nullptr;
    for (const PathPoint& p : path.points)
      if (p.bits / 8 <= length) point = &p;
    if (point == nullptr) {
      CHECK_THROWS_AS((void)decode_joint(prefix), InputError);
      continue;
    }
    const DecodedJoint decoded = decode_joint(prefix);
    CHECK(decoded.pair == point->pair);
    CHECK(decoded.bytes_used == point->bits / 8);
  }
}

TEST_CASE("changed files are refused or give a valid pair") {
  const JointLevels levels = small_levels();
  const std::vector<std::byte> file = encode_joint(levels, zigzag(levels));
  const int count = full_suite() ? 1'000'000 : 20'000;
  Rng rng(77);
  int refused = 0;
  for (int n = 0; n < count; ++n) {
    std::vector<std::byte> bytes = mutant(file, rng);
    if (n % 2 == 1) repair(bytes);
    try {
      const DecodedJoint decoded = decode_joint(bytes, {.max_texels = 1 << 16});
      const Mesh mesh = terrain::level_mesh(decoded.terrain.field, decoded.terrain.levels, decoded.pair.mesh);
      CHECK(mesh.faces.size() >= 2);
      CHECK_FALSE(decoded.texture.empty());
      CHECK(decoded.bytes_used <= bytes.size());
    } catch (const InputError&) {
      ++refused;
    }
  }
  CHECK(refused > count / 4);
  CHECK(refused < count);
}

TEST_CASE("each way a file can be wrong is named with its byte") {
  const JointLevels levels = small_levels();
  const std::vector<std::byte> file = encode_joint(levels, zigzag(levels));
  const auto message = [](std::vector<std::byte> bytes) -> std::string {
    try {
      (void)decode_joint(bytes);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const auto changed = [&](std::size_t at, int value) {
    std::vector<std::byte> bytes = file;
    bytes[at] = static_cast<std::byte>(value);
    return bytes;
  };
  CHECK(message({}) == "joint stream: byte 0: expected a header of 20 bytes");
  CHECK(message(changed(3, 'x')) == "joint stream: byte 3: not the signature of a joint stream");
  CHECK(message(changed(9, 1)) == "joint stream: byte 16: the header's checksum is wrong");
  CHECK(message(changed(20, 'X')) == "joint stream: byte 20: no segment of a mesh or texture");
  CHECK(message(changed(30, 1 + std::to_integer<int>(file[30]))) == "joint stream: byte 25: the segment's checksum is wrong");
  std::vector<std::byte> longer = file;
  longer.push_back(std::byte{0});
  CHECK(message(longer) == "joint stream: byte " + std::to_string(file.size()) + ": bytes behind the last segment");
  std::vector<std::byte> none = changed(8, 0);
  repair(none);
  CHECK(message(none) == "joint stream: byte 8: expected 1 to 65535 levels, got 0 and 5");
  std::vector<std::byte> fewer = changed(8, 1);
  repair(fewer);
  CHECK(message(fewer).ends_with("more segments than levels"));
  std::vector<std::byte> more = changed(8, 7);
  repair(more);
  CHECK(message(more) == "joint stream: 6 mesh segments hold 6 levels of 7");
}

TEST_CASE("paths that a file cannot follow are refused") {
  const JointLevels levels = small_levels();
  CHECK_THROWS_AS((void)encode_joint(levels, {}), InputError);
  CHECK_THROWS_AS((void)encode_joint(levels, {{{{0, 1}, 0, {}}}, 0}), InputError);
  CHECK_THROWS_AS((void)encode_joint(levels, {{{{0, 0}, 0, {}}, {{2, 0}, 0, {}}, {{0, 1}, 0, {}}}, 0}), InputError);
  CHECK_THROWS_AS((void)encode_joint(levels, {{{{0, 0}, 0, {}}, {{6, 0}, 0, {}}}, 0}), InputError);
}

TEST_CASE("levels that come out equal are one") {
  // 1000 counts between 11 and 109 points, 400 shares of few coefficients.
  const JointLevels levels =
      make_joint_levels(small_field(), small_image(16, 16), small_view(), {.meshes = 1000, .textures = 400, .from = 0.01, .to = 0.1});
  CHECK(levels.mesh_bits.size() < 110);
  CHECK(levels.texture_bits.size() < 100);
  CHECK(levels.texture_bits.size() > 3);
  for (std::size_t n = 1; n < levels.mesh_bits.size(); ++n) CHECK(levels.mesh_bits[n] > levels.mesh_bits[n - 1]);
  for (std::size_t n = 1; n < levels.texture_bits.size(); ++n) CHECK(levels.texture_bits[n] > levels.texture_bits[n - 1]);
}

TEST_CASE("a view of nothing, a picture that is none: refused") {
  terrain::TerrainView away = small_view();
  away.target = {0, 120, 500};
  CHECK_THROWS_AS((void)make_joint_levels(small_field(), small_image(32, 32), away), InputError);
  CHECK_THROWS_AS((void)make_joint_levels(small_field(), Image(8, 8, kRg32f), small_view()), InputError);
  // Grey 128 is the level that both kernels code as 0: there is nothing to send, and the message says so. Grey 127 has a coefficient.
  Image grey = small_image(32, 32);
  std::ranges::fill(grey.bytes(), std::byte{128});
  CHECK_THROWS_WITH_AS((void)make_joint_levels(small_field(), grey, small_view()), doctest::Contains("of one grey, 128"), InputError);
  std::ranges::fill(grey.bytes(), std::byte{127});
  CHECK(make_joint_levels(small_field(), grey, small_view()).significant_total > 0);
  CHECK_THROWS_AS((void)make_joint_levels(small_field(), small_image(32, 32), small_view(), {.from = 0}), InputError);
}
