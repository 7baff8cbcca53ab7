#include "core/simplify/aps_metric.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/nearest_point.h"

namespace etalon::simplify {

namespace {

float rounded_up(double x) {
  const auto r = static_cast<float>(x);
  return static_cast<double>(r) < x ? std::nextafter(r, std::numeric_limits<float>::infinity()) : r;
}

double cross2(const Vec3d& a, const Vec3d& b) { return a.x * b.y - a.y * b.x; }
Vec3d minus(const Vec3d& a, const Vec3d& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec3d along(const Vec3d& from, const Vec3d& to, double t) {
  return {from.x + t * (to.x - from.x), from.y + t * (to.y - from.y), from.z + t * (to.z - from.z)};
}

}  // namespace

ApsMetric::Corner ApsMetric::corner(std::uint32_t h) const {
  const Vec2f& uv = mesh_.uv(h);
  return {mesh_.start(h), {uv.x, uv.y, 0}, to_double(places_[mesh_.start(h)])};
}

double ApsMetric::largest_bound(std::uint32_t u) const {
  float largest = 0;
  for_each_corner(mesh_, u, [&](std::uint32_t h) { largest = std::max(largest, bounds_[h >> 2]); });
  return largest;
}

void ApsMetric::gather(std::uint32_t u, const CollapseMesh::Edge& edge) {
  for (Side& side : sides_) {
    side.faces.clear();
    side.textured = true;
    side.largest = 0;
  }
  const bool turns = mesh_.kind(u) == VertexKind::curve;
  std::size_t at = edge.left != kNone ? 0 : 1;
  const std::uint32_t first = edge.left != kNone ? edge.left : mesh_.first_out(u);
  std::uint32_t h = first;
  do {
    const std::uint32_t back = CollapseMesh::previous(h), f = h >> 2;
    Side& side = sides_[at];
    if (side.faces.empty()) side.u = corner(h);
    const bool stays = h != edge.left && back != edge.right;
    side.faces.push_back({f, corner(CollapseMesh::next(h)), corner(back), stays});
    side.textured = side.textured && mesh_.uv_sign(f) != 0;
    side.largest = std::max<double>(side.largest, bounds_[f]);
    if (turns && mesh_.on_curve(back)) at = 1 - at;
    h = mesh_.opposite(back);
  } while (h != kNone && h != first);
  if (edge.left != kNone) sides_[0].v = corner(CollapseMesh::next(edge.left));
  if (edge.right != kNone) sides_[1].v = corner(edge.right);
}

// u against the new faces: at the point of the same texture coordinate, or the nearest one.
double ApsMetric::deviation_at_vertex(const Side& side) {
  double nearest = std::numeric_limits<double>::infinity(), result = 0;
  const auto consider = [&](const Corner& a, const Corner& b, const Corner& c) {
    const NearestOnTriangle found =
        side.textured ? nearest_on_triangle(side.u.uv, a.uv, b.uv, c.uv) : nearest_on_triangle(side.u.place, a.place, b.place, c.place);
    if (!(found.distance2 < nearest)) return;
    nearest = found.distance2;
    result = std::sqrt(detail::at_weights(side.u.place, a.place, b.place, c.place, found.weights).distance2);
  };
  for (const Face& face : side.faces)
    if (face.stays) consider(side.v, face.a, face.b);
  if (nearest < std::numeric_limits<double>::infinity()) return result;
  // No face stays: what is left of the side is the edge from v to the far end of the one that goes.
  const Face& gone = side.faces.front();
  const Corner& far = gone.a.vertex == side.v.vertex ? gone.b : gone.a;
  consider(side.v, far, far);
  return result;
}

// Old edges u-a against new edges v-b.
double ApsMetric::deviation_at_crossings(const Side& side) {
  double largest2 = 0;
  const auto cross = [&](const Corner& a, const Corner& b) {
    if (a.vertex == side.v.vertex || b.vertex == side.v.vertex || a.vertex == b.vertex) return;
    const Vec3d r = minus(a.uv, side.u.uv), s = minus(b.uv, side.v.uv), w = minus(side.v.uv, side.u.uv);
    const double det = cross2(r, s);
    if (det == 0) return;
    const double t = cross2(w, s) / det, q = cross2(w, r) / det;
    if (!(t > 0 && t < 1 && q > 0 && q < 1)) return;
    largest2 = std::max(largest2, etalon::squared_distance(along(side.u.place, a.place, t), along(side.v.place, b.place, q)));
  };
  const std::vector<Face>& faces = side.faces;
  const Face* last = &faces.back();
  for (const Face& old : faces)
    for (const Face& now : faces)
      if (now.stays) {
        cross(old.a, now.a);
        if (&old == last) cross(old.b, now.a);
        if (&now == last) cross(old.a, now.b);
      }
  return std::sqrt(largest2);
}

double ApsMetric::deviation(const Side& side) const {
  const double at_vertex = deviation_at_vertex(side);
  return side.textured ? std::max(at_vertex, deviation_at_crossings(side)) : at_vertex;
}

double ApsMetric::cost(std::uint32_t u, std::uint32_t, std::uint32_t h) {
  gather(u, mesh_.edge_from(u, h));
  double cost = 0;
  for (const Side& side : sides_)
    if (!side.faces.empty()) cost = std::max(cost, side.largest + deviation(side));
  return cost;
}

void ApsMetric::collapse(std::uint32_t u, std::uint32_t, const CollapseMesh::Edge& edge) {
  gather(u, edge);
  for (const Side& side : sides_) {
    if (side.faces.empty()) continue;
    const float bound = rounded_up(side.largest + deviation(side));
    for (const Face& face : side.faces)
      if (face.stays) bounds_[face.face] = bound;
  }
}

}  // namespace etalon::simplify
