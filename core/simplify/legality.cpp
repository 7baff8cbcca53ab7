#include "core/simplify/legality.h"

#include <algorithm>
#include <cmath>

#include "core/mesh/exact_orientation.h"

namespace etalon::simplify {

namespace {

// Exact. The two products of differences are each off by at most 3·2^-53 of themselves and their difference by another 2^-53, in all less
// than 2^-50 of the products' magnitudes together; nothing underflows (differences of floats are multiples of 2^-149).
int uv_orientation(const Vec2f& a, const Vec2f& b, const Vec2f& c) {
  const double x0 = static_cast<double>(b.x) - a.x, y0 = static_cast<double>(b.y) - a.y;
  const double x1 = static_cast<double>(c.x) - a.x, y1 = static_cast<double>(c.y) - a.y;
  const double p = x0 * y1, q = y0 * x1, det = p - q;
  if (std::fabs(det) > 0x1p-50 * (std::fabs(p) + std::fabs(q))) return det > 0 ? 1 : -1;
  return orientation(a, b, c);
}

}  // namespace

const char* to_string(Refusal refusal) {
  switch (refusal) {
    case Refusal::none: return "none";
    case Refusal::link: return "link_condition";
    case Refusal::last_faces: return "last_faces";
    case Refusal::curve: return "curve_closes";
    case Refusal::flip_in_space: return "flip_in_space";
    case Refusal::flip_in_texture: return "flip_in_texture";
    case Refusal::tolerance: return "beyond_tolerance";
  }
  return "";
}

Refusal Legality::check_topology(std::uint32_t u, std::uint32_t v, const CollapseMesh::Edge& edge) {
  if (!link_holds(u, v, edge)) return Refusal::link;
  if (last_faces(u, v, edge)) return Refusal::last_faces;
  if (closes_curve(edge)) return Refusal::curve;
  return Refusal::none;
}

Refusal Legality::check(std::uint32_t u, const CollapseMesh::Edge& edge) {
  const std::uint32_t v = edge.left != kNone ? mesh_.end(edge.left) : mesh_.start(edge.right);
  if (const Refusal refusal = check_topology(u, v, edge); refusal != Refusal::none) return refusal;
  if (flips_in_space(u, places_[v], edge)) return Refusal::flip_in_space;
  if (mesh_.textured()) {
    // As CollapseMesh::collapse: v's left wedge counter-clockwise up to the other curve edge of u, its right one behind.
    const Vec2f* right = edge.right != kNone ? &mesh_.uv(edge.right) : nullptr;
    const Vec2f* left = edge.left != kNone ? &mesh_.uv(CollapseMesh::next(edge.left)) : nullptr;
    if (flips_in_texture(u, edge, left, right)) return Refusal::flip_in_texture;
  }
  return Refusal::none;
}

Refusal Legality::check_move(std::uint32_t u, std::uint32_t v, const CollapseMesh::Edge& edge, const MovedVertex& moved) {
  if (const Refusal refusal = check_topology(u, v, edge); refusal != Refusal::none) return refusal;
  if (flips_in_space(u, moved.at, edge) || flips_in_space(v, moved.at, edge)) return Refusal::flip_in_space;
  if (!mesh_.textured()) return Refusal::none;
  const Vec2f *left = &moved.uv[0], *right = &moved.uv[1];
  if (flips_in_texture(u, edge, left, right)) return Refusal::flip_in_texture;
  // Seen from v the sides change places.
  if (flips_in_texture(v, {edge.right, edge.left}, right, left)) return Refusal::flip_in_texture;
  return Refusal::none;
}

// Common neighbours of u and v are the third corners of the faces on their edge, and no others; an inner edge does not join two boundaries.
// Neighbours are told apart by the source's vertices: several fans at one place count as one, or a hole between two of them could close
// unseen.
bool Legality::link_holds(std::uint32_t u, std::uint32_t v, const CollapseMesh::Edge& edge) {
  if (edge.face_count() == 2 && mesh_.on_boundary(u) && mesh_.on_boundary(v)) return false;
  if (++current_ == 0) {  // the counter ran around: old marks must not look new
    std::fill(marks_.begin(), marks_.end(), 0);
    current_ = 1;
  }
  const std::uint32_t place = mesh_.origin(v);
  bool meets = false;
  mesh_.for_each_neighbor(u, [&](std::uint32_t n, std::uint32_t) {
    const std::uint32_t origin = mesh_.origin(n);
    meets = meets || (n != v && origin == place);
    marks_[origin] = current_;
  });
  if (meets) return false;
  int common = 0;
  mesh_.for_each_fan(v, [&](std::uint32_t fan) {
    mesh_.for_each_neighbor(fan, [&](std::uint32_t n, std::uint32_t) { common += marks_[mesh_.origin(n)] == current_ ? 1 : 0; });
  });
  return common == edge.face_count();
}

bool Legality::last_faces(std::uint32_t u, std::uint32_t v, const CollapseMesh::Edge& edge) const {
  if (edge.face_count() == 1) {
    const std::uint32_t h = edge.left != kNone ? edge.left : edge.right;
    return mesh_.opposite(CollapseMesh::next(h)) == kNone && mesh_.opposite(CollapseMesh::previous(h)) == kNone;
  }
  const auto is_three = [&](std::uint32_t w) {
    const std::uint32_t first = mesh_.first_out(w), second = mesh_.rotate(first);
    if (second == kNone) return false;
    const std::uint32_t third = mesh_.rotate(second);
    return third != kNone && mesh_.rotate(third) == first;
  };
  return is_three(u) && is_three(v);
}

bool Legality::closes_curve(const CollapseMesh::Edge& edge) const {
  const auto both = [&](std::uint32_t h) {
    return h != kNone && mesh_.on_curve(CollapseMesh::next(h)) && mesh_.on_curve(CollapseMesh::previous(h));
  };
  return both(edge.left) || both(edge.right);
}

// Of the faces of w but the two at the edge, w going to `to`.
bool Legality::flips_in_space(std::uint32_t w, const Vec3f& to, const CollapseMesh::Edge& edge) const {
  const Vec3f& from = places_[w];
  const double least = options_.min_normal_cosine * options_.min_normal_cosine;
  const std::uint32_t left = edge.left >> 2, right = edge.right >> 2;
  const std::uint32_t first = mesh_.first_out(w);
  std::uint32_t h = first;
  do {
    const std::uint32_t back = CollapseMesh::previous(h);
    if (h >> 2 != left && h >> 2 != right) {
      const Vec3f &x = places_[mesh_.end(h)], &y = places_[mesh_.start(back)];
      const Vec3d before = cross_product(difference_of(from, x), difference_of(from, y)),
                  after = cross_product(difference_of(to, x), difference_of(to, y));
      const double area_before = dot_product(before, before), area_after = dot_product(after, after);
      // A face that has no area has no side to keep.
      if (area_before > 0) {
        const double turn = dot_product(before, after);
        if (!(turn > 0 && turn * turn > least * (area_before * area_after))) return true;
      }
    }
    h = mesh_.opposite(back);
  } while (h != kNone && h != first);
  return false;
}

// Of the faces of w but the two at the edge, which leaves w; w's texture coordinates becoming *left and *right of it.
bool Legality::flips_in_texture(std::uint32_t w, const CollapseMesh::Edge& edge, const Vec2f* left, const Vec2f* right) const {
  const Vec2f* target = edge.left != kNone ? left : right;
  const std::uint32_t left_face = edge.left >> 2, right_face = edge.right >> 2;
  const std::uint32_t first = edge.left != kNone ? edge.left : mesh_.first_out(w);
  std::uint32_t h = first;
  do {
    const std::uint32_t back = CollapseMesh::previous(h);
    if (h >> 2 != left_face && h >> 2 != right_face) {
      const int sign = mesh_.uv_sign(h >> 2);
      if (sign != 0 && uv_orientation(*target, mesh_.uv(CollapseMesh::next(h)), mesh_.uv(back)) != sign) return true;
    }
    if (mesh_.on_curve(back)) target = right;
    h = mesh_.opposite(back);
  } while (h != kNone && h != first);
  return false;
}

}  // namespace etalon::simplify
