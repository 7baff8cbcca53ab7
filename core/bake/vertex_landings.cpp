#include "core/bake/vertex_landings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/parallel.h"
#include "core/mesh/adjacency.h"

namespace etalon::bake {
namespace {

using simplify::kNone;

constexpr std::size_t kGrain = 4096;  // vertices

class Walk {
 public:
  explicit Walk(const Mesh& mesh) : adjacency_(mesh) {
    corners_.reserve(mesh.face_count());
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
      Corners corners;
      for (int c = 0; c < 3; ++c) {
        corners.vertex[static_cast<std::size_t>(c)] = mesh.vertex(FaceId(f), c).index;
        corners.place[static_cast<std::size_t>(c)] = to_double(mesh.position(FaceId(f), c));
      }
      corners.slabs = slabs_of(corners.place);
      corners_.push_back(corners);
    }
    for (const Vec3f& p : mesh.positions)
      for (int k = 0; k < 3; ++k) reach_ = std::max(reach_, std::abs(static_cast<double>(p[k])));
  }

  /// `met`: scratch, the vertices around which was looked before.
  [[nodiscard]] Landing from(std::uint32_t start, const Vec3d& p, std::vector<std::uint32_t>& met) const {
    Best best;
    met.clear();
    look_around(start, p, met, std::numeric_limits<double>::infinity(), best);
    while (best.face != kNone) {
      const Best before = best;
      for (const std::uint32_t v : corners_[before.face].vertex)
        if (!has(met, v)) look_around(v, p, met, before.at.distance2, best);
      if (best.face == before.face) break;
    }
    return {.face = best.face == kNone ? FaceId() : FaceId(best.face), .weights = best.at.weights};
  }

 private:
  struct Best {
    NearestOnTriangle at{.distance2 = std::numeric_limits<double>::infinity()};
    std::uint32_t face = kNone;
  };

  // Everything of the triangle lies at or below `top` along `axis`: what lies higher is at least that far away.
  struct Slab {
    Vec3d axis{0, 0, 0};  // of length 1, or 0
    double top = 0;
  };
  // Beyond each of the sides, above and below.
  using Slabs = std::array<Slab, 5>;

  struct Corners {
    std::array<std::uint32_t, 3> vertex{};
    std::array<Vec3d, 3> place;
    Slabs slabs;
  };

  // The tops are those of the corners, so a slab holds whatever the rounding made of its axis.
  static Slabs slabs_of(const std::array<Vec3d, 3>& place) {
    const auto from = [](const Vec3d& a, const Vec3d& b) { return Vec3d{b.x - a.x, b.y - a.y, b.z - a.z}; };
    const auto cross = [](const Vec3d& a, const Vec3d& b) {
      return Vec3d{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    };
    const auto slab = [&](const Vec3d& direction) {
      const double length = std::sqrt(dot_product(direction, direction));
      if (!(length > 0x1p-500)) return Slab{};  // its square may have lost digits
      Slab result{.axis = {direction.x / length, direction.y / length, direction.z / length}};
      result.top = std::max({dot_product(result.axis, place[0]), dot_product(result.axis, place[1]), dot_product(result.axis, place[2])});
      return result;
    };
    const Vec3d normal = cross(from(place[0], place[1]), from(place[0], place[2]));
    return {slab(cross(from(place[0], place[1]), normal)), slab(cross(from(place[1], place[2]), normal)),
            slab(cross(from(place[2], place[0]), normal)), slab(normal), slab({-normal.x, -normal.y, -normal.z})};
  }

  // Whether nearest_on_triangle() is sure to find more than `distance2`. An axis has length 1 up to 2^-51, a dot product and a top, and the
  // point found with all its weights, are off by less than 2^-48 of the largest coordinate: taken off a thousand times over, which also
  // covers the rounding of the squares, since nothing here is higher than 4 of these coordinates.
  [[nodiscard]] bool is_farther(const Corners& corners, const Vec3d& p, double distance2) const {
    double highest = 0;
    for (const Slab& slab : corners.slabs) highest = std::max(highest, dot_product(slab.axis, p) - slab.top);
    const double sure = highest - 0x1p-38 * std::max({reach_, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    return sure > 0 && sure * sure > distance2;
  }

  static bool has(const std::vector<std::uint32_t>& met, std::uint32_t v) { return std::find(met.begin(), met.end(), v) != met.end(); }

  // Triangles around v nearer than `limit`: at a place where several vertices lie, another's triangles are as near, and not its own.
  void look_around(std::uint32_t v, const Vec3d& p, std::vector<std::uint32_t>& met, double limit, Best& best) const {
    for (const FaceId f : adjacency_.faces_around(v)) {
      const Corners& corners = corners_[f.index];
      if (has(met, corners.vertex[0]) || has(met, corners.vertex[1]) || has(met, corners.vertex[2])) continue;
      if (is_farther(corners, p, best.at.distance2)) continue;
      const NearestOnTriangle found = nearest_on_triangle(p, corners.place[0], corners.place[1], corners.place[2]);
      if (!(found.distance2 < limit) || found.distance2 > best.at.distance2 ||
          (found.distance2 == best.at.distance2 && f.index >= best.face))
        continue;
      best = {found, f.index};
    }
    met.push_back(v);
  }

  const Adjacency adjacency_;
  std::vector<Corners> corners_;  // #F
  double reach_ = 0;              // the largest coordinate
};

}  // namespace

std::vector<std::uint32_t> CollapseTrail::survivors(const simplify::SimplifyResult& result) const {
  std::vector<std::uint32_t> survivor(into_.size(), kNone);
  std::vector<bool> known(into_.size(), false);
  for (std::uint32_t v = 0; v < result.source_vertex.size(); ++v) {
    survivor[result.source_vertex[v].index] = v;
    known[result.source_vertex[v].index] = true;
  }
  // A vertex of the input that was several of the engine's went into the one that its last one went into: so it was still there then, and
  // the way ends.
  std::vector<std::uint32_t> way;
  for (std::uint32_t v = 0; v < into_.size(); ++v) {
    std::uint32_t at = v;
    for (way.clear(); !known[at] && into_[at] != kNone; at = into_[at]) way.push_back(at);
    for (const std::uint32_t w : way) {
      survivor[w] = survivor[at];
      known[w] = true;
    }
  }
  return survivor;
}

std::vector<Landing> land_vertices(const Mesh& scan, const simplify::SimplifyResult& result, const CollapseTrail& trail) {
  const std::vector<std::uint32_t> survivors = trail.survivors(result);
  const Walk walk(result.mesh);
  std::vector<Landing> landings(scan.vertex_count());
  parallel_for_blocks(landings.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> met;
    for (std::size_t v = begin; v < end; ++v)
      if (survivors[v] != kNone) landings[v] = walk.from(survivors[v], to_double(scan.positions[v]), met);
  });
  return landings;
}

double largest_distance(const Mesh& scan, const Mesh& mesh, const std::vector<Landing>& landings) {
  double distance2 = 0;
  for (std::size_t v = 0; v < landings.size(); ++v)
    if (landings[v].face.valid())
      distance2 = std::max(distance2, squared_distance(to_double(scan.positions[v]), landing_point(mesh, landings[v])));
  return std::sqrt(distance2);
}

}  // namespace etalon::bake
