#include "core/procedural/head_atlas.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/mesh/uv_overlap.h"
#include "core/procedural/head_shape.h"

namespace etalon::procedural {

namespace {

// The atlas, in units of 1/1024 of its side: the skin above, a strip of four discs below.
constexpr double kUnit = 1.0 / 1024;
constexpr double kMargin = 5;
constexpr double kSkinBottom = 225;
struct Disc {
  double x, y, radius;
};
constexpr Disc kDiscs[] = {{98, 110, 90}, {298, 110, 90}, {620, 110, 104}, {900, 110, 104}};
enum Chart : std::uint32_t { kBill, kBase, kLeftEye, kRightEye, kSkin };  // the head's own left is +x

/// p seen from 0.8 radii behind the centre of the +x (side = 1) or −x (side = −1) eye, on a plane across its axis, 1 = the rim of the
/// eye's disc.
/// z > 0 where p belongs to the eye's surroundings.
Vec3d seen_from_eye(const Vec3d& p, double side) {
  const HeadEye& eye = head_eye();
  const Vec3d axis(eye.axis.x * side, eye.axis.y, eye.axis.z);
  const Vec3d right = normalized(cross(Vec3d(0, 1, 0), axis)), up = cross(axis, right);
  const Vec3d d = p - Vec3d(eye.center.x * side, eye.center.y, eye.center.z);
  const double depth = dot(d, axis) / eye.radius + 0.8;
  if (depth < 0.2 || length(d) > 1.6 * eye.radius) return {0, 0, -1};
  const double scale = 0.95 / (depth * eye.radius);
  return {dot(d, right) * scale, dot(d, up) * scale, depth};
}

class Unwrapping {
 public:
  explicit Unwrapping(const TubeMesh& tube) : tube_(tube), rings_(static_cast<std::uint32_t>(tube.half_counts.size())) {
    bill_rings_ = std::max<std::uint32_t>(2, rings_ / 14);
    base_rings_ = std::max<std::uint32_t>(2, rings_ / 9);
    for (const auto& face : tube.faces) charts_.push_back(chart_of(face));
  }

  Mesh mesh() {
    // Ball and lids hide parts of each other even from behind the eye: those go back to the skin.
    constexpr int kGrid = 2048;
    for (;;) {
      Mesh candidate = laid_out();
      bool clean = true;
      for (const FaceId f : measure_uv_overlap(candidate, kGrid, candidate.face_count()).first_faces)
        if (charts_[f.index] == kLeftEye || charts_[f.index] == kRightEye) {
          charts_[f.index] = kSkin;
          clean = false;
        }
      if (clean) return candidate;
    }
  }

 private:
  using Face = std::array<TubeMesh::Corner, 3>;

  [[nodiscard]] Chart chart_of(const Face& face) const {
    const auto [front, back] = std::minmax({face[0].ring, face[1].ring, face[2].ring});
    if (back <= bill_rings_) return kBill;
    if (front >= rings_ - 1 - base_rings_) return kBase;
    if (in_eye(face, 1)) return kLeftEye;
    if (in_eye(face, -1)) return kRightEye;
    return kSkin;
  }

  [[nodiscard]] bool in_eye(const Face& face, double side) const {
    Vec3d e[3];
    for (std::size_t k = 0; k < 3; ++k) {
      e[k] = seen_from_eye(tube_.positions[tube_.vertex(face[k])], side);
      if (e[k].z < 0 || e[k].x * e[k].x + e[k].y * e[k].y > 1) return false;
    }
    // Neither hidden nor seen edge-on.
    const Vec3d a = e[1] - e[0], b = e[2] - e[0];
    return a.x * b.y - a.y * b.x > 0.04 * (a.x * a.x + a.y * a.y + b.x * b.x + b.y * b.y);
  }

  [[nodiscard]] Mesh laid_out() const {
    Mesh mesh;
    mesh.has_uv = true;
    for (const Vec3d& p : tube_.positions) mesh.positions.push_back(Vec3f(p));
    std::map<std::array<std::uint32_t, 3>, WedgeId> wedges;  // by vertex, chart and place
    for (std::size_t f = 0; f < tube_.faces.size(); ++f) {
      std::array<WedgeId, 3> face;
      for (std::size_t k = 0; k < 3; ++k) {
        TubeMesh::Corner c = tube_.faces[f][k];
        const std::uint32_t vertex = tube_.vertex(c), count = 2 * tube_.half_counts[c.ring];
        if (count == 0)
          c.place = 0;
        else if (charts_[f] != kSkin)
          c.place %= count;  // only the skin is cut open
        const auto [at, is_new] = wedges.try_emplace({vertex, charts_[f], c.place}, WedgeId(mesh.wedges.size()));
        if (is_new) mesh.wedges.push_back({VertexId(vertex), Vec2f(uv(c, charts_[f]) * kUnit)});
        face[k] = at->second;
      }
      mesh.faces.push_back(face);
    }
    return mesh;
  }

  [[nodiscard]] Vec2d uv(TubeMesh::Corner c, Chart chart) const {
    const double around = tube_.half_counts[c.ring] == 0 ? 0.5 : c.place * 0.5 / tube_.half_counts[c.ring];
    if (chart == kSkin) {
      const double rows = rings_ - 1.0 - bill_rings_ - base_rings_;
      const double row = rings_ - 1.0 - base_rings_ - c.ring;
      return {kMargin + (1024 - 2 * kMargin) * around, kSkinBottom + (1024 - kMargin - kSkinBottom) * row / rows};
    }
    Vec2d p;
    if (chart == kLeftEye || chart == kRightEye) {
      const Vec3d e = seen_from_eye(tube_.positions[tube_.vertex(c)], chart == kLeftEye ? 1 : -1);
      p = {e.x, e.y};
    } else {
      // Seen from outside, +x runs counter-clockwise around the bill from below, clockwise around the base.
      const double r = chart == kBill ? static_cast<double>(c.ring) / bill_rings_ : static_cast<double>(rings_ - 1 - c.ring) / base_rings_;
      p = {(chart == kBill ? r : -r) * sin_turns(around), -r * cos_turns(around)};
    }
    const Disc& disc = kDiscs[chart];
    return {disc.x + disc.radius * p.x, disc.y + disc.radius * p.y};
  }

  const TubeMesh& tube_;
  std::uint32_t rings_, bill_rings_ = 0, base_rings_ = 0;
  std::vector<Chart> charts_;  // #F
};

}  // namespace

Mesh unwrapped_head(const TubeMesh& tube) { return Unwrapping(tube).mesh(); }

}  // namespace etalon::procedural
