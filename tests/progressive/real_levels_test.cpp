// Progressive meshes of real models: every level is what direct simplification has there, seams stay closed, and all the way up is the input.
#include <doctest/doctest.h>

#include <cstdlib>
#include <cstring>

#include "core/io/mesh_file.h"
#include "core/mesh/weld.h"
#include "core/progressive/epm_format.h"
#include "core/simplify/extract.h"
#include "tests/mesh/tiny_meshes.h"
#include "tests/support/skip.h"

using namespace etalon;
using namespace etalon::progressive;

namespace {

bool full_suite() { return std::getenv("ETALON_FULL") != nullptr && *std::getenv("ETALON_FULL") != '\0'; }

std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 31)) * 0x9E3779B97F4A7C15ull;
  return x ^ (x >> 29);
}

/// A digest of everything a mesh holds: for telling thousands of levels apart, not against forgery.
class Digest {
 public:
  explicit Digest(const Mesh& mesh) {
    bytes(mesh.positions);
    bytes(mesh.colors);
    for (const Wedge& w : mesh.wedges) {
      number(w.vertex.index);
      std::uint32_t uv[2];
      std::memcpy(uv, &w.uv, sizeof uv);
      number(uv[0]);
      number(uv[1]);
    }
    for (const auto& face : mesh.faces)
      for (const WedgeId w : face) number(w.index);
    bytes(mesh.face_materials);
  }
  [[nodiscard]] std::uint64_t value() const { return state_; }

 private:
  void number(std::uint32_t x) { state_ = mixed(state_ + x); }
  template <class T>
  void bytes(const std::vector<T>& values) {
    std::vector<std::uint32_t> words(values.size() * sizeof(T) / 4);
    if (!values.empty()) std::memcpy(words.data(), values.data(), words.size() * 4);
    number(static_cast<std::uint32_t>(words.size()));
    for (const std::uint32_t w : words) number(w);
  }
  std::uint64_t state_ = 1;
};

/// Whether each edge is run as often one way as the other: the sum of a hash of the edge, positive for one way and negative for the other, is 0.
bool closed(const Mesh& mesh) {
  std::uint64_t sum = 0;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
    for (int k = 0; k < 3; ++k) {
      const std::uint64_t a = mesh.vertex(FaceId(f), k).index, b = mesh.vertex(FaceId(f), (k + 1) % 3).index;
      sum += a < b ? mixed(a << 32 | b) : 0 - mixed(b << 32 | a);
    }
  return sum == 0;
}

/// Welded, with texture coordinates v up; nothing where it is absent.
std::optional<Mesh> real_mesh(const std::string& path, bool flip) {
  const auto file = test::data_file(path);
  if (!file) return std::nullopt;
  io::LoadedModel model = io::read_mesh(*file);
  if (flip) io::flip_v(model.mesh);
  return welded_by_position(model.mesh);
}

/// The digest of the mesh after each collapse of one direct run, every `step`-th from the end on; by level.
std::vector<std::pair<std::size_t, std::uint64_t>> direct_levels(const Mesh& mesh, std::size_t collapses, std::size_t step,
                                                                 simplify::SimplifyOptions options) {
  std::vector<std::pair<std::size_t, std::uint64_t>> levels;
  std::size_t done = 0;
  options.after_collapse = [&](const simplify::CollapseMesh& triangles) {
    const std::size_t level = collapses - ++done;
    if (level % step != 0) return;
    simplify::SimplifyResult result;
    extract(triangles, result);
    levels.emplace_back(level, Digest(result.mesh).value());
  };
  (void)simplify::simplify_mesh(mesh, options);
  return levels;
}

void check_levels(const Mesh& mesh, bool is_closed, std::size_t step, std::size_t separate_runs,
                  simplify::SimplifyOptions options = {.target_faces = 0}) {
  ProgressiveMesh progressive(make_progressive(mesh, options).data);
  const std::size_t top = progressive.split_count();
  const auto direct = direct_levels(mesh, top, step, options);
  REQUIRE(direct.size() == (top - 1) / step + 1);
  for (const auto& [level, digest] : direct) {  // downwards
    progressive.go_to(level);
    const Mesh here = progressive.mesh();
    const std::size_t captured = level;
    CAPTURE(captured);
    REQUIRE(Digest(here).value() == digest);
    REQUIRE(progressive.violation() == "");
    if (is_closed) REQUIRE(closed(here));
  }
  for (std::size_t i = 0; i <= separate_runs; ++i) {  // upwards, against runs of their own, byte for byte
    progressive.go_to(top * i / separate_runs);
    options.target_faces = progressive.face_count();
    REQUIRE(progressive.mesh() == simplify::simplify_mesh(mesh, options).mesh);
  }
  CHECK(progressive.mesh() == mesh);
}

}  // namespace

TEST_CASE("the digest and the sum see a difference") {
  const Mesh square = test::square();
  Mesh other = square;
  CHECK(Digest(square).value() == Digest(other).value());
  other.positions[2].z = -0.0f;
  CHECK(Digest(square).value() != Digest(other).value());
  other = square;
  std::swap(other.faces[0], other.faces[1]);
  CHECK(Digest(square).value() != Digest(other).value());
  CHECK_FALSE(closed(square));
  other = square;
  for (const auto& face : square.faces) other.faces.push_back({face[0], face[2], face[1]});
  CHECK(closed(other));
  other.faces.pop_back();
  CHECK_FALSE(closed(other));
}

TEST_CASE("spot: every level is the one of direct simplification, closed, and the last is the input") {
  const auto mesh = real_mesh("spot/spot_triangulated.obj", false);
  if (!mesh) return test::report_skip("spot at every level", "no spot_triangulated.obj under $ETALON_DATA");
  check_levels(*mesh, true, 1, full_suite() ? 200 : 10);
}

TEST_CASE("the head: every level is the one of direct simplification, closed, and the last is the input") {
  const auto mesh = real_mesh("lee_perry_smith/LeePerrySmith.glb", true);
  if (!mesh) return test::report_skip("the head at every level", "no LeePerrySmith.glb under $ETALON_DATA");
  check_levels(*mesh, true, 1, full_suite() ? 100 : 5);
}

TEST_CASE("spot and the head by full-edge collapses: the same") {
  const auto spot = real_mesh("spot/spot_triangulated.obj", false), head = real_mesh("lee_perry_smith/LeePerrySmith.glb", true);
  if (!spot || !head) return test::report_skip("full-edge levels of spot and the head", "not under $ETALON_DATA");
  using simplify::CollapseKind, simplify::MetricName;
  check_levels(*spot, true, full_suite() ? 1 : 10, 4, {.metric = MetricName::qem5, .collapse = CollapseKind::full, .target_faces = 0});
  check_levels(*head, true, full_suite() ? 1 : 50, 3, {.metric = MetricName::qem, .collapse = CollapseKind::full, .target_faces = 0});
}

TEST_CASE("a Kinect frame: levels far apart, and the last is the input") {
  const auto mesh = real_mesh("milk_carton/milk_carton_grid.ply", false);
  if (!mesh) return test::report_skip("the milk carton's levels", "no milk_carton_grid.ply under $ETALON_DATA");
  check_levels(*mesh, false, full_suite() ? 1'000 : 40'000, full_suite() ? 20 : 2);
}

TEST_CASE("spot's file: cut at and around every block it opens at its last whole one") {
  const auto mesh = real_mesh("spot/spot_triangulated.obj", false);
  if (!mesh) return test::report_skip("spot's file, cut", "no spot_triangulated.obj under $ETALON_DATA");
  const std::string file = encode_epm(make_progressive(*mesh, {.target_faces = 0}).data);
  const auto opened = [&](std::size_t size) { return decode_epm(std::as_bytes(std::span(file.data(), size))); };
  const EpmContent whole = opened(file.size());
  std::size_t blocks = 0;
  for (std::size_t at = 8, chunk = 0; at + 16 <= file.size(); ++chunk) {
    std::uint64_t size = 0;
    std::memcpy(&size, file.data() + at + 8, 8);
    at += 16 + size;
    if (chunk < 2 || at == file.size()) continue;  // HEAD, BASE; DONE
    for (const std::size_t cut : {at - 1, at, at + 1}) {
      const EpmContent part = opened(cut);
      CHECK_FALSE(part.complete);
      CHECK(part.splits_in_whole == whole.mesh.split_count());
      CHECK(part.mesh.split_count() == std::min((blocks + (cut >= at ? 1 : 0)) * kEpmBlockSplits, whole.mesh.split_count()));
    }
    ++blocks;
  }
  CHECK(blocks == (whole.mesh.split_count() + kEpmBlockSplits - 1) / kEpmBlockSplits);
}
