#include "core/adapt/split_cells.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
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

class SplitRing {
 public:
  SplitRing(const ProgressiveMesh& mesh, std::size_t split)
      : mesh_(mesh), data_(mesh.data()), split_(data_.splits[split]), number_(split) {}

  [[nodiscard]] std::vector<ChartRing> rings() const {
    std::vector<Spoke> sides[2];
    for (std::uint32_t c = split_.first_corner; c < split_.end_corner; ++c)
      sides[c < split_.right_corner ? 0 : 1].push_back(spoke(data_.corners[c] >> 2, data_.corners[c] & 3));
    const auto end_face = static_cast<std::uint32_t>(mesh_.face_count_at(number_ + 1));
    for (std::uint32_t f = split_.first_face; f < end_face; ++f) add_new_face(f, sides);
    std::vector<ChartRing> result;
    for (const std::vector<Spoke>& side : sides)
      if (!side.empty()) result.push_back(ring_of(side));
    return result;
  }

 private:
  [[nodiscard]] std::uint32_t vertex(std::uint32_t wedge) const { return data_.wedges[wedge].vertex.index; }

  [[nodiscard]] Spoke spoke(std::uint32_t face, std::uint32_t corner) const {
    const auto& wedges = mesh_.face_wedges(face);
    return {wedges[corner], wedges[(corner + 1) % 3], wedges[(corner + 2) % 3]};
  }

  // A face on the edge u–v: the one where v follows u is on the left. The right one is a side of its own where u is on a curve; where it has
  // u's wedge of the left side and nothing else is on the right, u is interior (or nothing but the curve's name parts the two).
  void add_new_face(std::uint32_t face, std::vector<Spoke> (&sides)[2]) const {
    const std::uint32_t u = data_.base_vertices + static_cast<std::uint32_t>(number_);
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      const Spoke s = spoke(face, corner);
      if (vertex(s.u) != u) continue;
      const bool left = vertex(s.a) == split_.parent, one_side = sides[1].empty() && s.u == split_.wedge[0];
      sides[left || one_side ? 0 : 1].push_back(s);
    }
  }

  [[nodiscard]] ChartRing ring_of(const std::vector<Spoke>& side) const {
    const auto of_parent = std::find_if(side.begin(), side.end(), [&](const Spoke& s) { return vertex(s.a) == split_.parent; });
    bool closed = false;
    const std::vector<Spoke> spokes = in_order(side, of_parent != side.end() ? of_parent->a : kNone, closed);
    if (spokes.empty()) return {CellStatus::no_fan, {}, false};
    std::vector<std::uint32_t> wedges;
    for (const Spoke& s : spokes) wedges.push_back(s.a);
    if (!closed) wedges.push_back(spokes.back().b);

    int turned = 0;
    for (const Spoke& s : spokes) turned += orientation(uv(s.u), uv(s.a), uv(s.b));
    bool reflected = turned < 0;
    if (!closed && vertex(wedges.front()) != split_.parent) {  // the right side of a curve leads to v
      std::reverse(wedges.begin(), wedges.end());
      reflected = !reflected;
    }
    if (vertex(wedges.front()) != split_.parent) return {CellStatus::no_fan, {}, false};
    ChartRing result;
    result.reflected = reflected;
    CollapseRing& ring = result.ring;
    const auto place = [&](std::uint32_t wedge) { return mirrored(uv(wedge), reflected); };
    ring.on_curve = !closed;
    ring.uv_of_u = place(spokes.front().u), ring.position_of_u = mesh_.position(vertex(spokes.front().u));
    for (const std::uint32_t wedge : wedges) ring.uv.push_back(place(wedge)), ring.positions.push_back(mesh_.position(vertex(wedge)));
    if (ring.on_curve && ring.size() == 2)
      result.status = CellStatus::gone;
    else if (ring.size() < 3 || !is_unfolded(ring))
      result.status = CellStatus::fold;
    return result;
  }

  [[nodiscard]] const Vec2f& uv(std::uint32_t wedge) const { return mesh_.uv(wedge); }

  const ProgressiveMesh& mesh_;
  const progressive::ProgressiveData& data_;
  const progressive::VertexSplit& split_;
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

std::vector<ChartRing> rings_of_split(const ProgressiveMesh& mesh, std::size_t split) {
  ETALON_CHECK(split < mesh.split_count() && mesh.level() == split + 1,
               fmt::format("cells of split {} of {}: the mesh is at level {}", split, mesh.split_count(), mesh.level()));
  ETALON_CHECK(mesh.data().has_uv, "cells of a mesh without texture coordinates");
  if (mesh.data().splits[split].move != kNone) return {{CellStatus::no_place, {}, false}};
  return SplitRing(mesh, split).rings();
}

ChartCells make_chart_cells(const ChartRing& ring) {
  if (ring.status != CellStatus::made) return {ring.status, {}};
  return as_in_chart(make_ring_cells(ring.ring), ring.reflected);
}

ChartCells chart_cells_at(const ChartRing& ring, const Vec2f& place, double u_share, double crossing_share) {
  if (ring.status != CellStatus::made) return {CellStatus::no_place, {}};
  return as_in_chart(ring_cells_at(ring.ring, mirrored(place, ring.reflected), u_share, crossing_share), ring.reflected);
}

std::vector<ChartCells> cells_of_split(const ProgressiveMesh& mesh, std::size_t split) {
  std::vector<ChartCells> result;
  for (const ChartRing& ring : rings_of_split(mesh, split)) result.push_back(make_chart_cells(ring));
  return result;
}

}  // namespace etalon::adapt
