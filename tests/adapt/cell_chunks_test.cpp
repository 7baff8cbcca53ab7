// Cells in files: what is read is what was made, and everything else is refused.
#include "core/adapt/cell_chunks.h"

#include <doctest/doctest.h>

#include <optional>
#include <string>

#include "core/adapt/cell_statistics.h"
#include "core/base/error.h"
#include "core/base/rng.h"
#include "core/io/mesh_file.h"
#include "core/mesh/weld.h"
#include "core/procedural/head.h"
#include "core/procedural/swirl.h"
#include "tests/support/skip.h"

using namespace etalon;
using namespace etalon::adapt;
using progressive::EpmExtra;
using progressive::kEpmBlockSplits;

namespace {

using simplify::CollapseKind;

progressive::ProgressiveData levels_of(const Mesh& mesh, std::size_t faces, CollapseKind collapse = CollapseKind::half) {
  simplify::SimplifyOptions options;
  options.metric = simplify::MetricName::qem5;
  options.target_faces = faces;
  options.collapse = collapse;
  return progressive::make_progressive(welded_by_position(mesh), options).data;
}

const progressive::ProgressiveData& head_levels() {
  static const progressive::ProgressiveData levels = levels_of(procedural::make_head({.faces = 2000, .texture_size = 64}).mesh, 200);
  return levels;
}

const std::vector<EpmExtra>& head_chunks() {
  static const std::vector<EpmExtra> chunks = [] {
    progressive::ProgressiveMesh mesh(head_levels());
    return encode_cells(AdaptSequence(mesh));
  }();
  return chunks;
}

// As of a whole file.
progressive::EpmContent content_of(const progressive::ProgressiveData& data, std::vector<EpmExtra> chunks) {
  return {progressive::ProgressiveMesh(data), data.splits.size(), true, std::move(chunks)};
}
progressive::EpmContent head(std::vector<EpmExtra> chunks) { return content_of(head_levels(), std::move(chunks)); }

std::string message_of(const std::vector<EpmExtra>& chunks) {
  try {
    progressive::EpmContent content = head(chunks);
    (void)decode_cells(content);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

template <class Damage>
std::string message_after(const Damage& damage) {
  std::vector<EpmExtra> chunks = head_chunks();
  damage(chunks);
  return message_of(chunks);
}

void check_says(const std::string& message, const std::string& part) {
  CAPTURE(message);
  CAPTURE(part);
  CHECK(message.find(part) != std::string::npos);
}

// Where ring records of a chunk begin: behind rules, checksum and the first split's number of rings.
constexpr std::size_t kFirstRing = 6;

struct Model {
  std::string name;
  std::optional<Mesh> mesh;
  CollapseKind collapse = CollapseKind::half;
};

std::optional<Mesh> real_mesh(const std::string& path, bool flip) {
  const auto file = test::data_file(path);
  if (!file) return std::nullopt;
  io::LoadedModel model = io::read_mesh(*file);
  if (flip) io::flip_v(model.mesh);
  return model.mesh;
}

}  // namespace

TEST_CASE("cells in files: what is read is what was made, and no cell of any record is folded") {
  const Mesh swirl = procedural::make_swirl().mesh;
  const auto spot = real_mesh("spot/spot_triangulated.obj", false), scan = real_mesh("lee_perry_smith/LeePerrySmith.glb", true);
  const Model models[] = {{"swirl", swirl},
                          {"procedural head", procedural::make_head().mesh},
                          {"spot", spot},
                          {"head", scan},
                          {"swirl, full-edge", swirl, CollapseKind::full},
                          {"spot, full-edge", spot, CollapseKind::full},
                          {"head, full-edge", scan, CollapseKind::full}};
  for (const Model& model : models) {
    CAPTURE(model.name);
    if (!model.mesh) {
      test::report_skip("cells of all records: " + model.name, "not under $ETALON_DATA");
      continue;
    }
    const progressive::ProgressiveData data = levels_of(*model.mesh, 0, model.collapse);
    progressive::ProgressiveMesh mesh(data);
    const AdaptSequence made(mesh);
    const std::string file = progressive::encode_epm(data, encode_cells(made));
    progressive::EpmContent content = progressive::decode_epm(std::as_bytes(std::span(file)));
    const auto read = decode_cells(content);
    REQUIRE(read);
    CHECK(content.mesh.level() == 0);
    std::size_t different = 0;
    for (std::size_t n = 0; n < made.size(); ++n) different += made.split(n) == read->split(n) ? 0 : 1;
    CHECK(different == 0);
    const CellStatistics s = cell_statistics(*read);
    CHECK(s.folded_cells == 0);
    CHECK(s.rings[static_cast<std::size_t>(CellStatus::no_fan)] == 0);
    CHECK(s.made() > data.splits.size() * 95 / 100);
    const auto splits = static_cast<double>(s.splits);
    const double file_bytes = static_cast<double>(cell_chunk_bytes(content.extras)) / splits,
                 memory_bytes = static_cast<double>(s.memory_bytes) / splits;
    CHECK(file_bytes <= 60);
    if (model.collapse == CollapseKind::half) CHECK(memory_bytes <= 200);
    MESSAGE(model.name << ": " << s.splits << " splits, " << s.cells << " cells, " << s.folded_cells
                       << " folded; bytes a split: " << file_bytes << " in the file, " << memory_bytes << " in memory; u damped "
                       << s.damped_places << ", crossings damped " << s.damped_crossings << ", mean shares " << s.mean_place_share
                       << " and " << s.mean_crossing_share);
  }
}

TEST_CASE("cells in files: a prefix of a file has the cells of its splits") {
  const std::string file = progressive::encode_epm(head_levels(), head_chunks());
  progressive::EpmContent all = head(head_chunks());
  const auto whole = decode_cells(all);
  REQUIRE(whole);
  std::size_t opened = 0, without_last_cells = 0;
  for (std::size_t size = file.size(); size-- > file.size() / 2;) {  // cuts in the finer half
    if (size % 7 != 0) continue;
    progressive::EpmContent part = progressive::decode_epm(std::as_bytes(std::span(file.data(), size)));
    const auto cells = decode_cells(part);
    REQUIRE(cells);
    REQUIRE(cells->size() == part.mesh.split_count());
    ++opened;
    const std::size_t with_cells = part.extras.size() * kEpmBlockSplits;
    without_last_cells += with_cells < cells->size() ? 1 : 0;
    for (std::size_t n = 0; n < cells->size(); n += 13)
      REQUIRE(cells->split(n) == (n < with_cells ? whole->split(n) : std::vector<ChartCells>{}));
  }
  CHECK(opened > 100);
  CHECK(without_last_cells > 10);
}

TEST_CASE("cells in files: what is wrong is said") {
  REQUIRE(head_chunks().size() > 3);
  CHECK(message_of(head_chunks()) == "");
  check_says(message_after([](auto& c) { c.erase(c.begin() + 1); }),
             "CELL of splits 64 to 128: expected a chunk for each block of splits, got none here");
  check_says(message_after([](auto& c) { c.insert(c.begin() + 1, c[0]); }), "CELL of splits up to 64: expected once, got twice");
  check_says(message_after([](auto& c) { c[0].after_splits = 0; }), "expected behind a block of splits");
  check_says(message_after([](auto& c) { c[0].payload[0] = 2; }), "CELL of splits 0 to 64: rules: expected 1, got 2");
  check_says(message_after([](auto& c) { c[0].payload[1] ^= 1; }), "checksum of the cells: expected");
  check_says(message_after([](auto& c) { c[0].payload.pop_back(); }), "more bytes, got");
  check_says(message_after([](auto& c) { c[0].payload += 'x'; }), "expected the end of the chunk, got 1 more bytes");
  check_says(message_after([](auto& c) { c[0].payload[kFirstRing] = 9; }), "status: expected below 5, got 9");
  check_says(message_after([](auto& c) { c[0].payload[kFirstRing + 1] = 0x3F; }),
             "shares: expected below 6 and 7, plane below 3, got 7, 7, 0");
  check_says(message_after([](auto& c) { c[0].payload.replace(kFirstRing + 2, 4, "\0\0\x80\x7F", 4); }), "place of u: expected finite");
  check_says(message_after([](auto& c) { c[0].payload.replace(kFirstRing + 2, 4, "\0\0\x80\x41", 4); }),
             "place of u: expected one that leaves all cells positive, got 16");
  check_says(message_after([](auto& c) {
               c[0].payload.erase(kFirstRing + 1, 9);  // a ring that has cells, said to be a fold
               c[0].payload[kFirstRing] = 1;
             }),
             "status: expected made or no_place for this ring, got fold");
  check_says(message_after([](auto& c) {
               c[0].payload.insert(kFirstRing, 1, '\2');
               c[0].payload[kFirstRing - 1] += 1;
             }),
             "rings: expected ");
  for (const std::vector<EpmExtra>& none : {std::vector<EpmExtra>{}, {{"BMAP", 0, "map"}}}) {
    progressive::EpmContent content = head(none);
    CHECK_FALSE(decode_cells(content));
  }
  progressive::ProgressiveData bare = head_levels();
  bare.has_uv = false;
  progressive::EpmContent without = content_of(bare, head_chunks());
  CHECK_THROWS_WITH_AS((void)decode_cells(without), "CELL: expected a mesh with texture coordinates, got one without", InputError);
}

TEST_CASE("cells in files: mutants of chunks, and chunks at another mesh, are refused or are the cells") {
  Rng rng(21);
  progressive::EpmContent content = head(head_chunks());
  int refused = 0, unchanged = 0;
  for (int i = 0; i < 400; ++i) {
    content.extras = head_chunks();
    std::string& payload = content.extras[rng.below(content.extras.size())].payload;
    const std::string before = payload;
    for (std::uint64_t n = 1 + rng.below(3); n-- > 0;) {
      const std::size_t at = rng.below(payload.size());
      payload[at] = static_cast<char>(rng.coin() ? payload[at] ^ (1 << rng.below(8)) : static_cast<char>(rng.below(256)));
    }
    try {
      (void)decode_cells(content);
      REQUIRE(payload == before);
      ++unchanged;
    } catch (const InputError&) {
      ++refused;
    }
  }
  CHECK(refused > 380);
  // The mesh of the file may be a mutant too: what passes as a mesh is gone through without harm.
  int meshes = 0;
  for (int i = 0; i < 300; ++i) {
    progressive::ProgressiveData data = head_levels();
    for (std::uint64_t n = 1 + rng.below(3); n-- > 0;) {
      if (rng.coin()) {
        data.wedges[rng.below(data.wedges.size())].uv = {rng.uniform(-1, 2), rng.uniform(-1, 2)};
      } else {
        auto& split = data.splits[rng.below(data.splits.size())];
        std::swap(split.wedge[0], split.wedge[1]), std::swap(split.wedge_of_parent[0], split.wedge_of_parent[1]);
        split.right_corner = rng.coin() ? split.first_corner : split.end_corner;
        std::reverse(data.corners.begin() + split.first_corner, data.corners.begin() + split.end_corner);
      }
    }
    try {
      progressive::EpmContent other = content_of(data, head_chunks());
      ++meshes;
      (void)cell_statistics(AdaptSequence(other.mesh));
      (void)decode_cells(other);
    } catch (const InputError&) {
    }
  }
  CHECK(meshes > 50);
}
