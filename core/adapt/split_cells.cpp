#include "core/adapt/split_cells.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/math/nearest_point.h"
#include "core/mesh/exact_orientation.h"

namespace etalon::adapt {
namespace {

using progressive::kNone;
using progressive::ProgressiveMesh;

// A triangle (u, a, b) around u, by wedges.
struct Spoke {
  std::uint32_t u, a, b;
};

// The triangles of one side in order, counter-clockwise in the mesh, from the one that begins at `first_wedge` where they close.
std::vector<Spoke> in_order(std::vector<Spoke> spokes, std::uint32_t first_wedge, bool& closed) {
  const auto followed = [&](std::uint32_t wedge) {
    return std::find_if(spokes.begin(), spokes.end(), [&](const Spoke& s) { return s.a == wedge; });
  };
  // Open: one triangle begins where none ends.
  auto start = std::find_if(spokes.begin(), spokes.end(), [&](const Spoke& s) {
    return std::none_of(spokes.begin(), spokes.end(), [&](const Spoke& other) { return other.b == s.a; });
  });
  closed = start == spokes.end();
  std::vector<Spoke> ordered;
  for (auto at = closed ? followed(first_wedge) : start; at != spokes.end();) {
    const std::uint32_t next = at->b;
    ordered.push_back(*at);
    spokes.erase(at);
    at = followed(next);
  }
  return spokes.empty() ? ordered : std::vector<Spoke>{};
}

Vec2f mirrored(const Vec2f& uv, bool reflected) { return reflected ? Vec2f{uv.x, -uv.y} : uv; }

ChartCells as_in_chart(std::optional<RingCells> cells, bool reflected) {
  if (!cells) return {CellStatus::no_place, {}};
  if (reflected)
    for (CellNode& node : cells->nodes) node = {mirrored(node.before, true), mirrored(node.after, true)};
  return {CellStatus::made, std::move(*cells)};
}

// The corners around u or v on one side, counter-clockwise.
struct Fan {
  std::uint32_t center = kNone;
  std::vector<std::uint32_t> around;
  bool closed = false, reflected = false;  ///< reflected: clockwise in the texture
};

class SplitRing {
 public:
  SplitRing(const ProgressiveMesh& mesh, std::size_t split, const VertexFaces* faces)
      : mesh_(mesh), data_(mesh.data()), split_(data_.splits[split]), faces_(faces), number_(split) {}

  [[nodiscard]] std::vector<ChartRing> rings() const {
    std::vector<Spoke> sides[2];
    for (std::uint32_t c = split_.first_corner; c < split_.end_corner; ++c)
      sides[c < split_.right_corner ? 0 : 1].push_back(spoke(data_.corners[c] >> 2, data_.corners[c] & 3));
    for (std::uint32_t f = split_.first_face; f < end_face(); ++f) add_new_face(f, sides);
    const bool moves = split_.move != kNone;
    if (moves && !sides[0].empty() && !sides[1].empty() && sides[0].front().u == sides[1].front().u) {
      sides[0].insert(sides[0].end(), sides[1].begin(), sides[1].end());  // nothing but the curve's name parts them
      sides[1].clear();
    }
    std::vector<ChartRing> result;
    for (const std::vector<Spoke>& side : sides) {
      if (side.empty()) continue;
      const auto fan = fan_of(side, split_.parent);
      if (!fan)
        result.push_back({CellStatus::no_fan, {}, {}, false});
      else if (moves)
        add_full_edge(*fan, result);
      else
        result.push_back(half_edge(*fan, nullptr, std::nullopt));
    }
    return result;
  }

 private:
  [[nodiscard]] std::uint32_t vertex(std::uint32_t wedge) const { return data_.wedges[wedge].vertex.index; }
  [[nodiscard]] const Vec2f& uv(std::uint32_t wedge) const { return mesh_.uv(wedge); }
  [[nodiscard]] const Vec3f& position(std::uint32_t wedge) const { return mesh_.position(vertex(wedge)); }
  [[nodiscard]] std::uint32_t u() const { return data_.base_vertices + static_cast<std::uint32_t>(number_); }
  [[nodiscard]] std::uint32_t end_face() const { return static_cast<std::uint32_t>(mesh_.face_count_at(number_ + 1)); }

  [[nodiscard]] Spoke spoke(std::uint32_t face, std::uint32_t corner) const {
    const auto& wedges = mesh_.face_wedges(face);
    return {wedges[corner], wedges[(corner + 1) % 3], wedges[(corner + 2) % 3]};
  }

  // A face on the edge u–v: the one where v follows u is on the left. The right one is a side of its own where u is on a curve; where it has
  // u's wedge of the left side and nothing else is on the right, u is interior (or nothing but the curve's name parts the two).
  void add_new_face(std::uint32_t face, std::vector<Spoke> (&sides)[2]) const {
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      const Spoke s = spoke(face, corner);
      if (vertex(s.u) != u()) continue;
      const bool left = vertex(s.a) == split_.parent, one_side = sides[1].empty() && s.u == split_.wedge[0];
      sides[left || one_side ? 0 : 1].push_back(s);
    }
  }

  // The spokes of one center in order, from `first` where they close; nothing where they are no fan that has `first` at an end (or at all).
  [[nodiscard]] std::optional<Fan> fan_of(const std::vector<Spoke>& side, std::uint32_t first) const {
    const auto of_first = std::find_if(side.begin(), side.end(), [&](const Spoke& s) { return vertex(s.a) == first; });
    Fan fan;
    const std::vector<Spoke> spokes = in_order(side, of_first != side.end() ? of_first->a : kNone, fan.closed);
    if (spokes.empty()) return std::nullopt;
    fan.center = spokes.front().u;
    for (const Spoke& s : spokes) fan.around.push_back(s.a);
    if (!fan.closed) fan.around.push_back(spokes.back().b);
    int turned = 0;
    for (const Spoke& s : spokes) turned += orientation(uv(s.u), uv(s.a), uv(s.b));
    fan.reflected = turned < 0;
    if (vertex(fan.around.front()) != first && (fan.closed || vertex(fan.around.back()) != first)) return std::nullopt;
    return fan;
  }

  // The collapse of a fan's center into the corner at its begin or end: as it is, or as another point `merged` with another coordinate.
  [[nodiscard]] ChartRing half_edge(Fan fan, const Vec2f* merged_uv, std::optional<Vec2f> before) const {
    if (!fan.closed && vertex(fan.around.front()) != target_of(fan)) {  // the right side of a curve leads to v
      std::reverse(fan.around.begin(), fan.around.end());
      fan.reflected = !fan.reflected;
    }
    ChartRing result;
    result.reflected = fan.reflected;
    CollapseRing& ring = result.ring;
    const auto place = [&](std::uint32_t wedge) { return mirrored(uv(wedge), fan.reflected); };
    ring.on_curve = !fan.closed;
    ring.uv_of_u = place(fan.center), ring.position_of_u = position(fan.center);
    for (const std::uint32_t wedge : fan.around) ring.uv.push_back(place(wedge)), ring.positions.push_back(position(wedge));
    if (merged_uv != nullptr) {
      ring.uv.front() = mirrored(*merged_uv, fan.reflected), ring.positions.front() = merged().position;
      if (before) ring.uv_of_v_before = mirrored(*before, fan.reflected);
    }
    if (ring.on_curve && ring.size() == 2)
      result.status = CellStatus::gone;
    else if (ring.size() < 3 || !is_unfolded(ring))
      result.status = CellStatus::fold;
    return result;
  }

  // The other end of the edge: v of u's fan, u of v's.
  [[nodiscard]] std::uint32_t target_of(const Fan& fan) const { return vertex(fan.center) == u() ? split_.parent : u(); }

  [[nodiscard]] const progressive::ParentMove& merged() const { return mesh_.merged_parent(number_); }

  // The merged vertex' coordinate in place of v's wedge; nothing where none is left there.
  [[nodiscard]] const Vec2f* merged_uv(std::uint32_t wedge_of_v) const {
    for (std::size_t side = 0; side < 2; ++side)
      if (merged().wedge[side] == wedge_of_v) return &merged().uv[side];
    return nullptr;
  }

  // v's triangles on the side of u's fan.
  [[nodiscard]] std::optional<Fan> fan_of_parent(std::uint32_t wedge_of_v, bool closed) const {
    std::vector<Spoke> all;
    const auto add = [&](std::uint32_t face) {
      for (std::uint32_t corner = 0; corner < 3; ++corner)
        if (const Spoke s = spoke(face, corner); s.u == wedge_of_v) all.push_back(s);
    };
    if (faces_ != nullptr) {
      for (const std::uint32_t face : faces_->of(split_.parent)) add(face);
    } else {
      for (std::uint32_t face = 0; face < end_face(); ++face) add(face);
    }
    const auto fan = fan_of(all, u());
    return fan && fan->closed == closed ? fan : std::nullopt;
  }

  void add_full_edge(const Fan& of_u, std::vector<ChartRing>& result) const {
    const auto front_is_v = vertex(of_u.around.front()) == split_.parent;
    const std::uint32_t wedge_of_v = front_is_v ? of_u.around.front() : of_u.around.back();
    const Vec2f* const uv_of_w = merged_uv(wedge_of_v);
    const auto of_v = fan_of_parent(wedge_of_v, of_u.closed);
    if (!of_v) return result.push_back({CellStatus::no_fan, {}, {}, false});
    if (uv_of_w == nullptr) return result.push_back({CellStatus::gone, {}, {}, false});
    // Where the merged vertex is one of both in the texture, only the other one goes.
    if (*uv_of_w == uv(wedge_of_v)) return result.push_back(half_edge(of_u, uv_of_w, std::nullopt));
    if (*uv_of_w == uv(of_u.center)) return result.push_back(half_edge(*of_v, uv_of_w, std::nullopt));
    if (of_u.closed) return result.push_back(full_edge(of_u, *of_v, *uv_of_w));
    const double t = nearest_on_segment(to_double(merged().position), to_double(position(of_v->center)), to_double(position(of_u.center)));
    if (!(t > 0 && t < 1)) return result.push_back({CellStatus::no_place, {}, {}, false});
    const Vec2d from(uv(of_v->center));
    const Vec2f before(from + t * (Vec2d(uv(of_u.center)) - from));
    result.push_back(half_edge(of_u, uv_of_w, before));
    result.push_back(half_edge(*of_v, uv_of_w, before));
  }

  [[nodiscard]] ChartRing full_edge(const Fan& of_u, const Fan& of_v, const Vec2f& uv_of_w) const {
    ChartRing result;
    result.reflected = of_u.reflected;
    EdgeRing ring;
    const auto place = [&](const Vec2f& p) { return mirrored(p, of_u.reflected); };
    ring.position_of_u = position(of_u.center), ring.position_of_v = position(of_v.center), ring.position_of_w = merged().position;
    ring.uv_of_u = place(uv(of_u.center)), ring.uv_of_v = place(uv(of_v.center)), ring.uv_of_w = place(uv_of_w);
    // Around u: v, a, …, b; around v: u, b, …, a.
    std::vector<std::uint32_t> corners(of_u.around.begin() + 1, of_u.around.end());
    if (corners.size() < 2 || of_v.around.size() < 3 || of_v.around[1] != corners.back() || of_v.around.back() != corners.front())
      return {CellStatus::no_fan, {}, {}, false};
    ring.last_of_u = corners.size() - 1;
    corners.insert(corners.end(), of_v.around.begin() + 2, of_v.around.end() - 1);
    for (const std::uint32_t w : corners) ring.uv.push_back(place(uv(w))), ring.positions.push_back(position(w));
    if (ring.size() < 3 || ring.last_of_u >= ring.size() || !is_unfolded(ring)) {
      result.status = CellStatus::fold;
      return result;
    }
    result.edge = std::move(ring);
    return result;
  }

  const ProgressiveMesh& mesh_;
  const progressive::ProgressiveData& data_;
  const progressive::VertexSplit& split_;
  const VertexFaces* faces_;
  std::size_t number_;
};

}  // namespace

const char* to_string(CellStatus status) {
  switch (status) {
    case CellStatus::made: return "made";
    case CellStatus::fold: return "fold";
    case CellStatus::no_place: return "no_place";
    case CellStatus::gone: return "gone";
    case CellStatus::no_fan: return "no_fan";
  }
  return "";
}

std::vector<ChartRing> rings_of_split(const ProgressiveMesh& mesh, std::size_t split, const VertexFaces* faces) {
  ETALON_CHECK(split < mesh.split_count() && mesh.level() == split + 1,
               fmt::format("cells of split {} of {}: the mesh is at level {}", split, mesh.split_count(), mesh.level()));
  ETALON_CHECK(mesh.data().has_uv, "cells of a mesh without texture coordinates");
  return SplitRing(mesh, split, faces).rings();
}

ChartCells make_chart_cells(const ChartRing& ring) {
  if (ring.status != CellStatus::made) return {ring.status, {}};
  return as_in_chart(ring.edge ? make_edge_cells(*ring.edge) : make_ring_cells(ring.ring), ring.reflected);
}

ChartCells chart_cells_at(const ChartRing& ring, const CellChoice& choice) {
  if (ring.status != CellStatus::made || ring.edge.has_value() != (choice.plane != OverlayPlane::texture_after))
    return {CellStatus::no_place, {}};
  if (ring.edge) return as_in_chart(edge_cells_at(*ring.edge, {choice.plane, choice.place_share, choice.crossing_share}), ring.reflected);
  return as_in_chart(ring_cells_at(ring.ring, mirrored(choice.place, ring.reflected), choice.place_share, choice.crossing_share),
                     ring.reflected);
}

std::vector<ChartCells> cells_of_split(const ProgressiveMesh& mesh, std::size_t split, const VertexFaces* faces) {
  std::vector<ChartCells> result;
  for (const ChartRing& ring : rings_of_split(mesh, split, faces)) result.push_back(make_chart_cells(ring));
  return result;
}

}  // namespace etalon::adapt
