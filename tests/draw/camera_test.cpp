#include "core/draw/camera.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "core/base/error.h"

using namespace etalon;

namespace {

std::array<double, 4> transform(const Matrix4& m, const Vec3d& p) {
  std::array<double, 4> r{};
  for (int i = 0; i < 4; ++i) r[static_cast<std::size_t>(i)] = m.m[i][0] * p.x + m.m[i][1] * p.y + m.m[i][2] * p.z + m.m[i][3];
  return r;
}

BoundingBox unit_box() { return {{-1, -1, -1}, {1, 1, 1}}; }

}  // namespace

TEST_CASE("the target lands in the middle, near and far on the depth planes") {
  Camera camera;
  camera.eye = {0, 0, 4}, camera.near = 1, camera.far = 9;
  const Matrix4 m = clip_from_object(camera, 200, 100);
  const auto middle = transform(m, {0, 0, 0});
  CHECK(middle[0] == 0);
  CHECK(middle[1] == 0);
  CHECK(middle[3] == 4);
  const auto at_near = transform(m, {0, 0, 3}), at_far = transform(m, {0, 0, -5});
  CHECK(at_near[2] == doctest::Approx(-at_near[3]));
  CHECK(at_far[2] == doctest::Approx(at_far[3]));
  // tan 0.5 at distance 4 spans 2 upward; a 2:1 frame spans 4 to the side.
  CHECK(transform(m, {0, 2, 0})[1] == doctest::Approx(4));
  CHECK(transform(m, {4, 0, 0})[0] == doctest::Approx(4));
}

TEST_CASE("degenerate views are refused by name") {
  const auto refuse = [](auto change) {
    Camera camera;
    change(camera);
    CHECK_THROWS_AS((void)clip_from_object(camera, 10, 10), InputError);
  };
  refuse([](Camera& c) { c.eye = c.target; });
  refuse([](Camera& c) { c.up = {0, 0, 2}; });
  refuse([](Camera& c) { c.near = 0; });
  refuse([](Camera& c) { c.far = c.near; });
  refuse([](Camera& c) { c.tan_half_fov_y = 0; });
  refuse([](Camera& c) { c.eye.x = std::numeric_limits<double>::quiet_NaN(); });
  CHECK_THROWS_AS((void)named_view("sideways", unit_box(), 10, 10), InputError);
  CHECK_THROWS_AS((void)named_view("24/24", unit_box(), 10, 10), InputError);
  CHECK_THROWS_AS((void)named_view("x/24", unit_box(), 10, 10), InputError);
}

TEST_CASE("the 24 views are the permutations of (0, ±1, ±2), each once") {
  std::vector<std::array<int, 3>> seen;
  for (int n = 0; n < 24; ++n) {
    const Camera camera = view_of_24(unit_box(), n);
    const double scale = std::sqrt(5.0) / (2.5 * std::sqrt(3.0));
    const std::array<int, 3> d = {static_cast<int>(std::lround(camera.eye.x * scale)), static_cast<int>(std::lround(camera.eye.y * scale)),
                                  static_cast<int>(std::lround(camera.eye.z * scale))};
    CHECK(std::abs(d[0]) + std::abs(d[1]) + std::abs(d[2]) == 3);
    CHECK(std::abs(d[0] * d[1] * d[2]) == 0);
    for (const auto& other : seen) CHECK(other != d);
    seen.push_back(d);
    (void)clip_from_object(camera, 64, 64);
  }
}

TEST_CASE("views of models in any unit stay inside the contract's range of w") {
  for (const float size : {1e-30f, 1e-9f, 1.0f, 1e9f, 1e30f}) {
    const BoundingBox box{{-size, -size, -size}, {size, size, size}};
    const Camera camera = named_view("fit", box, 640, 480);
    const Matrix4 m = clip_from_object(camera, 640, 480);
    for (const float s : {-size, size}) {
      const double w = transform(m, {s, s, s})[3];
      CHECK(w >= 0x1p-20);
      CHECK(w <= 0x1p20);
    }
  }
}
