#include "core/simplify/collapse_mesh.h"

#include <fmt/format.h>

#include "core/base/error.h"

namespace etalon::simplify {

CollapseMesh::Edge CollapseMesh::find_edge(std::uint32_t u, std::uint32_t v) const {
  const std::uint32_t first = out_[u];
  std::uint32_t h = first;
  do {
    if (end(h) == v) return edge_from(u, h);
    const std::uint32_t back = previous(h);
    h = opposite(back);
    if (h == kNone) return start(back) == v ? edge_from(u, back) : Edge{};
  } while (h != first);
  return {};
}

// The edges a-u and a-v of a removed face become one: the faces behind them meet.
void CollapseMesh::glue(std::uint32_t kept, std::uint32_t other, bool curve) {
  const auto set = [&](std::uint32_t h, std::uint32_t across) {
    if (h == kNone) return;
    faces_[h >> 2].opposite[h & 3] = across;
    if (curve) faces_[h >> 2].flags |= 1u << (h & 3);
  };
  set(kept, other);
  set(other, kept);
}

void CollapseMesh::drop_face(std::uint32_t at_edge) {
  faces_[at_edge >> 2].flags = 0;
  --face_count_;
}

void CollapseMesh::collapse(std::uint32_t u, const Edge& edge) {
  const std::uint32_t v = edge.left != kNone ? end(edge.left) : start(edge.right);
  const bool textured = !wedges_.empty();
  const std::uint32_t wedge_left = textured && edge.left != kNone ? wedges_[next(edge.left)] : kNone;
  const std::uint32_t wedge_right = textured && edge.right != kNone ? wedges_[edge.right] : wedge_left;

  // Counter-clockwise from the left face: v's left wedge up to the other curve edge of u, its right one behind.
  std::uint32_t fan_start = out_[u];
  std::uint32_t wedge = wedge_right;
  if (edge.left != kNone) {
    fan_start = edge.left;
    wedge = wedge_left;
  }
  for (std::uint32_t h = fan_start;;) {
    faces_[h >> 2].vertex[h & 3] = v;
    if (textured) wedges_[h] = wedge;
    const std::uint32_t back = previous(h);
    if (on_curve(back)) wedge = wedge_right;
    h = opposite(back);
    if (h == kNone || h == fan_start) break;
  }

  // In the left face u, v, a: across v→a and a→u; in the right face v, u, b: across u→b and b→v.
  std::uint32_t left_v = kNone, left_u = kNone, right_u = kNone, right_v = kNone;
  if (edge.left != kNone) {
    const std::uint32_t va = next(edge.left), au = previous(edge.left);
    left_v = opposite(va);
    left_u = opposite(au);
    glue(left_v, left_u, on_curve(va) || on_curve(au));
    const std::uint32_t a = start(au);
    if (out_[a] == au) out_[a] = left_v;
    // v→a was the first of v's open fan: its place is taken by what was u→a.
    if (out_[v] == va) out_[v] = left_u;
  }
  if (edge.right != kNone) {
    const std::uint32_t ub = next(edge.right), bv = previous(edge.right);
    right_u = opposite(ub);
    right_v = opposite(bv);
    glue(right_u, right_v, on_curve(ub) || on_curve(bv));
    const std::uint32_t b = start(bv);
    if (out_[b] == bv) out_[b] = right_u;
    if (out_[v] == edge.right) out_[v] = edge.left != kNone ? left_u : (out_[u] == ub ? right_v : out_[u]);
  }
  if (edge.left != kNone) drop_face(edge.left);
  if (edge.right != kNone) drop_face(edge.right);
  out_[u] = kNone;
}

void CollapseMesh::allow_moves() {
  if (moves_) return;
  moves_ = true;
  positions_ = source_->positions;
  colors_ = source_->colors;
  if (!source_->has_uv) return;
  uvs_.reserve(source_->wedge_count());
  for (const Wedge& wedge : source_->wedges) uvs_.push_back(wedge.uv);
}

std::string CollapseMesh::violation() const {
  std::vector<std::uint32_t> uses(vertex_capacity(), 0);
  std::uint32_t alive = 0;
  for (std::uint32_t f = 0; f < face_capacity(); ++f) {
    if (!face_alive(f)) continue;
    ++alive;
    const auto& v = faces_[f].vertex;
    if (origin(v[0]) == origin(v[1]) || origin(v[1]) == origin(v[2]) || origin(v[2]) == origin(v[0]))
      return fmt::format("face {} names a vertex twice: {} {} {}", f, v[0], v[1], v[2]);
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t h = 4 * f + k, o = opposite(h);
      if (!vertex_alive(v[k])) return fmt::format("face {} names the removed vertex {}", f, v[k]);
      ++uses[v[k]];
      if (!wedges_.empty() && source_->wedges[wedges_[h]].vertex.index != origin(v[k]))
        return fmt::format("half-edge {}: wedge {} is not of vertex {}", h, wedges_[h], v[k]);
      if (o == kNone) {
        if (!on_curve(h)) return fmt::format("half-edge {} on a boundary is on no curve", h);
        continue;
      }
      if (!face_alive(o >> 2) || opposite(o) != h) return fmt::format("half-edges {} and {} are not mutual", h, o);
      if (start(o) != end(h) || end(o) != start(h)) return fmt::format("half-edges {} and {} join different vertices", h, o);
      if (on_curve(o) != on_curve(h)) return fmt::format("half-edges {} and {}: one side is on a curve", h, o);
      if (!wedges_.empty() && !on_curve(h)) {
        if (uv(h) != uv(next(o)) || uv(next(h)) != uv(o)) return fmt::format("half-edge {}: texture coordinates part beside a curve", h);
      }
    }
  }
  if (alive != face_count_) return fmt::format("{} faces, counted {}", alive, face_count_);
  for (std::uint32_t v = 0; v < vertex_capacity(); ++v) {
    if (!vertex_alive(v)) {
      if (uses[v] > 0) return fmt::format("vertex {} has faces and no fan", v);
      continue;
    }
    if (start(out_[v]) != v || !face_alive(out_[v] >> 2)) return fmt::format("vertex {} starts at half-edge {}", v, out_[v]);
    std::uint32_t fan = 0, curves = 0;
    for (std::uint32_t h = out_[v]; h != kNone; h = rotate(h)) {
      ++fan;
      curves += on_curve(h) ? 1 : 0;
      if (rotate(h) == kNone) ++curves;  // the open fan's last edge
      if (rotate(h) == out_[v] || fan > uses[v]) break;
    }
    if (fan != uses[v]) return fmt::format("vertex {}: a fan of {} faces, used by {}", v, fan, uses[v]);
    const VertexKind by_count = curves == 0 ? VertexKind::interior : curves == 2 ? VertexKind::curve : VertexKind::locked;
    if (kinds_[v] != by_count && kinds_[v] != VertexKind::locked) return fmt::format("vertex {} has {} curve edges", v, curves);
  }
  return {};
}

std::size_t CollapseMesh::memory_bytes() const {
  return faces_.size() * sizeof(Face) + (wedges_.size() + out_.size() + extra_origin_.size()) * sizeof(std::uint32_t) + kinds_.size() +
         positions_.size() * sizeof(Vec3f) + colors_.size() * sizeof(Vec4f) + uvs_.size() * sizeof(Vec2f);
}

}  // namespace etalon::simplify
