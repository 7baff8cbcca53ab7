#include "core/simplify/moved_vertex.h"

#include <limits>

#include "core/math/nearest_point.h"
#include "core/simplify/curve_planes.h"

namespace etalon::simplify {

namespace {

float weighted(const Vec3d& w, float a, float b, float c) { return static_cast<float>(w.x * a + w.y * b + w.z * c); }

Vec4f weighted(const Vec3d& w, const Vec4f& a, const Vec4f& b, const Vec4f& c) {
  return {weighted(w, a.x, b.x, c.x), weighted(w, a.y, b.y, c.y), weighted(w, a.z, b.z, c.z), weighted(w, a.w, b.w, c.w)};
}

Vec2f weighted(const Vec3d& w, const Vec2f& a, const Vec2f& b, const Vec2f& c) {
  return {weighted(w, a.x, b.x, c.x), weighted(w, a.y, b.y, c.y)};
}

void carry_along_edge(const CollapseMesh& mesh, const UnitPositions& positions, std::uint32_t u, std::uint32_t v,
                      const CollapseMesh::Edge& edge, MovedVertex& moved) {
  const double t = nearest_on_segment(to_double(moved.at), to_double(positions.at[v]), to_double(positions.at[u]));
  const Vec3d w{1 - t, t, 0};
  if (!mesh.source().colors.empty()) moved.color = weighted(w, mesh.color(v), mesh.color(u), mesh.color(u));
  if (!mesh.textured()) return;
  if (edge.left != kNone) moved.uv[0] = weighted(w, mesh.uv(CollapseMesh::next(edge.left)), mesh.uv(edge.left), mesh.uv(edge.left));
  if (edge.right != kNone) {
    const Vec2f& of_u = mesh.uv(CollapseMesh::next(edge.right));
    moved.uv[1] = weighted(w, mesh.uv(edge.right), of_u, of_u);
  }
}

}  // namespace

MovedVertex carried(const CollapseMesh& mesh, const UnitPositions& positions, std::uint32_t u, std::uint32_t v,
                    const CollapseMesh::Edge& edge, const Vec3f& at) {
  MovedVertex moved;
  moved.at = at;
  const bool colored = !mesh.source().colors.empty();
  if (!colored && !mesh.textured()) return moved;
  if (mesh.kind(v) == VertexKind::curve) {
    carry_along_edge(mesh, positions, u, v, edge, moved);
    return moved;
  }
  const Vec3d p = to_double(at);
  std::uint32_t face = kNone;
  Vec3d weights{0, 0, 0};
  double distance2 = std::numeric_limits<double>::infinity();
  const auto consider = [&](std::uint32_t h) {
    const std::uint32_t f = h >> 2;
    const auto corner = [&](std::uint32_t k) { return to_double(positions.at[mesh.start(4 * f + k)]); };
    const NearestOnTriangle found = nearest_on_triangle(p, corner(0), corner(1), corner(2));
    if (found.distance2 > distance2 || (found.distance2 == distance2 && f >= face)) return;
    face = f;
    weights = found.weights;
    distance2 = found.distance2;
  };
  for_each_corner(mesh, u, consider);
  for_each_corner(mesh, v, consider);
  const std::uint32_t h = 4 * face;
  if (colored) moved.color = weighted(weights, mesh.color(mesh.start(h)), mesh.color(mesh.start(h + 1)), mesh.color(mesh.start(h + 2)));
  if (mesh.textured()) moved.uv[0] = moved.uv[1] = weighted(weights, mesh.uv(h), mesh.uv(h + 1), mesh.uv(h + 2));
  return moved;
}

void move_vertex(CollapseMesh& mesh, UnitPositions& positions, std::uint32_t v, const CollapseMesh::Edge& edge, const MovedVertex& moved) {
  positions.at[v] = moved.at;
  mesh.move(v, model_place(positions, moved.at));
  if (!mesh.source().colors.empty()) mesh.set_color(v, moved.color);
  if (!mesh.textured()) return;
  if (edge.left != kNone) mesh.set_uv(mesh.wedge(CollapseMesh::next(edge.left)), moved.uv[0]);
  if (edge.right != kNone) mesh.set_uv(mesh.wedge(edge.right), moved.uv[1]);
}

}  // namespace etalon::simplify
