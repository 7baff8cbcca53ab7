// FILE.draws: what is written is read again, what a stranger writes is understood, and everything that is wrong is named.
#include "core/io/draws_file.h"

#include <doctest/doctest.h>

#include <array>
#include <limits>

#include "core/base/sha256.h"
#include "core/draw/scene.h"
#include "core/io/image_file.h"
#include "core/io/inputs.h"
#include "tests/io/draws_builder.h"
#include "tests/io/image_builder.h"
#include "tests/io/scratch.h"

namespace etalon::io {
namespace {

using namespace test;

constexpr PixelFormat kRg16{ChannelType::unorm16, 2};

DrawsFile decoded(const std::string& bytes) {
  return decode_draws(std::as_bytes(std::span(bytes)), "a.draws", "", [](const auto&, const auto&) { return Image(2, 2, kRgba8); });
}

std::string refusal(const std::string& bytes) {
  return input_error([&] { (void)decoded(bytes); });
}

// What is said about the small header with `from` replaced by `to`.
std::string header_refusal(const std::string& from, const std::string& to) {
  REQUIRE(small_header().find(from) != std::string::npos);
  return refusal(draws_bytes(replaced(small_header(), from, to), small_arrays()));
}

DrawList every_shading(std::vector<std::shared_ptr<const Image>> images) {
  DrawList list;
  list.vertices = {{.x = 0, .y = 0, .z = 0.25f, .w = 1, .uv = {0, 0}, .color = {1, 0, 0, 1}},
                   {.x = 160, .y = -32, .z = 0.5f, .w = 2, .uv = {1, 0.1f}, .color = {0, 1, 0, 0.5f}},
                   {.x = 3, .y = 79, .z = 1, .w = 0.5f, .uv = {-3, 0.7f}, .color = {0, 0, 1, 1}}};
  list.triangles = {{0, 1, 2}, {2, 1, 0}, {1, 2, 0}};
  list.images = std::move(images);
  const Sampler linear{Filter::linear, Wrap::repeat, Wrap::mirrored_repeat};
  list.draws = {
      {.first_triangle = 0, .triangle_count = 1},
      {.first_triangle = 1, .triangle_count = 1, .shading = Shading::texture, .texture = 0, .sampler = linear},
      {.first_triangle = 2, .triangle_count = 1, .shading = Shading::indexed, .texture = 1, .indexing_map = 2, .map_sampler = linear}};
  return list;
}

TEST_CASE("draws: a list is read as it was written, with images of every type") {
  const ScratchFolder folder;
  Frame frame{.width = 8,
              .height = 5,
              .guard = 32,
              .state = {},
              .targets = {{TargetContent::color, kRgba32f, {0.1f, 0, -2, 1}}, {TargetContent::triangle_id, kR32ui, {}}}};
  frame.state = {4, SnapRounding::floor, FillRule::right_ymax, HalfRounding::toward_zero, CullMode::clockwise, false};
  const std::vector<PixelFormat> formats{
      kRgba8, {ChannelType::unorm8, 2}, {ChannelType::srgb8, 3}, {ChannelType::unorm16, 1}, kRg16, {ChannelType::half, 4},
      kRg32f, {ChannelType::unorm8, 1}};
  for (std::size_t n = 0; n < formats.size(); ++n) {
    CAPTURE(to_string(formats[n]));
    const auto texture = std::make_shared<const Image>(random_image(5, 3, formats[n], n));
    const auto map = std::make_shared<const Image>(random_image(4, 4, kRg32f, n + 100));
    const DrawList list = every_shading({texture, texture, map});
    const std::string sha = write_draws(folder / "a.draws", list, frame);
    CHECK(sha == file_sha256(folder / "a.draws"));
    const DrawsFile file = read_draws(folder / "a.draws");
    CHECK(file.sha256 == sha);
    CHECK(file.list.vertices == list.vertices);
    CHECK(file.list.triangles == list.triangles);
    CHECK(file.list.draws == list.draws);
    CHECK(file.list.source_faces.empty());
    REQUIRE(file.list.images.size() == 3);
    for (std::size_t i = 0; i < 3; ++i) CHECK(*file.list.images[i] == *list.images[i]);
    CHECK(file.image_paths == draws_image_paths(folder / "a.draws", list));
    CHECK(file.frame.width == 8);
    CHECK(file.frame.height == 5);
    CHECK(file.frame.guard == 32);
    CHECK(file.frame.state == frame.state);
    CHECK(file.frame.targets == frame.targets);
  }
}

TEST_CASE("draws: an empty list has a file; vertices without a draw do not") {
  const ScratchFolder folder;
  write_draws(folder / "a.draws", {}, {});
  CHECK(read_draws(folder / "a.draws").list.draws.empty());
  DrawList list;
  list.vertices.resize(1);
  CHECK(write_error([&] { write_draws(folder / "b.draws", list, {}); }).find("vertices but no draw") != std::string::npos);
  CHECK(write_error([&] { write_draws(folder / "none" / "b.draws", {}, {}); }).find("cannot write") != std::string::npos);
}

TEST_CASE("draws: raster vertices, indices into an earlier draw, images with their first row on top") {
  const ScratchFolder folder;
  const Image picture = random_image(2, 3, kRgb8, 1);
  write_image(folder / "t.png", picture);
  std::string header = small_header(file_sha256(folder / "t.png"));
  header = replaced(
      header, R"("}],"draws":[)",
      R"(","first_row":"top","color_space":"srgb"}],"draws":[{"space":"raster","vertices":3,"triangles":0,"shading":"vertex_color"},)");
  folder.put("a.draws", draws_bytes(header, small_arrays().substr(0, 120) + small_arrays().substr(0, 120) + indices({5, 0, 1})));
  const DrawsFile file = read_draws(folder / "a.draws");
  CHECK(file.list.triangles == std::vector<std::array<std::uint32_t, 3>>{{5, 0, 1}});
  REQUIRE(file.list.draws.size() == 2);
  CHECK(file.list.draws[1].sampler == Sampler{});
  CHECK(file.list.images[0]->format() == PixelFormat{ChannelType::srgb8, 3});
  CHECK(file.list.images[0]->texel(0, 0)[0] == picture.texel(0, 2)[0]);  // row 0 is the file's top row
  CHECK(file.list.source_faces.empty());
}

TEST_CASE("draws: clip space is clipped and snapped as a mesh is") {
  // A square of two triangles that reaches behind the eye; the shared edge's ends stand twice in the file, as at a seam.
  const std::vector<std::array<float, 4>> corners{{-3, -3, -0.5f, 0.25f}, {3, -1, -0.9f, 1}, {-1, 2, 0.4f, -0.5f}, {2, 3, 0.5f, 2}};
  const auto record = [&](std::size_t n, float u) { return clip_record(corners[n][0], corners[n][1], corners[n][2], corners[n][3], u, 1); };
  const std::string shared = record(0, 0) + record(1, 1) + record(2, 2) + record(3, 3) + indices({0, 1, 2, 2, 1, 3});
  const std::string apart =
      record(0, 0) + record(1, 1) + record(2, 2) + record(2, 2) + record(1, 1) + record(3, 3) + indices({0, 1, 2, 3, 4, 5});
  std::string header = replaced(small_header(), R"("raster","vertices":3,"triangles":1)", R"("clip","vertices":4,"triangles":2)");
  const DrawsFile one = decoded(draws_bytes(header, shared));
  const DrawsFile two = decoded(draws_bytes(replaced(header, R"("vertices":4)", R"("vertices":6)"), apart));
  REQUIRE(one.list.triangles.size() >= 3);
  REQUIRE(one.list.triangles.size() == two.list.triangles.size());
  for (std::size_t t = 0; t < one.list.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) CHECK(one.list.vertices[one.list.triangles[t][k]] == two.list.vertices[two.list.triangles[t][k]]);
  CHECK(one.list.source_faces.front() == 0);
  CHECK(one.list.source_faces.back() == 1);
  CHECK(one.list.draws[0].triangle_count == one.list.triangles.size());

  // An uncut vertex: (0.3 / 1 + 1) / 2 · 8 texels = 5.2, in sub-texels 1331.2, rounded as the state says.
  const std::string inside = clip_record(0.3f, 0, 0, 1) + clip_record(0.5f, 0, 0, 1) + clip_record(0, 0.5f, 0, 1) + indices({0, 1, 2});
  header = replaced(small_header(), "\"raster\"", "\"clip\"");
  CHECK(decoded(draws_bytes(header, inside)).list.vertices[0].x == 1331);
  CHECK(decoded(draws_bytes(replaced(header, "\"subtexel_bits\":8", "\"subtexel_bits\":2"), inside)).list.vertices[0].x == 21);
  CHECK(decoded(draws_bytes(header, inside)).list.vertices[0].y == 1024);

  // Everything behind the eye: nothing is left, not even the draw.
  const std::string behind = clip_record(0, 0, 0, -1) + clip_record(1, 0, 0, -1) + clip_record(0, 1, 0, -1) + indices({0, 1, 2});
  CHECK(decoded(draws_bytes(header, behind)).list.draws.empty());
}

TEST_CASE("draws: a wrong field is named, with what was expected and got") {
  const std::vector<std::array<std::string, 3>> wrong{
      {"etalon/draws/1", "etalon/draws/2", "a.draws: schema: expected 'etalon/draws/1', got 'etalon/draws/2'"},
      {"\"width\":8", "\"width\":0", "a.draws: frame.width: expected 1 to 16384, got 0"},
      {"\"width\":8", "\"width\":8.5", "a.draws: frame.width: expected an integer from 0, got 8.5"},
      {"\"width\":8", "\"width\":16384", "a.draws: draw list: frame: expected"},
      {"\"guard\":16", "\"gaurd\":16", "a.draws: frame: expected one of width, height, guard, got a member 'gaurd'"},
      {"\"subtexel_bits\":8", "\"subtexel_bits\":17", "a.draws: state.subtexel_bits: expected 1 to 16, got 17"},
      {"\"cull\":\"none\",", "", "a.draws: state: expected a member 'cull', got none"},
      {"\"left_ymin\"", "\"top_left\"",
       "a.draws: state.fill_rule: expected one of left_ymin, left_ymax, right_ymin, right_ymax, got 'top_left'"},
      {"true}", "1}", "a.draws: state.depth_test: expected true or false, got number"},
      {"\"images\"", "\"pictures\"",
       "a.draws: header: expected one of schema, frame, state, targets, images, draws, got a member 'pictures'"},
      {"\"images\"", "\"targets\":[{\"content\":\"colour\",\"format\":\"rgba unorm8\"}],\"images\"",
       "a.draws: targets[0].content: expected one of color"},
      {"\"images\"", "\"targets\":[{\"content\":\"color\",\"format\":\"rgba8\"}],\"images\"",
       "a.draws: targets[0].format: expected channels and type"},
      {"\"images\"", "\"targets\":[{\"content\":\"depth\",\"format\":\"rgba unorm8\"}],\"images\"", "a.draws: draw list: target 0 (depth)"},
      {"\"images\"", "\"targets\":[{\"content\":\"color\",\"format\":\"rgba unorm8\",\"clear\":[0,0,1e99,0]}],\"images\"",
       "a.draws: targets[0].clear[2]: expected a number within float32"},
      {"\"images\"", "\"targets\":[{\"content\":\"color\",\"format\":\"rgba unorm8\",\"clear\":[0]}],\"images\"",
       "a.draws: targets[0].clear: expected 4 numbers, got 1"},
      {"\"images\"", "\"targets\":[{\"content\":\"color\",\"format\":\"r half\"},{\"content\":\"color\",\"format\":\"r half\"}],\"images\"",
       "a.draws: targets[1].content: expected each content once"},
      {"\"path\":\"t.png\"", "\"path\":\"\"", "a.draws: images[0].path: expected a file name"},
      {"\"path\":\"t.png\"", "\"path\":\"a\\u0000b\"",
       "a.draws: images[0].path: expected a file name without control characters, got 'a\\x00b'"},
      {"00\"}]", "0G\"}]", "a.draws: images[0].sha256: expected 64 hexadecimal digits"},
      {"00\"}]", "00\",\"first_row\":\"left\"}]", "a.draws: images[0].first_row: expected 'bottom' or 'top', got 'left'"},
      {"00\"}]", "00\",\"color_space\":\"gamma\"}]", "a.draws: images[0].color_space: expected 'linear' or 'srgb', got 'gamma'"},
      {"\"raster\"", "\"world\"", "a.draws: draws[0].space: expected 'clip' or 'raster', got 'world'"},
      {"\"shading\":\"texture\"", "\"shading\":\"vertex_color\"",
       "a.draws: draws[0]: expected one of space, vertices, triangles, shading, got a member 'sampler'"},
      {"\"texture\":0", "\"texture\":1", "a.draws: draws[0].texture: expected an image below 1, got 1"},
      {"\"filter\":\"nearest\"", "\"filter\":\"cubic\"", "a.draws: draws[0].sampler.filter: expected one of nearest, linear, got 'cubic'"},
      {"\"wrap_u\":\"clamp\",", "", "a.draws: draws[0].sampler: expected a member 'wrap_u', got none"},
      {"\"shading\":\"texture\"", "\"shading\":\"indexed\"", "a.draws: draws[0]: expected a member 'indexing_map', got none"},
      {"\"vertices\":3", "\"vertices\":-3", "a.draws: draws[0].vertices: expected an integer from 0, got -3"},
      {"\"vertices\":3", "\"vertices\":4294967295", "a.draws: draws[0].vertices: expected 0 to 4294967294"},
      {"\"vertices\":3", "\"vertices\":4", "a.draws: arrays: expected to end at byte"},
      {"\"triangles\":1", "\"triangles\":4294967294", "a.draws: arrays: expected to end at byte"},
      {"{\"schema\"", "[\"schema\"", "a.draws: header: expected JSON"},
  };
  for (const auto& row : wrong) {
    const std::string &from = row[0], &to = row[1], &message = row[2];
    const std::string said = header_refusal(from, to);
    CAPTURE(to);
    CHECK_MESSAGE(said.starts_with(message), said);
  }
  const std::string two = R"({"space":"raster","vertices":4294967294,"triangles":0,"shading":"vertex_color"},)";
  CHECK(header_refusal("\"draws\":[", "\"draws\":[" + two + two).starts_with("a.draws: draws: expected fewer than 2^32 - 1 vertices"));
}

TEST_CASE("draws: wrong arrays are named by draw, vertex or triangle, and byte") {
  const std::string header = small_header();
  const std::size_t begin = 16 + header.size();
  const auto with = [&](std::size_t at, auto value) {
    std::string arrays = small_arrays();
    std::memcpy(arrays.data() + at, &value, sizeof value);
    return refusal(draws_bytes(header, arrays));
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  CHECK(with(40 + 16, nan) == "a.draws: byte " + std::to_string(begin + 56) +
                                  ": draws[0], vertex 1: u: expected a finite number of at most 1099511600000, got nan");
  CHECK(with(80 + 36, -2e12f).find("draws[0], vertex 2: a: expected a finite number") != std::string::npos);
  CHECK(with(8, 1.5f).find("a.draws: draw list: vertex 0: expected z in [0, 1], got 1.5") != std::string::npos);
  CHECK(with(12, 0.0f).find("vertex 0: expected w in") != std::string::npos);
  CHECK(with(0, std::int32_t{1 << 20}).find("vertex 0: expected a position in") != std::string::npos);
  CHECK(with(124, std::uint32_t{3}) ==
        "a.draws: byte " + std::to_string(begin + 124) + ": draws[0], triangle 0: expected vertex indices below 3, got 3");
  CHECK(refusal("etalonDR") == "a.draws: expected the signature 'etalonDR' and the size of a header, got something else");
  CHECK(refusal(replaced(draws_bytes(header, small_arrays()), "etalonDR", "etalonPM")).find("expected the signature") != std::string::npos);
  std::string oversized = draws_bytes(header, small_arrays());
  oversized[14] = 1;
  CHECK(refusal(oversized).find("a.draws: byte 8: expected a header of at most") != std::string::npos);

  // A triangle in clip space cannot use a vertex that was given in raster space.
  const std::string mixed = replaced(header, "]}", R"(,{"space":"clip","vertices":1,"triangles":1,"shading":"vertex_color"}]})");
  CHECK(refusal(draws_bytes(mixed, small_arrays() + clip_record(0, 0, 0, 1) + indices({3, 3, 0})))
            .find("draws[1], triangle 0: expected a vertex of the same space, got 0") != std::string::npos);
  CHECK(refusal(draws_bytes(replaced(header, "\"raster\"", "\"clip\""),
                            clip_record(nan, 0, 0, 1) + clip_record(0, 0, 0, 1) + clip_record(0, 0, 0, 1) + indices({0, 1, 2})))
            .find("vertex 0: x: expected a finite number") != std::string::npos);
}

TEST_CASE("draws: an image that is missing, or another than was meant") {
  const ScratchFolder folder;
  folder.put("a.draws", draws_bytes(small_header(), small_arrays()));
  CHECK(input_error([&] { (void)read_draws(folder / "a.draws"); }).find("t.png: No such file") != std::string::npos);
  write_image(folder / "t.png", Image(2, 2, kRgba8));
  CHECK(input_error([&] { (void)read_draws(folder / "a.draws"); }).find("t.png: expected sha256 0000") != std::string::npos);
  const std::string sha = file_sha256(folder / "t.png");
  folder.put("a.draws", draws_bytes(small_header(sha), small_arrays()));
  CHECK(read_draws(folder / "a.draws").list.images.size() == 1);
  write_image(folder / "t.png", Image(2, 2, {ChannelType::unorm16, 4}));
  folder.put("a.draws",
             draws_bytes(replaced(small_header(file_sha256(folder / "t.png")), "\"}],\"draws\"", "\",\"color_space\":\"srgb\"}],\"draws\""),
                         small_arrays()));
  CHECK(input_error([&] { (void)read_draws(folder / "a.draws"); }).find("images[0].color_space: expected 8-bit texels") !=
        std::string::npos);
  folder.put("t.png", "not a picture");
  folder.put("a.draws", draws_bytes(small_header(file_sha256(folder / "t.png")), small_arrays()));
  CHECK(input_error([&] { (void)read_draws(folder / "a.draws"); }).find("t.png") != std::string::npos);
}

TEST_CASE("draws: cut short at every byte, and mutants: refused in one line, or read") {
  const std::string raster = draws_bytes(small_header(), small_arrays());
  const std::string clip =
      draws_bytes(replaced(small_header(), "\"raster\"", "\"clip\""),
                  clip_record(-2, 0, 0, 1) + clip_record(0.5f, 3, 0, 0.5f) + clip_record(0, 0.5f, 4, 1) + indices({0, 1, 2}));
  std::size_t read = 0, refused = 0;
  const auto attempt = [&](const std::string& bytes) {
    const std::string message = refusal(bytes);
    if (message == "no error") {
      ++read;
      return;
    }
    ++refused;
    CHECK_MESSAGE(message.starts_with("a.draws: "), message);
    CHECK_MESSAGE(message.find('\n') == std::string::npos, message);
    CHECK_MESSAGE(message.size() < 400, message);
  };
  for (const std::string& whole : {raster, clip}) {
    for (std::size_t n = 0; n < whole.size(); ++n) {
      refused = 0;
      attempt(whole.substr(0, n));
      CHECK(refused == 1);
    }
    Rng rng(7);
    for (int n = 0; n < 20000; ++n) {
      std::string mutant = whole;
      for (std::uint64_t k = 1 + rng.below(3); k > 0; --k) {
        const std::size_t at = rng.below(mutant.size());
        switch (rng.below(3)) {
          case 0: mutant[at] = static_cast<char>(rng.below(256)); break;
          case 1: mutant.erase(at, 1 + rng.below(4)); break;
          default: mutant.insert(at, mutant.substr(rng.below(mutant.size()), 1 + rng.below(8))); break;
        }
        if (mutant.empty()) mutant = "x";
      }
      attempt(mutant);
    }
  }
  CHECK(read > 500);
}

}  // namespace
}  // namespace etalon::io
