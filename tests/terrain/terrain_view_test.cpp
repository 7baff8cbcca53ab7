#include "core/terrain/terrain_view.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/draw/camera.h"
#include "tests/terrain/terrain_fixture.h"

using namespace etalon;
using namespace etalon::terrain;

namespace {

// Where the camera of the drawing puts p, in pixels: another way to the same place.
Vec2d picture_of(const TerrainView& view, const Vec3d& p) {
  Camera camera;
  camera.eye = view.eye, camera.target = view.target, camera.up = view.up;
  camera.tan_half_fov_y = view.tan_half_fov_y, camera.near = view.near, camera.far = view.far;
  const Matrix4 m = clip_from_object(camera, view.width, view.height);
  double clip[4];
  for (int r = 0; r < 4; ++r) clip[r] = m.m[r][0] * p.x + m.m[r][1] * p.y + m.m[r][2] * p.z + m.m[r][3];
  return {(clip[0] / clip[3] + 1) / 2 * view.width, (clip[1] / clip[3] + 1) / 2 * view.height};
}

}  // namespace

TEST_CASE("terrain view: pixels per metre are the derivative of what the camera draws; inside is inside its frame") {
  const HeightField field = test::rough_field(5);
  const TerrainView view = test::low_view(field);
  const ViewFrustum frustum(view);
  std::size_t seen = 0;
  for (int j = 0; j < field.side(); ++j)
    for (int i = 0; i < field.side(); ++i) {
      const Vec3d p = field.position(i, j);
      const double weight = frustum.pixels_per_metre(p);
      const Vec2d at = picture_of(view, p);
      if (!frustum.contains(p)) {
        CHECK(weight == 0);
        continue;
      }
      ++seen;
      CHECK(at.x > -1e-6);
      CHECK(at.x < view.width + 1e-6);
      CHECK(at.y > -1e-6);
      CHECK(at.y < view.height + 1e-6);
      const double step = 1e-3;
      const Vec2d above = picture_of(view, Vec3d(p.x, p.y + step, p.z)), below = picture_of(view, Vec3d(p.x, p.y - step, p.z));
      const double moved = std::hypot(above.x - below.x, above.y - below.y) / (2 * step);
      CHECK(std::fabs(weight - moved) < 1e-6 * moved + 1e-8);
    }
  CHECK(seen > 50);
  CHECK(seen < field.point_count() / 2);
}

TEST_CASE("terrain view: straight ahead at depth d a metre is height/(2·tan·d) pixels; outside it is nothing") {
  TerrainView view;
  view.eye = {0, 0, 0}, view.target = {0, 0, -1};
  view.near = 1, view.far = 1000;
  const ViewFrustum frustum(view);
  CHECK(frustum.pixels_per_metre({0, 0, -100}) == 480 / (2 * 0.5 * 100));
  CHECK(frustum.pixels_per_metre({0, 0, -1000}) == 0.48);
  CHECK(frustum.pixels_per_metre({0, 0, -1001}) == 0);
  CHECK(frustum.pixels_per_metre({0, 0, -0.5}) == 0);
  CHECK(frustum.pixels_per_metre({0, 0, 100}) == 0);
  CHECK(frustum.contains({0, 50, -100}));
  CHECK_FALSE(frustum.contains({0, 50.1, -100}));
  CHECK(frustum.contains({-66.6, 0, -100}));
  CHECK_FALSE(frustum.contains({-66.7, 0, -100}));
}

TEST_CASE("terrain view: a view that is none is refused") {
  const auto refused = [](auto change) {
    TerrainView view;
    view.eye = {0, 10, 10};
    change(view);
    CHECK_THROWS_AS(ViewFrustum{view}, InputError);
  };
  refused([](TerrainView& v) { v.target = v.eye; });
  refused([](TerrainView& v) { v.up = {0, 1, 1}; });
  refused([](TerrainView& v) { v.up = {0, 0, 0}; });
  refused([](TerrainView& v) { v.near = 0; });
  refused([](TerrainView& v) { v.far = v.near; });
  refused([](TerrainView& v) { v.far = std::numeric_limits<double>::infinity(); });
  refused([](TerrainView& v) { v.tan_half_fov_y = 0; });
  refused([](TerrainView& v) { v.width = 0; });
  refused([](TerrainView& v) { v.height = 40000; });
  refused([](TerrainView& v) { v.eye.x = std::numeric_limits<double>::quiet_NaN(); });
}
