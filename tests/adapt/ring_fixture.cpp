#include "tests/adapt/ring_fixture.h"

#include <algorithm>
#include <cmath>

#include "core/math/nearest_point.h"
#include "core/mesh/exact_orientation.h"
#include "core/procedural/smooth_math.h"

namespace etalon::test {
namespace {

// Corners around the middle of the unit square, by ascending angle; u near the middle, or on the edge between the first and the last.
void random_star(Rng& rng, int corners, bool on_curve, Vec2f& u, std::vector<Vec2f>& around) {
  std::vector<double> turns;
  for (int k = 0; k < corners; ++k) turns.push_back(rng.unit() * (on_curve ? 0.5 : 1));
  std::sort(turns.begin(), turns.end());
  around.clear();
  for (const double turn : turns) {
    const double radius = 0.15 + 0.3 * rng.unit();
    around.push_back(Vec2f(Vec2d(0.5 + radius * procedural::cos_turns(turn), 0.5 + radius * procedural::sin_turns(turn))));
  }
  const auto near_middle = [&] { return 0.5f + 0.1f * rng.uniform(-1, 1); };
  u = {near_middle(), near_middle()};
}

bool unfolded(const Vec2f& u, const std::vector<Vec2f>& around, bool on_curve) {
  adapt::CollapseRing ring;
  ring.uv_of_u = u, ring.uv = around, ring.on_curve = on_curve;
  return adapt::is_unfolded(ring);
}

// Three points near the middle in a random ring that fit an edge and its merged vertex.
void random_edge(Rng& rng, int corners, adapt::EdgeRing& ring) {
  ring.last_of_u = 1 + rng.below(static_cast<std::uint64_t>(corners) - 1);
  const auto near_middle = [&](double turn) {
    const double radius = 0.12 * rng.unit();
    return Vec2f(Vec2d(0.5 + radius * procedural::cos_turns(turn), 0.5 + radius * procedural::sin_turns(turn)));
  };
  do {
    random_star(rng, corners, false, ring.uv_of_w, ring.uv);
    ring.uv_of_u = near_middle(rng.unit()), ring.uv_of_v = near_middle(rng.unit());
  } while (!adapt::is_unfolded(ring));
}

}  // namespace

adapt::EdgeRing random_edge_ring(Rng& rng, int corners, bool planar) {
  adapt::EdgeRing ring, plane;
  random_edge(rng, corners, ring);
  do random_edge(rng, corners, plane);
  while (plane.last_of_u != ring.last_of_u);
  const auto lift = [&](const Vec2f& p) {
    return planar ? Vec3f{p.x, p.y, 0.25f * p.x + 0.5f * p.y} : Vec3f{p.x, p.y, 0.3f * rng.uniform(-1, 1)};
  };
  ring.position_of_u = lift(plane.uv_of_u), ring.position_of_v = lift(plane.uv_of_v), ring.position_of_w = lift(plane.uv_of_w);
  for (const Vec2f& p : plane.uv) ring.positions.push_back(lift(p));
  return ring;
}

adapt::CollapseRing random_ring(Rng& rng, int corners, bool planar, bool on_curve) {
  adapt::CollapseRing ring;
  ring.on_curve = on_curve;
  do random_star(rng, corners, on_curve, ring.uv_of_u, ring.uv);
  while (!unfolded(ring.uv_of_u, ring.uv, on_curve));
  Vec2f u;
  std::vector<Vec2f> plane;
  do random_star(rng, corners, on_curve, u, plane);
  while (planar && !unfolded(u, plane, on_curve));
  const auto lift = [&](const Vec2f& p) {
    return planar ? Vec3f{p.x, p.y, 0.25f * p.x + 0.5f * p.y} : Vec3f{p.x, p.y, 0.3f * rng.uniform(-1, 1)};
  };
  ring.position_of_u = lift(u);
  for (const Vec2f& p : plane) ring.positions.push_back(lift(p));
  return ring;
}

TexturedPoint textured_point(const std::vector<TexturedCorners>& surface, const Vec2d& p) {
  double best = -1e9;
  TexturedPoint result{};
  for (const TexturedCorners& c : surface) {
    const Vec2d a(c.uv[0]), ab = Vec2d(c.uv[1]) - a, ac = Vec2d(c.uv[2]) - a, ap = p - a;
    const double area = ab.x * ac.y - ab.y * ac.x, v = (ap.x * ac.y - ap.y * ac.x) / area, w = (ab.x * ap.y - ab.y * ap.x) / area;
    if (std::min({1 - v - w, v, w}) <= best) continue;
    best = std::min({1 - v - w, v, w});
    const Vec3d x = difference_of(c.position[0], c.position[1]), y = difference_of(c.position[0], c.position[2]);
    const auto length = [](const Vec3d& d) { return std::sqrt(dot_product(d, d)); };
    result = {to_double(c.position[0]) + v * x + w * y, 4 * (length(x) + length(y)) / area};
  }
  return result;
}

Vec2d random_point_of(Rng& rng, const std::vector<TexturedCorners>& surface) {
  const TexturedCorners& c = surface[rng.below(surface.size())];
  double v = rng.unit(), w = rng.unit();
  if (v + w > 1) v = 1 - v, w = 1 - w;
  const Vec2d a(c.uv[0]);
  return a + v * (Vec2d(c.uv[1]) - a) + w * (Vec2d(c.uv[2]) - a);
}

}  // namespace etalon::test
