#include "core/mesh/range_image.h"

#include <cstddef>
#include <limits>

#include <doctest/doctest.h>

#include "core/base/error.h"
#include "core/mesh/mesh_validation.h"

using namespace etalon;

namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
using Corners = std::vector<std::array<std::uint32_t, 3>>;

Corners corners_of(const Mesh& mesh) {
  Corners corners;
  for (const auto& f : mesh.faces) corners.push_back({f[0].index, f[1].index, f[2].index});
  return corners;
}

}  // namespace

TEST_CASE("samples lie at pixel centres, row 0 lowest") {
  const Mesh mesh = triangulate({.width = 3, .height = 2, .spacing = 0.5, .z = {1, 1, 1, 2, 2, 2}});
  REQUIRE(mesh.vertex_count() == 6);
  CHECK(mesh.positions[0] == Vec3f(0.25f, 0.25f, 1));
  CHECK(mesh.positions[2] == Vec3f(1.25f, 0.25f, 1));
  CHECK(mesh.positions[3] == Vec3f(0.25f, 0.75f, 2));
  CHECK(mesh.colors.empty());
  CHECK(!mesh.has_uv);
}

TEST_CASE("a cell is cut along the diagonal of less difference in depth, the rising one where both are equal") {
  //  2 3
  //  0 1
  CHECK(corners_of(triangulate({.width = 2, .height = 2, .z = {0, 0, 0, 0}})) == Corners{{0, 1, 3}, {0, 3, 2}});
  CHECK(corners_of(triangulate({.width = 2, .height = 2, .z = {0, 1, 1, 0}})) == Corners{{0, 1, 3}, {0, 3, 2}});
  CHECK(corners_of(triangulate({.width = 2, .height = 2, .z = {0, 1, 1, 2}})) == Corners{{0, 1, 2}, {1, 3, 2}});
}

TEST_CASE("faces are counter-clockwise seen from +z, whichever sample is missing") {
  for (std::size_t missing = 0; missing < 5; ++missing) {
    RangeImage range{.width = 2, .height = 2, .spacing = 1, .z = {0, 0.5f, 0.25f, 1}};
    if (missing < 4) range.z[missing] = missing % 2 == 0 ? kNone : std::numeric_limits<float>::infinity();
    const Mesh mesh = triangulate(range);
    CHECK(sample_count(range) == (missing < 4 ? 3 : 4));
    CHECK(mesh.face_count() == (missing < 4 ? 1 : 2));
    CHECK(mesh.vertex_count() == (missing < 4 ? 3 : 4));
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
      const Vec3f a = mesh.position(FaceId(f), 0), b = mesh.position(FaceId(f), 1), c = mesh.position(FaceId(f), 2);
      CHECK((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) == 1);
    }
  }
}

TEST_CASE("fewer than three samples are no face, and a sample of no face is no vertex") {
  const Mesh mesh = triangulate({.width = 2, .height = 2, .z = {0, kNone, kNone, 0}});
  CHECK(mesh.face_count() == 0);
  CHECK(mesh.vertex_count() == 0);
  const Mesh step = triangulate({.width = 3, .height = 2, .spacing = 1, .z = {0, 0, 9, 0, 0, kNone}});
  CHECK(step.vertex_count() == 4);
  CHECK(triangulate({.width = 1, .height = 3, .z = {0, 0, 0}}).face_count() == 0);
}

TEST_CASE("the jump in depth is four spacings, or as asked; equal to it is within") {
  RangeImage range{.width = 2, .height = 2, .spacing = 0.5, .z = {0, 0, 0, 2}};
  CHECK(triangulate(range).face_count() == 2);
  range.z[3] = 2.001f;
  // The diagonal is the falling one; the triangle below it stays.
  CHECK(corners_of(triangulate(range)) == Corners{{0, 1, 2}});
  CHECK(triangulate(range, {}, {.max_jump = std::numeric_limits<double>::infinity()}).face_count() == 2);
  CHECK(triangulate(range, {}, {.max_jump = 0.001}).face_count() == 1);
}

TEST_CASE("colours are those of the samples that are vertices") {
  RangeImage range{.width = 3, .height = 2, .z = {kNone, 0, 0, 0, 0, 0}};
  std::vector<std::byte> rgb(18);
  for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] = static_cast<std::byte>(10 * i);
  const Mesh mesh = triangulate(range, rgb);
  REQUIRE(mesh.colors.size() == 5);
  CHECK(mesh.colors[0] == Vec4f(30 / 255.0f, 40 / 255.0f, 50 / 255.0f, 1));
  CHECK(mesh.colors[4] == Vec4f(150 / 255.0f, 160 / 255.0f, 170 / 255.0f, 1));
  CHECK(validate_mesh(mesh).manifold());
}

TEST_CASE("sizes and lengths that do not fit are refused") {
  const RangeImage good{.width = 2, .height = 2, .z = {0, 0, 0, 0}};
  RangeImage bad = good;
  bad.z.pop_back();
  CHECK_THROWS_WITH_AS((void)triangulate(bad), "range image: samples: expected 4, got 3", InputError);
  bad = good;
  bad.width = 0;
  CHECK_THROWS_WITH_AS((void)triangulate(bad), "range image: size: expected at least 1x1, got 0x2", InputError);
  for (const double spacing : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    bad = good;
    bad.spacing = spacing;
    CHECK_THROWS_AS((void)triangulate(bad), InputError);
  }
  CHECK_THROWS_WITH_AS((void)triangulate(good, std::vector<std::byte>(11)), "range image: colours: expected 12 bytes, got 11", InputError);
  CHECK_THROWS_WITH_AS((void)triangulate(good, {}, {.max_jump = 0}), "range image: largest jump: expected a length above 0, got 0",
                       InputError);
  CHECK_THROWS_AS((void)triangulate(good, {}, {.max_jump = std::numeric_limits<double>::quiet_NaN()}), InputError);
}
