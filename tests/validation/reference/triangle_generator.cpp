#include "tests/validation/reference/triangle_generator.h"

#include <algorithm>
#include <cmath>

#include "tests/validation/reference/random_values.h"

namespace etalon::validation::reference {

namespace {

struct Point {
  std::int64_t x = 0, y = 0;
};
using Points = std::array<Point, 3>;

std::int64_t round_to(std::int64_t value, std::int64_t step, std::int64_t offset) { return value / step * step + offset; }

// Mostly in the frame, else anywhere a vertex may lie.
Point random_point(Rng& rng, const TriangleDomain& d) {
  if (!one_in(rng, 4)) return {rng.between(0, d.frame_x), rng.between(0, d.frame_y)};
  return {rng.between(d.x_min, d.x_max), rng.between(d.y_min, d.y_max)};
}

Point near_point(Rng& rng, Point p, std::int64_t reach) { return {p.x + rng.between(-reach, reach), p.y + rng.between(-reach, reach)}; }

// Half the side of a triangle in sub-texels: log-uniform from one sub-texel up.
std::int64_t random_reach(Rng& rng, const TriangleDomain& d) {
  const int exponent = static_cast<int>(rng.between(0, d.subtexel_bits + d.size_exponent - 1));
  return (std::int64_t{1} << exponent) + static_cast<std::int64_t>(rng.below(std::uint64_t{1} << exponent));
}

Points general(Rng& rng, const TriangleDomain& d) {
  const std::int64_t reach = random_reach(rng, d);
  const Point centre = random_point(rng, d);
  return {near_point(rng, centre, reach), near_point(rng, centre, reach), near_point(rng, centre, reach)};
}

// Two distant vertices and a third within a few sub-texels of their line.
Points sliver(Rng& rng, const TriangleDomain& d) {
  Points p = general(rng, d);
  const double t = rng.unit() * 1.5 - 0.25;
  const auto along = [t](std::int64_t a, std::int64_t b) { return a + static_cast<std::int64_t>(t * static_cast<double>(b - a)); };
  p[2] = near_point(rng, {along(p[0].x, p[1].x), along(p[0].y, p[1].y)}, rng.between(0, 3));
  return p;
}

// Vertices at texel centres or corners: samples on edges and vertices.
Points on_texels(Rng& rng, const TriangleDomain& d) {
  Points p = one_in(rng, 3) ? sliver(rng, d) : general(rng, d);
  const std::int64_t texel = std::int64_t{1} << d.subtexel_bits;
  for (Point& q : p) {
    const std::int64_t offset = one_in(rng, 4) ? 0 : texel / 2;
    q = {round_to(q.x, texel, offset), round_to(q.y, texel, offset)};
  }
  return p;
}

// A few sub-texels around a texel's centre.
Points tiny(Rng& rng, const TriangleDomain& d) {
  const std::int64_t texel = std::int64_t{1} << d.subtexel_bits;
  const Point corner = random_point(rng, d);
  const Point centre{round_to(corner.x, texel, texel / 2), round_to(corner.y, texel, texel / 2)};
  const std::int64_t reach = rng.between(1, 4);
  return {near_point(rng, centre, reach), near_point(rng, centre, reach), near_point(rng, centre, reach)};
}

Points as_far_as_possible(Rng& rng, const TriangleDomain& d) {
  const auto extreme = [&rng](std::int64_t lo, std::int64_t hi) { return one_in(rng, 2) ? (rng.coin() ? lo : hi) : rng.between(lo, hi); };
  Points p;
  for (Point& q : p) q = {extreme(d.x_min, d.x_max), extreme(d.y_min, d.y_max)};
  return p;
}

float random_w(Rng& rng, int kind) {
  switch (kind) {
    case 0: return log_uniform(rng, -20, 20);
    case 1: return std::ldexp(1.0f, static_cast<int>(rng.between(-20, 20)));
    case 2: return 1.0f + static_cast<float>(rng.between(-2, 2)) * 0x1p-23f;
    default: return rng.uniform(0.3f, 4.0f);
  }
}

float random_depth(Rng& rng) {
  switch (rng.below(6)) {
    case 0: return one_of(rng, {0.0f, 1.0f, 0.5f, 0x1p-41f, 0x1p-40f, 0x1.fffffep-1f});
    case 1: return log_uniform(rng, -42, 0);
    case 2: return static_cast<float>(rng.between(0, 16)) / 16;
    default: return rng.uniform(0.0f, 1.0f);
  }
}

void give_values(Rng& rng, const TriangleDomain& d, Corners& corners) {
  const bool affine = one_in(rng, 3);
  const int w_kind = static_cast<int>(rng.below(6));
  const float common_w = one_in(rng, 2) ? 1.0f : log_uniform(rng, -20, 20);
  const bool moderate = one_in(rng, 2);
  for (RasterVertex& v : corners) {
    v.w = affine ? common_w : random_w(rng, w_kind);
    v.z = random_depth(rng);
    for (int c = 0; c < 2; ++c) v.uv[c] = moderate ? rng.uniform(-1.0f, 3.0f) : random_attribute(rng, d.uv_exponent);
    for (int c = 0; c < 4; ++c) v.color[c] = moderate ? rng.uniform(0.0f, 1.0f) : random_attribute(rng, 40);
  }
  if (one_in(rng, 8))  // constant over the triangle: the exact value is the attribute itself, borders of formats included
    for (std::size_t k = 1; k < 3; ++k) corners[k].z = corners[0].z, corners[k].uv = corners[0].uv, corners[k].color = corners[0].color;
}

// A right-angled triangle whose legs are whole texels, of lengths that put lookups and roundings on their borders: powers of two for
// floats and texels, multiples of 510 = 2·255 and 2·4369 for unorm (c·15·k/2 = middle of two unorm16 values for odd k).
Corners tie(Rng& rng, const TriangleDomain& d) {
  const std::int64_t texel = std::int64_t{1} << d.subtexel_bits;
  const auto leg = [&] { return one_in(rng, 3) ? one_of<std::int64_t>(rng, {510, 1020, 8738}) : std::int64_t{1} << rng.below(12); };
  const std::int64_t width = leg(), height = leg();
  const Point at = random_point(rng, d);
  const std::int64_t offset = rng.coin() ? 0 : texel / 2;
  const Point p{round_to(at.x, texel, offset), round_to(at.y, texel, offset)};
  Corners corners;
  give_values(rng, d, corners);
  for (RasterVertex& v : corners) v.w = 1;
  const std::int64_t sx = rng.coin() ? 1 : -1, sy = rng.coin() ? 1 : -1;
  const std::array<Point, 3> position{p, Point{p.x + sx * width * texel, p.y}, Point{p.x, p.y + sy * height * texel}};
  // Texel by texel (or by half texels), shifted by whole, half and quarter texels.
  const float step = one_of(rng, {0.5f, 1.0f, 2.0f});
  const float shift_u = static_cast<float>(rng.between(-8, 8)) / 4 / static_cast<float>(d.texture_width);
  const float shift_v = static_cast<float>(rng.between(-8, 8)) / 4 / static_cast<float>(d.texture_height);
  const float du = step * static_cast<float>(width) / static_cast<float>(d.texture_width);
  const float dv = step * static_cast<float>(height) / static_cast<float>(d.texture_height);
  const Vec4f low{0, 0, 1, 0}, right{1, 0, 0, 1}, up{0, 1, 0.5f, 1};
  const std::array<Vec2f, 3> uv{Vec2f{shift_u, shift_v}, Vec2f{shift_u + du, shift_v}, Vec2f{shift_u, shift_v + dv}};
  const std::array<Vec4f, 3> color{low, right, up};
  const bool plain_colors = rng.coin();
  const double limit = std::ldexp(1.0, d.uv_exponent);
  for (std::size_t k = 0; k < 3; ++k) {
    corners[k].x = static_cast<std::int32_t>(std::clamp(position[k].x, d.x_min, d.x_max));
    corners[k].y = static_cast<std::int32_t>(std::clamp(position[k].y, d.y_min, d.y_max));
    if (std::abs(uv[k].x) <= limit && std::abs(uv[k].y) <= limit) corners[k].uv = uv[k];
    if (plain_colors) corners[k].color = color[k];
  }
  return corners;
}

// A tie moved by the least step of one of its numbers: the nearest misses.
Corners near_tie(Rng& rng, const TriangleDomain& d) {
  Corners corners = tie(rng, d);
  RasterVertex& v = corners[rng.below(3)];
  const auto nudge = [&rng](float& a, float lo, float hi) { a = std::clamp(std::nextafter(a, rng.coin() ? 1e30f : -1e30f), lo, hi); };
  const float limit = std::ldexp(1.0f, d.uv_exponent);
  switch (rng.below(5)) {
    case 0: nudge(v.uv.x, -limit, limit); break;
    case 1: nudge(v.uv.y, -limit, limit); break;
    case 2: nudge(v.w, 0x1p-20f, 0x1p20f); break;
    case 3: nudge(v.color[static_cast<int>(rng.below(4))], -0x1p40f, 0x1p40f); break;
    default: v.x = static_cast<std::int32_t>(std::clamp<std::int64_t>(v.x + rng.between(-1, 1), d.x_min, d.x_max)); break;
  }
  return corners;
}

// A triangle of any shape, one w, that has at the centre of a texel the weight b1 = m / (m + n) and equal others: the centre is
// b1·v1 + (1 − b1)·p with v1 = centre + n·δ, p = centre − m·δ, v0 and v2 on either side of p. By the ratio, b1 is the middle of two unorm8
// (k/510), half (12 bits) or float32 (25 bits) numbers; with ½, attributes a few ulps apart tie, and uv is made to meet a texel border.
// E has no trailing zeros, so double arithmetic is inexact on these ties.
Corners inner_tie(Rng& rng, const TriangleDomain& d, Aim& aim) {
  struct Ratio {
    std::int64_t m, n;
  };
  const Ratio ratio =
      one_of<Ratio>(rng, {{1, 1}, {1, 1}, {1, 509}, {255, 255}, {101, 409}, {2049, 2047}, {2051, 6141}, {16777217, 16777215}});
  const std::int64_t texel = std::int64_t{1} << d.subtexel_bits, reach = random_reach(rng, d);
  const Point inside{rng.between(0, d.frame_x - 1), rng.between(0, d.frame_y - 1)};
  const Point centre{round_to(inside.x, texel, texel / 2), round_to(inside.y, texel, texel / 2)};
  aim = {static_cast<int>(centre.x >> d.subtexel_bits), static_cast<int>(centre.y >> d.subtexel_bits)};
  const Point delta = near_point(rng, {0, 0}, std::max<std::int64_t>(reach / (ratio.m + ratio.n), 1));
  const Point v1{centre.x + ratio.n * delta.x, centre.y + ratio.n * delta.y}, p{centre.x - ratio.m * delta.x, centre.y - ratio.m * delta.y};
  const Point v0 = near_point(rng, p, reach);
  const std::array<Point, 3> position{v0, v1, Point{2 * p.x - v0.x, 2 * p.y - v0.y}};
  Corners corners;
  give_values(rng, d, corners);
  const auto ulps_above = [](float a, std::uint64_t n) {
    for (; n > 0; --n) a = std::nextafter(a, 1e30f);
    return a;
  };
  const RasterVertex base = corners[0];
  for (std::size_t k = 0; k < 3; ++k) {
    RasterVertex& v = corners[k];
    v.x = static_cast<std::int32_t>(std::clamp(position[k].x, d.x_min, d.x_max));
    v.y = static_cast<std::int32_t>(std::clamp(position[k].y, d.y_min, d.y_max));
    v.w = base.w;
    const std::uint64_t steps = k == 1 ? 1 + 2 * rng.below(2) : 2 * rng.below(2);  // their weighted mean often ends in ½ ulp
    v.z = std::min(ulps_above(base.z, steps), 1.0f);
    for (int c = 0; c < 4; ++c) v.color[c] = std::min(ulps_above(base.color[c], steps), 0x1p40f);
  }
  // u0 + 2·u1 + u2 = 4·t with t·width a multiple of ¼, all of few bits.
  const auto dyadic = [&rng] { return static_cast<float>(rng.between(-2048, 2048)) * 0x1p-10f; };
  for (int c = 0; c < 2; ++c) {
    const float size = static_cast<float>(c == 0 ? d.texture_width : d.texture_height);
    const float t = static_cast<float>(rng.between(-16, 16)) / 4 / size;
    corners[0].uv[c] = dyadic(), corners[1].uv[c] = dyadic();
    corners[2].uv[c] = 4 * t - 2 * corners[1].uv[c] - corners[0].uv[c];
  }
  if (one_in(rng, 3)) corners[rng.below(3)].z = std::min(ulps_above(base.z, 3), 1.0f);
  return corners;
}

}  // namespace

Corners random_triangle(Rng& rng, const TriangleDomain& d, const Corners& previous, Aim& aim) {
  aim = {};
  const std::uint64_t category = rng.below(18);
  if (category < 2) return tie(rng, d);
  if (category < 4) return near_tie(rng, d);
  if (category >= 16) return inner_tie(rng, d, aim);
  Points p;
  if (category < 7)
    p = general(rng, d);
  else if (category < 9)
    p = sliver(rng, d);
  else if (category < 11)
    p = on_texels(rng, d);
  else if (category == 11)
    p = tiny(rng, d);
  else if (category == 12)
    p = as_far_as_possible(rng, d);
  else if (category == 13) {
    p = general(rng, d);
    p[2] = rng.coin() ? p[0] : Point{2 * p[1].x - p[0].x, 2 * p[1].y - p[0].y};
  }  // no area
  else {
    p = general(rng, d);
    p[0] = {previous[2].x, previous[2].y};
    p[1] = {previous[1].x, previous[1].y};
  }  // beyond an edge
  Corners corners;
  give_values(rng, d, corners);
  for (std::size_t k = 0; k < 3; ++k) {
    corners[k].x = static_cast<std::int32_t>(std::clamp(p[k].x, d.x_min, d.x_max));
    corners[k].y = static_cast<std::int32_t>(std::clamp(p[k].y, d.y_min, d.y_max));
  }
  if (category >= 14)
    for (std::size_t k = 0; k < 2; ++k) {
      const RasterVertex& shared = previous[2 - k];
      if (std::max(std::abs(shared.uv.x), std::abs(shared.uv.y)) <= std::ldexp(1.0f, d.uv_exponent)) corners[k] = shared;
    }
  return corners;
}

}  // namespace etalon::validation::reference
