#include "core/progressive/progressive_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/error.h"

namespace etalon::progressive {

namespace {

[[noreturn]] void refuse(std::size_t split, const std::string& what) { throw InputError(fmt::format("split {}: {}", split, what)); }

std::vector<std::uint32_t> order_of(const std::vector<std::uint32_t>& ids, const char* what) {
  std::vector<std::uint32_t> order(ids.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return ids[a] != ids[b] ? ids[a] < ids[b] : a < b; });
  for (std::size_t i = 1; i < order.size(); ++i)
    if (ids[order[i]] == ids[order[i - 1]]) throw InputError(fmt::format("{} {}: expected once, got twice", what, ids[order[i]]));
  return order;
}

bool finite(const Vec3f& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

}  // namespace

bool operator==(const VertexSplit& a, const VertexSplit& b) {
  return a.parent == b.parent && a.first_wedge == b.first_wedge && a.first_face == b.first_face && a.wedge_of_parent == b.wedge_of_parent &&
         a.wedge == b.wedge && a.first_corner == b.first_corner && a.right_corner == b.right_corner && a.end_corner == b.end_corner &&
         a.move == b.move;
}

ProgressiveMesh::ProgressiveMesh(ProgressiveData data) : data_(std::move(data)) {
  check_base();
  vertex_order_ = order_of(data_.vertex_ids, "vertex id");
  wedge_order_ = order_of(data_.wedge_ids, "wedge id");
  face_order_ = order_of(data_.face_ids, "face id");
  faces_ = data_.faces;
  moving_ = !data_.moves.empty();
  if (moving_) {
    positions_ = data_.positions, colors_ = data_.colors;
    for (const Wedge& wedge : data_.wedges) uvs_.push_back(wedge.uv);
  }
  std::vector<std::uint32_t> wedge_uses = uses_in_base();
  while (level_ < split_count()) {
    check_split(level_);
    check_move(level_);
    refine();
    check_uses(level_ - 1, wedge_uses);
  }
  if (coarse_.size() != data_.moves.size())
    throw InputError(fmt::format("moves: expected {} splits that name one, got {}", data_.moves.size(), coarse_.size()));
  go_to(0);
}

void ProgressiveMesh::check_base() const {
  const ProgressiveData& d = data_;
  const auto sizes = [&](const char* what, std::size_t expected, std::size_t got) {
    if (expected != got) throw InputError(fmt::format("{}: expected {}, got {}", what, expected, got));
  };
  sizes("vertices", d.base_vertices + d.splits.size(), d.positions.size());
  sizes("vertex ids", d.positions.size(), d.vertex_ids.size());
  sizes("colours", d.has_colors ? d.positions.size() : 0, d.colors.size());
  sizes("wedge ids", d.wedges.size(), d.wedge_ids.size());
  sizes("face ids", d.faces.size(), d.face_ids.size());
  sizes("materials", d.has_materials ? d.faces.size() : 0, d.materials.size());
  if (d.base_wedges > d.wedges.size() || d.base_faces > d.faces.size() || d.base_faces == 0)
    throw InputError(fmt::format("base: expected 1 to {} faces and at most {} wedges, got {} and {}", d.faces.size(), d.wedges.size(),
                                 d.base_faces, d.base_wedges));
  for (std::size_t v = 0; v < d.positions.size(); ++v)
    if (!finite(d.positions[v])) throw InputError(fmt::format("vertex {}: position: expected finite numbers", v));
  for (std::size_t v = 0; v < d.colors.size(); ++v)
    for (int k = 0; k < 4; ++k)
      if (!std::isfinite(d.colors[v][k])) throw InputError(fmt::format("vertex {}: colour: expected finite numbers", v));
  for (std::size_t w = 0; w < d.wedges.size(); ++w) {
    if (!std::isfinite(d.wedges[w].uv.x) || !std::isfinite(d.wedges[w].uv.y))
      throw InputError(fmt::format("wedge {}: uv: expected finite numbers", w));
    const std::size_t limit = w < d.base_wedges ? d.base_vertices : d.positions.size();
    if (d.wedges[w].vertex.index >= limit)
      throw InputError(fmt::format("wedge {}: vertex: expected below {}, got {}", w, limit, d.wedges[w].vertex.index));
  }
  for (std::uint32_t f = 0; f < d.base_faces; ++f) {
    for (const std::uint32_t w : d.faces[f])
      if (w >= d.base_wedges) throw InputError(fmt::format("face {}: wedge: expected below {}, got {}", f, d.base_wedges, w));
    const auto vertex = [&](std::size_t k) { return d.wedges[d.faces[f][k]].vertex; };
    if (vertex(0) == vertex(1) || vertex(1) == vertex(2) || vertex(2) == vertex(0))
      throw InputError(fmt::format("face {}: expected three vertices", f));
  }
  check_materials();
}

void ProgressiveMesh::check_materials() const {
  const std::vector<std::string>& names = data_.material_names;
  for (std::size_t m = 0; m < names.size(); ++m)
    for (const char c : names[m])
      if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F)
        throw InputError(fmt::format("material {}: expected a name without control characters", m));
  if (names.empty()) return;
  for (std::size_t f = 0; f < data_.materials.size(); ++f)
    if (data_.materials[f] >= names.size())
      throw InputError(fmt::format("face {}: material: expected below {}, got {}", f, names.size(), data_.materials[f]));
}

// How many corners of the base each wedge has.
std::vector<std::uint32_t> ProgressiveMesh::uses_in_base() const {
  std::vector<std::uint32_t> wedge_uses(data_.wedges.size(), 0);
  std::vector<bool> vertex_used(data_.base_vertices, false);
  for (std::uint32_t f = 0; f < data_.base_faces; ++f)
    for (const std::uint32_t w : data_.faces[f]) ++wedge_uses[w];
  for (std::uint32_t w = 0; w < data_.base_wedges; ++w) {
    if (wedge_uses[w] == 0) throw InputError(fmt::format("wedge {}: expected a face of the base that has it", w));
    vertex_used[data_.wedges[w].vertex.index] = true;
  }
  for (std::uint32_t v = 0; v < data_.base_vertices; ++v)
    if (!vertex_used[v]) throw InputError(fmt::format("vertex {}: expected a face of the base that has it", v));
  return wedge_uses;
}

// After split `i`: the wedges it brought, and those whose corners it took away, are still some face's. Then so are the vertices: wedges never
// go on the way up.
void ProgressiveMesh::check_uses(std::size_t i, std::vector<std::uint32_t>& wedge_uses) const {
  const VertexSplit& s = data_.splits[i];
  for (std::size_t f = s.first_face; f < face_count_at(i + 1); ++f)
    for (const std::uint32_t w : data_.faces[f]) ++wedge_uses[w];
  const std::array<std::uint32_t, 2> moved{s.right_corner - s.first_corner, s.end_corner - s.right_corner};
  for (std::size_t side = 0; side < 2; ++side) {
    if (moved[side] == 0) continue;
    wedge_uses[s.wedge[side]] += moved[side];
    wedge_uses[s.wedge_of_parent[side]] -= moved[side];
  }
  const auto require_use = [&](std::uint32_t w) {
    if (wedge_uses[w] == 0) refuse(i, fmt::format("wedge {}: expected a face that has it", w));
  };
  bool has_vertex = false;
  for (std::size_t w = s.first_wedge; w < wedge_count_at(i + 1); ++w) {
    require_use(static_cast<std::uint32_t>(w));
    has_vertex = has_vertex || data_.wedges[w].vertex.index == data_.base_vertices + i;
  }
  for (std::size_t side = 0; side < 2; ++side)
    if (moved[side] > 0) require_use(s.wedge_of_parent[side]);
  if (!has_vertex) refuse(i, "expected a wedge of the new vertex");
}

// At level `i`: whether split i can be done.
void ProgressiveMesh::check_split(std::size_t i) const {
  const VertexSplit& s = data_.splits[i];
  const std::uint32_t u = data_.base_vertices + static_cast<std::uint32_t>(i);
  const std::size_t wedges_before = s.first_wedge, wedges_after = wedge_count_at(i + 1), faces_after = face_count_at(i + 1);
  if (s.parent >= u) refuse(i, fmt::format("parent: expected below {}, got {}", u, s.parent));
  if (i == 0 && (s.first_wedge != data_.base_wedges || s.first_face != data_.base_faces)) refuse(i, "expected to follow the base");
  if (faces_after <= s.first_face || faces_after > s.first_face + 2u || faces_after > data_.faces.size())
    refuse(i, fmt::format("faces: expected one or two, got {} to {}", s.first_face, faces_after));
  if (wedges_after < wedges_before || wedges_after > data_.wedges.size())
    refuse(i, fmt::format("wedges: expected up to {}, got {} to {}", data_.wedges.size(), wedges_before, wedges_after));
  for (std::size_t w = wedges_before; w < wedges_after; ++w)
    if (data_.wedges[w].vertex.index > u) refuse(i, fmt::format("wedge {}: vertex: expected at most {}", w, u));
  for (std::size_t f = s.first_face; f < faces_after; ++f) {
    std::array<std::uint32_t, 3> v{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t w = data_.faces[f][k];
      if (w >= wedges_after) refuse(i, fmt::format("face {}: wedge: expected below {}, got {}", f, wedges_after, w));
      v[k] = data_.wedges[w].vertex.index;
    }
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) refuse(i, fmt::format("face {}: expected three vertices", f));
    if (std::find(v.begin(), v.end(), u) == v.end() || std::find(v.begin(), v.end(), s.parent) == v.end())
      refuse(i, fmt::format("face {}: expected on the edge {}-{}", f, u, s.parent));
  }
  if (s.first_corner > s.right_corner || s.right_corner > s.end_corner || s.end_corner > data_.corners.size())
    refuse(i, fmt::format("corners: expected up to {}, got {} {} {}", data_.corners.size(), s.first_corner, s.right_corner, s.end_corner));
  std::vector<std::uint32_t> seen(data_.corners.begin() + s.first_corner, data_.corners.begin() + s.end_corner);
  std::sort(seen.begin(), seen.end());
  if (std::adjacent_find(seen.begin(), seen.end()) != seen.end()) refuse(i, "corners: expected each once");
  for (std::uint32_t c = s.first_corner; c < s.end_corner; ++c) {
    const std::size_t side = c < s.right_corner ? 0 : 1;
    const std::uint32_t corner = data_.corners[c], from = s.wedge_of_parent[side], to = s.wedge[side];
    if ((corner & 3) == 3 || (corner >> 2) >= s.first_face)
      refuse(i, fmt::format("corner: expected of a face below {}, got {}", s.first_face, corner));
    if (from >= wedges_before || data_.wedges[from].vertex.index != s.parent || to >= wedges_after || data_.wedges[to].vertex.index != u)
      refuse(i, fmt::format("wedges: expected of {} and {}", s.parent, u));
    if (faces_[corner >> 2][corner & 3] != from)
      refuse(i, fmt::format("corner {}: expected wedge {}, got {}", corner, from, faces_[corner >> 2][corner & 3]));
    for (std::size_t k = 0; k < 3; ++k)
      if (data_.wedges[faces_[corner >> 2][k]].vertex.index == u) refuse(i, fmt::format("face {}: names vertex {} twice", corner >> 2, u));
  }
}

// At level `i`: whether split i's move, if it has one, is the next and moves what is there.
void ProgressiveMesh::check_move(std::size_t i) const {
  const VertexSplit& s = data_.splits[i];
  if (s.move == kNone) return;
  if (s.move != coarse_.size() || s.move >= data_.moves.size())
    refuse(i, fmt::format("move: expected {} of {}, got {}", coarse_.size(), data_.moves.size(), s.move));
  const ParentMove& move = data_.moves[s.move];
  if (!finite(move.position)) refuse(i, "position of the parent: expected finite numbers");
  for (int k = 0; k < 4 && data_.has_colors; ++k)
    if (!std::isfinite(move.color[k])) refuse(i, "colour of the parent: expected finite numbers");
  for (std::size_t side = 0; side < 2; ++side) {
    const std::uint32_t w = move.wedge[side];
    if (w == kNone) continue;
    if (!data_.has_uv || w >= s.first_wedge || data_.wedges[w].vertex.index != s.parent || (side == 1 && w == move.wedge[0]))
      refuse(i, fmt::format("moved wedge: expected one of the parent {}, got {}", s.parent, w));
    if (!std::isfinite(move.uv[side].x) || !std::isfinite(move.uv[side].y)) refuse(i, "uv of the parent: expected finite numbers");
  }
}

std::size_t ProgressiveMesh::face_count_at(std::size_t level) const {
  return level < split_count() ? data_.splits[level].first_face : data_.faces.size();
}

std::size_t ProgressiveMesh::wedge_count_at(std::size_t level) const {
  return level < split_count() ? data_.splits[level].first_wedge : data_.wedges.size();
}

// What a split's move changes, as it is now.
ParentMove ProgressiveMesh::moved_state(const VertexSplit& split) const {
  ParentMove state = data_.moves[split.move];
  state.position = positions_[split.parent];
  if (data_.has_colors) state.color = colors_[split.parent];
  for (std::size_t side = 0; side < 2; ++side)
    if (state.wedge[side] != kNone) state.uv[side] = uvs_[state.wedge[side]];
  return state;
}

void ProgressiveMesh::set_moved(const VertexSplit& split, const ParentMove& state) {
  positions_[split.parent] = state.position;
  if (data_.has_colors) colors_[split.parent] = state.color;
  for (std::size_t side = 0; side < 2; ++side)
    if (state.wedge[side] != kNone) uvs_[state.wedge[side]] = state.uv[side];
}

void ProgressiveMesh::refine() {
  const VertexSplit& s = data_.splits[level_++];
  if (s.move != kNone) {
    if (s.move == coarse_.size()) coarse_.push_back(moved_state(s));
    set_moved(s, data_.moves[s.move]);
  }
  for (std::uint32_t c = s.first_corner; c < s.end_corner; ++c)
    faces_[data_.corners[c] >> 2][data_.corners[c] & 3] = s.wedge[c < s.right_corner ? 0 : 1];
}

// The faces that go keep the wedges they came with: every later split of theirs has been undone.
void ProgressiveMesh::coarsen() {
  const VertexSplit& s = data_.splits[--level_];
  if (s.move != kNone) set_moved(s, coarse_[s.move]);
  for (std::uint32_t c = s.first_corner; c < s.end_corner; ++c)
    faces_[data_.corners[c] >> 2][data_.corners[c] & 3] = s.wedge_of_parent[c < s.right_corner ? 0 : 1];
}

void ProgressiveMesh::go_to(std::size_t level) {
  ETALON_CHECK(level <= split_count(), fmt::format("level {} of {}", level, split_count()));
  while (level_ < level) refine();
  while (level_ > level) coarsen();
}

void ProgressiveMesh::go_to_faces(std::size_t faces) {
  std::size_t low = 0, high = split_count();
  while (low < high) {
    const std::size_t middle = (low + high + 1) / 2;
    if (face_count_at(middle) <= faces)
      low = middle;
    else
      high = middle - 1;
  }
  go_to(low);
}

Mesh ProgressiveMesh::mesh() const {
  Mesh result;
  result.has_uv = data_.has_uv;
  std::vector<std::uint32_t> new_vertex(data_.positions.size(), kNone), new_wedge(data_.wedges.size(), kNone);
  for (const std::uint32_t v : vertex_order_) {
    if (v >= vertex_count()) continue;
    new_vertex[v] = static_cast<std::uint32_t>(result.positions.size());
    result.positions.push_back(position(v));
    if (data_.has_colors) result.colors.push_back(color(v));
  }
  for (const std::uint32_t w : wedge_order_) {
    if (w >= wedge_count_at(level_)) continue;
    new_wedge[w] = static_cast<std::uint32_t>(result.wedges.size());
    result.wedges.push_back({VertexId(new_vertex[data_.wedges[w].vertex.index]), uv(w)});
  }
  for (const std::uint32_t f : face_order_) {
    if (f >= face_count()) continue;
    result.faces.push_back({WedgeId(new_wedge[faces_[f][0]]), WedgeId(new_wedge[faces_[f][1]]), WedgeId(new_wedge[faces_[f][2]])});
    if (data_.has_materials) result.face_materials.push_back(data_.materials[f]);
  }
  return result;
}

std::string ProgressiveMesh::violation() const {
  std::vector<bool> vertex_used(vertex_count(), false), wedge_used(wedge_count_at(level_), false);
  for (std::size_t f = 0; f < face_count(); ++f) {
    std::array<std::uint32_t, 3> v{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t w = faces_[f][k];
      if (w >= wedge_used.size()) return fmt::format("face {} names wedge {}, which is not there yet", f, w);
      wedge_used[w] = true;
      v[k] = data_.wedges[w].vertex.index;
      if (v[k] >= vertex_used.size()) return fmt::format("face {} names vertex {}, which is not there yet", f, v[k]);
      vertex_used[v[k]] = true;
    }
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) return fmt::format("face {} names a vertex twice", f);
  }
  for (std::size_t w = 0; w < wedge_used.size(); ++w)
    if (!wedge_used[w]) return fmt::format("wedge {} is not used", w);
  for (std::size_t v = 0; v < vertex_used.size(); ++v)
    if (!vertex_used[v]) return fmt::format("vertex {} is not used", v);
  return {};
}

}  // namespace etalon::progressive
