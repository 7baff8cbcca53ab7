#include "core/progressive/progressive_mesh.h"

#include <doctest/doctest.h>

#include <limits>
#include <stdexcept>

#include "core/base/error.h"
#include "tests/simplify/sample_meshes.h"

using namespace etalon;
using namespace etalon::progressive;
using simplify::CollapseKind;
using simplify::MetricName;
using namespace etalon::test;

namespace {

ProgressiveData data_of(const Mesh& mesh) { return make_progressive(mesh, {.target_faces = 0}).data; }

/// Goes through all levels, up and down; returns what they are made of.
ProgressiveData check_all_levels(const Mesh& mesh, const simplify::SimplifyOptions& options) {
  const ProgressiveResult made = make_progressive(mesh, options);
  ProgressiveMesh progressive(made.data);
  CHECK(progressive.level() == 0);
  CHECK(progressive.mesh() == made.simplified.mesh);
  CHECK(progressive.split_count() == made.simplified.collapse_count);
  std::vector<Mesh> up;
  for (std::size_t level = 0; level <= progressive.split_count(); ++level) {
    progressive.go_to(level);
    REQUIRE(progressive.violation() == "");
    up.push_back(progressive.mesh());
    if (level % 7 != 0 && level != progressive.split_count()) continue;
    simplify::SimplifyOptions direct = options;
    direct.target_faces = progressive.face_count();
    REQUIRE(up.back() == simplify::simplify_mesh(mesh, direct).mesh);
  }
  CHECK(up.back().face_count() == mesh.face_count());
  for (std::size_t level = progressive.split_count() + 1; level-- > 0;) {
    progressive.go_to(level);
    REQUIRE(progressive.mesh() == up[level]);
  }
  return made.data;
}

/// The first split that has two corners on its left side.
VertexSplit& with_corners(ProgressiveData& data) {
  for (VertexSplit& split : data.splits)
    if (split.right_corner >= split.first_corner + 2) return split;
  throw std::runtime_error("no split has two corners");
}

/// What is said about the data of a seamed grid after `damage`; "" where it passes.
template <class Damage>
std::string message_after(const Damage& damage) {
  ProgressiveData data = data_of(seamed_grid(4, 0.2f, 4));
  damage(data);
  try {
    const ProgressiveMesh mesh(std::move(data));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("every level is a mesh, and the one that direct simplification gives, on the way up and down") {
  for (const NamedMesh& sample : sample_meshes())
    for (const CollapseKind collapse : {CollapseKind::half, CollapseKind::full}) {
      CAPTURE(sample.name);
      CAPTURE(to_string(collapse));
      check_all_levels(sample.mesh, {.collapse = collapse, .target_faces = 0});
    }
}

TEST_CASE("full-edge collapses by every metric that knows them: both old vertices come back with all they had") {
  Mesh mesh = seamed_grid(6, 0.2f, 4);
  for (const Vec3f& p : mesh.positions) mesh.colors.push_back({0.5f + 0.1f * p.x, 0.5f + 0.1f * p.y, 0.5f + 0.2f * p.z, 0.75f});
  for (const MetricName metric : {MetricName::qem, MetricName::qem5, MetricName::qem6, MetricName::hoppe}) {
    CAPTURE(to_string(metric));
    const ProgressiveData data = check_all_levels(mesh, {.metric = metric, .collapse = CollapseKind::full, .target_faces = 0});
    CHECK(data.moves.size() > 5);
    std::size_t on_seam = 0;
    for (const ParentMove& move : data.moves) on_seam += move.wedge[0] != kNone && move.wedge[1] != kNone ? 1 : 0;
    CHECK(on_seam > 0);
  }
}

TEST_CASE("the finest level is the input, byte for byte in canonical order") {
  for (const NamedMesh& sample : sample_meshes()) {
    CAPTURE(sample.name);
    ProgressiveMesh progressive(data_of(sample.mesh));
    progressive.go_to(progressive.split_count());
    const Mesh canonical = simplify::simplify_mesh(sample.mesh, {.target_faces = sample.mesh.face_count()}).mesh;
    CHECK(progressive.mesh() == canonical);
    if (sample.name != "seamed grid") CHECK(canonical == sample.mesh);  // the seamed grid has wedges of no face
  }
}

TEST_CASE("colours and materials come along") {
  Mesh grid = bumpy_grid(6, 0.2f, 3);
  for (const Vec3f& p : grid.positions) grid.colors.push_back({p.x, p.y, p.z, 1});
  for (std::size_t f = 0; f < grid.face_count(); ++f) grid.face_materials.push_back(f % 12 < 6 ? 1 : 0);
  ProgressiveMesh progressive(data_of(grid));
  progressive.go_to(progressive.split_count());
  CHECK(progressive.mesh() == grid);
}

TEST_CASE("by face count: the finest level that is not above it") {
  const Mesh grid = bumpy_grid(8, 0.3f, 2);
  ProgressiveMesh progressive(data_of(grid));
  for (const std::size_t faces : {128u, 127u, 60u, 33u, 9u}) {
    progressive.go_to_faces(faces);
    CAPTURE(faces);
    CHECK(progressive.face_count() <= faces);
    CHECK(progressive.mesh() == simplify::simplify_mesh(grid, {.target_faces = faces}).mesh);
  }
  progressive.go_to_faces(0);
  CHECK(progressive.level() == 0);
  progressive.go_to_faces(100000);
  CHECK(progressive.level() == progressive.split_count());
  CHECK_THROWS_AS(progressive.go_to(progressive.split_count() + 1), InternalError);
}

TEST_CASE("hooks of the caller are still called; an unwelded mesh is refused") {
  const Mesh grid = bumpy_grid(4, 0.2f, 2);
  std::size_t calls = 0;
  simplify::SimplifyOptions options{.target_faces = 10};
  options.before_collapse = [&](const simplify::CollapseMesh&, const simplify::CollapseEvent&) { ++calls; };
  CHECK(make_progressive(grid, options).simplified.collapse_count == calls);
  Mesh unwelded = grid;
  for (auto& face : unwelded.faces)
    for (WedgeId& w : face) {
      unwelded.wedges.push_back(unwelded.wedges[w.index]);
      w = WedgeId(unwelded.wedge_count() - 1);
    }
  CHECK_THROWS_AS((void)make_progressive(unwelded, {.target_faces = 0}), InputError);
}

TEST_CASE("data that is no progressive mesh is refused, and says what is wrong") {
  CHECK(message_after([](ProgressiveData&) {}) == "");
  const auto says = [](const std::string& message, const std::string& part) {
    CAPTURE(message);
    CAPTURE(part);
    CHECK(message.find(part) != std::string::npos);
  };
  says(message_after([](ProgressiveData& d) { d.positions.pop_back(); }), "vertices: expected");
  says(message_after([](ProgressiveData& d) { d.vertex_ids.pop_back(); }), "vertex ids: expected");
  says(message_after([](ProgressiveData& d) { d.has_colors = true; }), "colours: expected");
  says(message_after([](ProgressiveData& d) { d.wedge_ids.pop_back(); }), "wedge ids: expected");
  says(message_after([](ProgressiveData& d) { d.face_ids.pop_back(); }), "face ids: expected");
  says(message_after([](ProgressiveData& d) { d.has_materials = true; }), "materials: expected");
  says(message_after([](ProgressiveData& d) { d.base_faces = 0; }), "base: expected");
  says(message_after([](ProgressiveData& d) { d.positions[3].x = std::numeric_limits<float>::infinity(); }), "vertex 3: position");
  says(message_after([](ProgressiveData& d) {
         d.has_colors = true;
         d.colors.assign(d.positions.size(), {0, 0, 0, 1});
         d.colors[1].z = std::numeric_limits<float>::quiet_NaN();
       }),
       "vertex 1: colour");
  says(message_after([](ProgressiveData& d) { d.wedges[2].uv.y = std::numeric_limits<float>::quiet_NaN(); }), "wedge 2: uv");
  says(message_after([](ProgressiveData& d) { d.wedges[0].vertex = VertexId(d.base_vertices); }), "wedge 0: vertex");
  says(message_after([](ProgressiveData& d) { d.faces[0][1] = d.base_wedges; }), "face 0: wedge");
  says(message_after([](ProgressiveData& d) { d.faces[0][1] = d.faces[0][0]; }), "face 0: expected three vertices");
  says(message_after([](ProgressiveData& d) {
         d.wedges.insert(d.wedges.begin(), d.wedges[0]);
         d.wedge_ids.insert(d.wedge_ids.begin(), 1'000'000);
         ++d.base_wedges;
         for (auto& face : d.faces)
           for (std::uint32_t& w : face) ++w;
         for (VertexSplit& s : d.splits) {
           ++s.first_wedge;
           for (std::size_t side = 0; side < 2; ++side) {
             if (s.wedge[side] != kNone) ++s.wedge[side];
             if (s.wedge_of_parent[side] != kNone) ++s.wedge_of_parent[side];
           }
         }
       }),
       "wedge 0: expected a face of the base that has it");
  says(message_after([](ProgressiveData& d) {
         d.positions.insert(d.positions.begin(), d.positions[0]);
         d.vertex_ids.insert(d.vertex_ids.begin(), 1'000'000);
         ++d.base_vertices;
         for (Wedge& w : d.wedges) w.vertex = VertexId(w.vertex.index + 1);
         for (VertexSplit& s : d.splits) ++s.parent;
       }),
       "vertex 0: expected a face of the base that has it");
  says(message_after([](ProgressiveData& d) {
         d.material_names = {"a"};
         d.has_materials = true;
         d.materials.assign(d.faces.size(), 1);
       }),
       "face 0: material: expected below 1, got 1");
  says(message_after([](ProgressiveData& d) { d.material_names = {"a\tb"}; }), "material 0: expected a name");
  says(message_after([](ProgressiveData& d) { d.vertex_ids[1] = d.vertex_ids[0]; }), "expected once, got twice");
  says(message_after([](ProgressiveData& d) { d.splits[1].parent = d.base_vertices + 1; }), "split 1: parent");
  says(message_after([](ProgressiveData& d) { d.splits[0].first_face += 1; }), "split 0: expected to follow the base");
  says(message_after([](ProgressiveData& d) { d.splits[2].first_face = d.splits[1].first_face; }), "split 1: faces");
  says(message_after([](ProgressiveData& d) { d.splits[2].first_wedge = 0; }), "split 1: wedges");
  says(message_after([](ProgressiveData& d) { d.wedges[d.splits[1].first_wedge].vertex = VertexId(d.positions.size() - 1); }),
       "split 1: wedge");
  says(message_after([](ProgressiveData& d) { d.faces[d.splits[0].first_face][0] = 1000000; }), "split 0: face");
  says(message_after([](ProgressiveData& d) { d.faces[d.splits[0].first_face][0] = d.faces[d.splits[0].first_face][1]; }),
       "three vertices");
  says(message_after([](ProgressiveData& d) { d.splits[0].parent = d.splits[0].parent == 0 ? 1 : 0; }), "split 0: ");
  says(message_after([](ProgressiveData& d) { d.splits[0].end_corner = 1000000; }), "split 0: corners");
  says(message_after([](ProgressiveData& d) { d.corners[with_corners(d).first_corner] |= 3; }), "corner: expected of a face below");
  says(message_after([](ProgressiveData& d) { with_corners(d).wedge = {kNone, kNone}; }), "wedges: expected of");
  says(message_after([](ProgressiveData& d) { d.corners[with_corners(d).first_corner + 1] = d.corners[with_corners(d).first_corner]; }),
       "corners: expected each once");
  says(message_after([](ProgressiveData& d) { d.corners[with_corners(d).first_corner] ^= 3; }), "corner");
  says(message_after([](ProgressiveData& d) { d.moves.resize(1); }), "moves: expected 1 splits that name one, got 0");
}

TEST_CASE("moves that are none are refused, and say what is wrong") {
  const auto message_with = [](const auto& damage) -> std::string {
    ProgressiveData data = make_progressive(seamed_grid(6, 0.2f, 4), {.collapse = CollapseKind::full, .target_faces = 0}).data;
    std::size_t first = 0;
    while (data.splits[first].move == kNone || data.moves[data.splits[first].move].wedge[0] == kNone) ++first;
    damage(data, data.splits[first], data.moves[data.splits[first].move]);
    try {
      const ProgressiveMesh mesh(std::move(data));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const auto says = [](const std::string& message, const std::string& part) {
    CAPTURE(message);
    CAPTURE(part);
    CHECK(message.find(part) != std::string::npos);
  };
  const float bad = std::numeric_limits<float>::quiet_NaN();
  CHECK(message_with([](auto&, auto&, auto&) {}) == "");
  says(message_with([](auto&, auto& split, auto&) { ++split.move; }), "move: expected ");
  says(message_with([](auto& data, auto&, auto&) { data.moves.pop_back(); }), "move: expected ");
  says(message_with([&](auto&, auto&, auto& move) { move.position.y = bad; }), "position of the parent: expected finite");
  says(message_with([&](auto&, auto&, auto& move) { move.uv[0].y = bad; }), "uv of the parent: expected finite");
  says(message_with([&](auto& data, auto&, auto& move) {
         data.has_colors = true, data.colors.assign(data.positions.size(), {0, 0, 0, 1});
         move.color.x = bad;
       }),
       "colour of the parent: expected finite");
  says(message_with([](auto& data, auto&, auto& move) { move.wedge[0] = static_cast<std::uint32_t>(data.wedges.size()); }),
       "moved wedge: expected one of the parent");
  says(message_with([](auto&, auto&, auto& move) { move.wedge[1] = move.wedge[0]; }), "moved wedge: expected one of the parent");
  says(message_with([](auto& data, auto& split, auto& move) {
         while (data.wedges[move.wedge[0]].vertex.index == split.parent) move.wedge[0] = (move.wedge[0] + 1) % data.base_wedges;
       }),
       "moved wedge: expected one of the parent");
}
