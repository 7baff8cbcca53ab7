#include "core/terrain/levels.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/draw/scene.h"
#include "core/mesh/adjacency.h"
#include "core/procedural/alps.h"
#include "core/terrain/quadtree.h"
#include "raster/cpu_renderer.h"
#include "tests/support/skip.h"
#include "tests/terrain/terrain_fixture.h"

using namespace etalon;
using namespace etalon::terrain;

namespace {

// Every edge has two faces but those of the square's border, which lie on it; all faces look up; their areas fill the square.
void check_no_cracks(const HeightField& field, const Mesh& mesh) {
  const double half = field.steps() / 2 * field.spacing;
  const Adjacency adjacency(mesh);
  double area = 0;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    const Vec3d a(mesh.position(FaceId(f), 0)), b(mesh.position(FaceId(f), 1)), c(mesh.position(FaceId(f), 2));
    const double up = (b.z - a.z) * (c.x - a.x) - (b.x - a.x) * (c.z - a.z);
    REQUIRE(up > 0);
    area += up / 2;
    for (int corner = 0; corner < 3; ++corner) {
      const HalfEdgeId h = Adjacency::half_edge(FaceId(f), corner);
      const auto edge = adjacency.half_edges(adjacency.edge(h));
      if (edge.size() == 2) {
        REQUIRE(adjacency.opposite(h).valid());
        continue;
      }
      REQUIRE(edge.size() == 1);
      const Vec3d p(mesh.positions[adjacency.start(h)]), q(mesh.positions[adjacency.end(h)]);
      const bool on_border = (p.x == q.x && std::fabs(p.x) == half) || (p.z == q.z && std::fabs(p.z) == half);
      REQUIRE(on_border);
    }
  }
  CHECK(area == 4 * half * half);  // products of multiples of the spacing: exact
  CHECK(adjacency.boundary_loops().size() == 1);
}

// Texels that keep the background where the mesh is drawn over the whole frame from straight above, in perspective.
std::size_t holes_from_above(const HeightField& field, const Mesh& mesh) {
  const double half = field.steps() / 2 * field.spacing;
  Camera camera;
  camera.eye = {0.05 * half, 4 * half, 0.03 * half};
  camera.target = {0.05 * half, 0, 0.03 * half};
  camera.up = {0, 0, -1};
  camera.tan_half_fov_y = 0.2;
  camera.near = half, camera.far = 8 * half;
  Frame frame{.width = 512, .height = 512};
  frame.targets = {{TargetContent::color, kRgba8, {1, 0, 1, 1}}};
  const std::vector<Image> images = raster::CpuRenderer().render(make_scene(mesh, {Material{}}, camera, frame), frame);
  std::size_t holes = 0;
  for (int y = 0; y < 512; ++y)
    for (int x = 0; x < 512; ++x) holes += images[0].channels<std::uint8_t>(x, y)[0] == 255;
  return holes;
}

void check_uniform_is_not_better(const HeightField& field) {
  const RemovalOrder order = removal_order(field);
  for (int j = 3; j < field.bits; ++j) {
    const Levels uniform = uniform_grid(field.bits, j);
    const Levels pruned = make_levels(field.bits, order, uniform.vertex_counts);
    CAPTURE(j);
    CHECK(level_error(field, pruned, 0).rms_m <= level_error(field, uniform, 0).rms_m);
  }
}

}  // namespace

TEST_CASE("levels: no cracks at any level, by topology and drawn against another background; nested; of the counts asked for") {
  for (const PruningRule rule : {PruningRule::merging_domains, PruningRule::saturated}) {
    const HeightField field = test::rough_field(6);
    std::vector<std::uint32_t> counts;
    for (std::uint32_t n = 4; n < field.point_count(); n += n < 40 ? 1 : n / 7) counts.push_back(n);
    counts.push_back(static_cast<std::uint32_t>(field.point_count()));
    const Levels levels = make_levels(field.bits, removal_order(field, {.rule = rule}), counts);
    for (std::size_t level = 0; level < levels.count(); ++level) {
      const Mesh mesh = level_mesh(field, levels, level);
      CHECK(mesh.vertex_count() == counts[level]);
      std::size_t on_border = 0;
      for (const Wedge& w : mesh.wedges) on_border += std::fmin(w.uv.x, w.uv.y) < 0.6 / 65 || std::fmax(w.uv.x, w.uv.y) > 64.4 / 65;
      CHECK(mesh.face_count() == 2 * (mesh.vertex_count() - 1) - on_border);
      check_no_cracks(field, mesh);
      if (level % 4 == 0) CHECK(holes_from_above(field, mesh) == 0);
    }
  }
}

TEST_CASE("levels: a planted crack is seen by both checks") {
  const HeightField field = test::random_field(4, 2000, 2);
  Levels levels = make_levels(field.bits, removal_order(field), std::vector<std::uint32_t>{60});
  Mesh mesh = level_mesh(field, levels, 0);
  CHECK(holes_from_above(field, mesh) == 0);
  mesh.faces.erase(mesh.faces.begin() + static_cast<std::ptrdiff_t>(mesh.face_count() / 2));
  CHECK(Adjacency(mesh).boundary_loops().size() > 1);
  CHECK(holes_from_above(field, mesh) > 0);
}

TEST_CASE("levels: the finest is the field itself, the coarsest two triangles") {
  const HeightField field = test::rough_field(4);
  const RemovalOrder order = removal_order(field);
  const Levels levels = make_levels(field.bits, order, std::vector<std::uint32_t>{4, 289});
  const Mesh coarse = level_mesh(field, levels, 0), fine = level_mesh(field, levels, 1);
  CHECK(coarse.face_count() == 2);
  CHECK(fine.face_count() == 2 * 16 * 16);
  CHECK(level_error(field, levels, 1).max_m == 0);
  REQUIRE(fine.vertex_count() == 289);
  for (std::uint32_t v = 0; v < 289; ++v) {
    const GridPoint p = point_at(4, v);
    CHECK(Vec3d(fine.positions[v]) == field.position(p.i, p.j));
    CHECK(fine.wedges[v].vertex.index == v);
    CHECK(fine.wedges[v].uv == Vec2f(field.uv(p.i, p.j)));
  }
  CHECK(level_mesh(field, uniform_grid(4, 4), 0) == fine);
  CHECK(level_mesh(field, uniform_grid(4, 0), 0) == coarse);
}

TEST_CASE("levels: errors against another surface: heights in metres lose half a metre at most") {
  const HeightField field = test::rough_field(5);
  const HeightField metres = with_unit(field, 1);
  const Levels all = uniform_grid(5, 5);
  const LevelError error = level_error(field, metres, all, 0);
  CHECK(error.max_m <= 0.5);
  CHECK(error.max_m > 0.4);
  CHECK(std::fabs(error.rms_m - std::sqrt(1.0 / 12)) < 0.02);  // of an even spread
}

TEST_CASE("levels: geometric counts of the paper, 0.1 to 10 per cent of 257 by 257 in 60 steps of 1.0812") {
  const std::vector<std::uint32_t> counts = geometric_counts(8);
  REQUIRE(counts.size() == 60);
  CHECK(counts.front() == 66);
  CHECK(counts.back() == 6605);
  for (std::size_t n = 1; n < counts.size(); ++n) {
    CHECK(counts[n] > counts[n - 1]);
    // 100^(1/59) = 1.08118; counts are rounded.
    CHECK(std::fabs(counts[n] - 1.08118 * counts[n - 1]) < 1.1);
  }
  CHECK(geometric_counts(2, 0.01, 0.5, 5).front() == 4);
  CHECK_THROWS_AS((void)geometric_counts(8, 0, 0.1, 60), InputError);
  CHECK_THROWS_AS((void)geometric_counts(8, 0.2, 0.1, 60), InputError);
  CHECK_THROWS_AS((void)geometric_counts(8, 0.1, 1.1, 60), InputError);
  CHECK_THROWS_AS((void)geometric_counts(8, 0.1, 0.2, 1), InputError);
  CHECK_THROWS_AS((void)geometric_counts(13), InputError);
}

TEST_CASE("levels: what cannot be is refused") {
  const HeightField field = test::rough_field(2);
  const RemovalOrder order = removal_order(field);
  const auto levels_of = [&](int bits, const std::vector<std::uint32_t>& counts) { return make_levels(bits, order, counts); };
  CHECK_THROWS_AS((void)levels_of(2, {}), InputError);
  CHECK_THROWS_AS((void)levels_of(2, {3, 9}), InputError);
  CHECK_THROWS_AS((void)levels_of(2, {9, 8}), InputError);
  CHECK_THROWS_AS((void)levels_of(2, {26}), InputError);
  CHECK_THROWS_AS((void)levels_of(3, {9}), InputError);
  CHECK_THROWS_AS((void)levels_of(2, std::vector<std::uint32_t>(kMaxLevels + 1, 9)), InputError);
  const Levels levels = levels_of(2, {9, 9, 25});
  CHECK(level_mesh(field, levels, 0) == level_mesh(field, levels, 1));
  CHECK_THROWS_AS((void)level_mesh(field, levels, 3), InputError);
  CHECK_THROWS_AS((void)level_error(field, levels, 3), InputError);
  CHECK_THROWS_AS((void)level_mesh(test::rough_field(3), levels, 0), InputError);
  CHECK_THROWS_AS((void)uniform_grid(2, 3), InputError);
}

TEST_CASE("levels: as many points as a uniform grid never miss by more (RMS), on noise") {
  check_uniform_is_not_better(test::rough_field(7));
}

TEST_CASE("levels: as many points as a uniform grid never miss by more (RMS), on the procedural alps") {
  const procedural::Alps alps = procedural::make_alps({.texture_size = 64});
  check_uniform_is_not_better(make_height_field(alps.dem, {.dem_spacing = alps.spacing}).field);
}

TEST_CASE("levels: as many points as a uniform grid never miss by more (RMS), on davosdorf") {
  const auto field = test::davosdorf();
  if (!field) return test::report_skip("davosdorf's levels", "davosdorf/davosdorf.tif is not there");
  check_uniform_is_not_better(*field);
}
