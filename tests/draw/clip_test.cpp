#include "core/draw/clip.h"

#include <doctest/doctest.h>

#include "core/base/rng.h"

using namespace etalon;

namespace {

ClipVertex vertex(float x, float y, float z, float w, std::uint64_t order) {
  ClipVertex v;
  v.x = x, v.y = y, v.z = z, v.w = w, v.order = order;
  v.uv = {x, y};
  return v;
}

bool same(const ClipVertex& a, const ClipVertex& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z && a.w == b.w && a.uv == b.uv && a.color == b.color;
}

}  // namespace

TEST_CASE("a triangle inside stays as it is, one outside goes") {
  const auto planes = clip_planes(100, 100, 50);
  const auto inside = clip_triangle({vertex(0, 0, 0, 1, 0), vertex(0.5f, 0, 0, 1, 1), vertex(0, 0.5f, 0, 1, 2)}, planes);
  REQUIRE(inside.size() == 3);
  CHECK(inside[1].x == 0.5f);
  CHECK(clip_triangle({vertex(0, 0, -3, 1, 0), vertex(1, 0, -3, 1, 1), vertex(0, 1, -3, 1, 2)}, planes).empty());
}

TEST_CASE("one vertex behind the near plane: a quadrilateral whose new vertices lie on the plane") {
  const auto polygon = clip_triangle({vertex(0, 0, -2, 1, 0), vertex(0.5f, 0, 0, 1, 1), vertex(0, 0.5f, 0, 1, 2)}, clip_planes(10, 10, 0));
  REQUIRE(polygon.size() == 4);
  int on_plane = 0;
  for (const ClipVertex& v : polygon) on_plane += v.z == -v.w ? 1 : 0;
  CHECK(on_plane == 2);
}

TEST_CASE("the guard plane lies guard texels outside the frame") {
  // x + w·(1 + 2·guard/W) = 0 at x_window = −guard.
  const auto polygon =
      clip_triangle({vertex(-100, 0, 0, 1, 0), vertex(0, -0.5f, 0, 1, 1), vertex(0, 0.5f, 0, 1, 2)}, clip_planes(100, 100, 50));
  REQUIRE(polygon.size() == 4);
  float least = 0;
  for (const ClipVertex& v : polygon) least = std::min(least, v.x);
  CHECK(least == -2.0f);  // window (−2 + 1)·50 = −50
}

TEST_CASE("neighbours cut their common edge in identical vertices, whatever the direction") {
  Rng rng(3);
  const auto planes = clip_planes(640, 480, 2048);
  int cut = 0;
  for (int n = 0; n < 20000; ++n) {
    const auto random_vertex = [&](std::uint64_t order) {
      return vertex(rng.uniform(-20, 20), rng.uniform(-20, 20), rng.uniform(-3, 3), rng.uniform(0.25f, 2), order);
    };
    const ClipVertex a = random_vertex(1), b = random_vertex(2), c = random_vertex(0), d = random_vertex(3);
    const auto left = clip_triangle({a, b, c}, planes), right = clip_triangle({b, a, d}, planes);
    for (const ClipVertex& v : left)
      if (v.order > 3)
        for (const ClipVertex& w : right)
          if (w.order == v.order) {
            CHECK(same(v, w));
            ++cut;
          }
  }
  CHECK(cut > 1000);
}
