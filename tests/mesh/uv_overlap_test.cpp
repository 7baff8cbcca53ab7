#include "core/mesh/uv_overlap.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "core/base/error.h"
#include "core/base/rng.h"
#include "tests/mesh/tiny_meshes.h"

using namespace etalon;
using namespace etalon::test;

TEST_CASE("the square fills the grid exactly once") {
  for (const int grid : {1, 7, 64, 1000}) {
    const UvOverlap overlap = measure_uv_overlap(square(), grid, 5);
    CHECK(overlap.covered_cells == static_cast<std::size_t>(grid) * static_cast<std::size_t>(grid));
    CHECK(overlap.overlapped_cells == 0);
    CHECK(overlap.face_count == 0);
  }
}

TEST_CASE("a fan around any inner point fills the grid exactly once") {
  Rng rng(3);
  for (int i = 0; i < 200; ++i) {
    Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5f, 0.5f, 0}}, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
    mesh.wedges[4].uv = {rng.uniform(0.01f, 0.99f), rng.uniform(0.01f, 0.99f)};
    const UvOverlap overlap = measure_uv_overlap(mesh, 100, 5);
    REQUIRE(overlap.covered_cells == 10000);
    REQUIRE(overlap.overlapped_cells == 0);
  }
}

TEST_CASE("a half covered twice") {
  Mesh mesh = square();
  mesh.faces.push_back(mesh.faces[0]);
  const UvOverlap overlap = measure_uv_overlap(mesh, 100, 1);
  CHECK(overlap.overlapped_cells == 5050);  // 100·99/2 below the diagonal, and the 100 on it: it is a left edge of the lower triangle
  CHECK(overlap.share() == 0.505);
  CHECK(overlap.face_count == 2);
  CHECK(overlap.first_faces == std::vector<FaceId>{FaceId(0u)});
}

TEST_CASE("what lies outside is cut off, what is too far or not finite is left out") {
  Mesh mesh = square();
  for (Wedge& w : mesh.wedges) w.uv += Vec2f(0.5f, 0);
  CHECK(measure_uv_overlap(mesh, 10, 5).covered_cells == 50);
  mesh.wedges[0].uv.x = 2e9f;
  CHECK(measure_uv_overlap(mesh, 10, 5).covered_cells == 0);
  CHECK(UvOverlap{}.share() == 0);
  CHECK_THROWS_AS((void)measure_uv_overlap(mesh, 0, 5), InternalError);
}

namespace {

/// The definition, cell by cell: how many faces own each centre.
UvOverlap counted_by_cells(const Mesh& mesh, int grid) {
  UvOverlap result;
  std::vector<std::vector<std::uint32_t>> faces_of(static_cast<std::size_t>(grid) * static_cast<std::size_t>(grid));
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    std::array<std::array<std::int64_t, 2>, 3> p;
    for (int k = 0; k < 3; ++k)
      for (int c = 0; c < 2; ++c)
        p[static_cast<std::size_t>(k)][static_cast<std::size_t>(c)] =
            static_cast<std::int64_t>(std::floor(static_cast<double>(mesh.wedge(FaceId(f), k).uv[c]) * grid * 256 + 0.5));
    const std::int64_t area = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
    if (area < 0) std::swap(p[1], p[2]);
    for (int y = 0; y < grid; ++y)
      for (int x = 0; x < grid; ++x) {
        bool is_inside = area != 0;
        for (std::size_t k = 0; k < 3; ++k) {
          const std::int64_t dx = p[(k + 1) % 3][0] - p[k][0], dy = p[(k + 1) % 3][1] - p[k][1];
          const std::int64_t e = dx * (y * 256 + 128 - p[k][1]) - dy * (x * 256 + 128 - p[k][0]);
          is_inside = is_inside && (e > 0 || (e == 0 && (dy < 0 || (dy == 0 && dx > 0))));
        }
        if (is_inside) faces_of[static_cast<std::size_t>(y * grid + x)].push_back(f);
      }
  }
  std::set<std::uint32_t> shared;
  for (const auto& faces : faces_of) {
    result.covered_cells += faces.empty() ? 0 : 1;
    result.overlapped_cells += faces.size() > 1 ? 1 : 0;
    if (faces.size() > 1) shared.insert(faces.begin(), faces.end());
  }
  result.face_count = shared.size();
  for (const std::uint32_t f : shared) result.first_faces.push_back(FaceId(f));
  return result;
}

}  // namespace

TEST_CASE("triangles by chance, some of them several times: counts are those of the definition") {
  Rng rng(11);
  for (int i = 0; i < 300; ++i) {
    Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {});
    mesh.wedges.clear();
    const auto triangles = static_cast<std::uint32_t>(1 + rng.below(8));
    for (std::uint32_t t = 0; t < triangles; ++t) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        // Half of them on cell centres and borders: ties.
        const Vec2f uv = rng.coin() ? Vec2f(static_cast<float>(rng.between(-4, 36)) / 32, static_cast<float>(rng.between(-4, 36)) / 32)
                                    : Vec2f(rng.uniform(-0.2f, 1.2f), rng.uniform(-0.2f, 1.2f));
        mesh.wedges.push_back({VertexId(k), uv});
      }
      for (std::uint64_t copies = 1 + rng.below(4); copies > 0; --copies)
        mesh.faces.push_back({WedgeId(3 * t), WedgeId(3 * t + 1), WedgeId(3 * t + 2)});
    }
    const UvOverlap expected = counted_by_cells(mesh, 16), overlap = measure_uv_overlap(mesh, 16, 1000);
    REQUIRE(overlap.covered_cells == expected.covered_cells);
    REQUIRE(overlap.overlapped_cells == expected.overlapped_cells);
    REQUIRE(overlap.face_count == expected.face_count);
    REQUIRE(overlap.first_faces == expected.first_faces);
  }
}

TEST_CASE("a million faces that each cover the texture: seconds, not hours") {
  Mesh mesh = square();
  const auto faces = mesh.faces;
  for (int i = 0; i < 500'000; ++i) mesh.faces.insert(mesh.faces.end(), faces.begin(), faces.end());
  const UvOverlap overlap = measure_uv_overlap(mesh, 2048, 5);
  CHECK(overlap.face_count == 1'000'002);
  CHECK(overlap.overlapped_cells == std::size_t{2048} * 2048);
}
