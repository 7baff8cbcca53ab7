#include "core/procedural/head.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/procedural/atlas_bake.h"
#include "core/procedural/head_paint.h"
#include "core/procedural/head_shape.h"

namespace etalon::procedural {

namespace {

// The atlas, in units of 1/1024 of its side: the skin above, a strip of four discs below.
constexpr double kUnit = 1.0 / 1024;
constexpr double kMargin = 5;
constexpr double kDiscRadius = 82;
constexpr double kDiscY = 88;
constexpr double kSkinBottom = 180;
constexpr double kDiscX[] = {90, 270, 600, 920};
enum Chart : int { kBill = 0, kBase = 1, kLeftEye = 2, kRightEye = 3, kSkin = 4 };  // left = +x, the head's own left

constexpr double kEyeReach = 1.28;  ///< the eye charts' radius in eyeball radii

/// Place of p in the plane before the +x (side = 1) or −x (side = −1) eye, in eyeball radii; z is the height over the eye's centre.
Vec3d before_eye(const Vec3d& p, double side) {
  const HeadEye& eye = head_eye();
  const Vec3d center(eye.center.x * side, eye.center.y, eye.center.z), axis(eye.axis.x * side, eye.axis.y, eye.axis.z);
  const Vec3d right = normalized(cross(Vec3d(0, 1, 0), axis)), up = cross(axis, right);
  const Vec3d d = p - center;
  return Vec3d(dot(d, right), dot(d, up), dot(d, axis)) * (1 / eye.radius);
}

class HeadAtlas {
 public:
  HeadAtlas(const TubeMesh& tube) : tube_(tube) {
    rings_ = static_cast<std::uint32_t>(tube.half_counts.size());
    bill_rings_ = std::max<std::uint32_t>(2, rings_ / 14);
    base_rings_ = std::max<std::uint32_t>(2, rings_ / 9);
  }

  [[nodiscard]] Mesh unwrapped() {
    mesh_.has_uv = true;
    mesh_.positions.reserve(tube_.positions.size());
    for (const Vec3d& p : tube_.positions) mesh_.positions.push_back(Vec3f(p));
    for (const auto& face : tube_.faces) {
      const Chart chart = chart_of(face);
      std::array<WedgeId, 3> ids;
      for (int k = 0; k < 3; ++k) ids[static_cast<std::size_t>(k)] = wedge(face[static_cast<std::size_t>(k)], chart);
      mesh_.faces.push_back(ids);
    }
    return std::move(mesh_);
  }

 private:
  [[nodiscard]] Chart chart_of(const std::array<TubeMesh::Corner, 3>& face) const {
    std::uint32_t front = rings_, back = 0;
    for (const auto& c : face) front = std::min(front, c.ring), back = std::max(back, c.ring);
    if (back <= bill_rings_) return kBill;
    if (front >= rings_ - 1 - base_rings_) return kBase;
    for (const double side : {1.0, -1.0}) {
      bool inside = true;
      for (const auto& c : face) {
        const Vec3d e = before_eye(tube_.positions[tube_.vertex(c)], side);
        inside = inside && e.z > 0 && e.x * e.x + e.y * e.y < kEyeReach * kEyeReach;
      }
      if (inside) return side > 0 ? kLeftEye : kRightEye;
    }
    return kSkin;
  }

  [[nodiscard]] Vec2d uv(TubeMesh::Corner c, Chart chart) const {
    const double around = tube_.half_counts[c.ring] == 0 ? 0.5 : c.place * 0.5 / tube_.half_counts[c.ring];
    if (chart == kSkin) {
      const double rows = rings_ - 1.0 - bill_rings_ - base_rings_;
      const double row = rings_ - 1.0 - base_rings_ - c.ring;
      return {kMargin + (1024 - 2 * kMargin) * around, kSkinBottom + (1024 - kMargin - kSkinBottom) * row / rows};
    }
    double x = 0, y = 0;
    if (chart == kLeftEye || chart == kRightEye) {
      const Vec3d e = before_eye(tube_.positions[tube_.vertex(c)], chart == kLeftEye ? 1 : -1) * (1 / kEyeReach);
      x = e.x;
      y = e.y;
    } else {
      // Seen from outside, +x runs counter-clockwise around the bill from below, clockwise around the base.
      const double r = chart == kBill ? static_cast<double>(c.ring) / bill_rings_ : static_cast<double>(rings_ - 1 - c.ring) / base_rings_;
      x = (chart == kBill ? r : -r) * sin_turns(around);
      y = -r * cos_turns(around);
    }
    return {kDiscX[chart] + kDiscRadius * x, kDiscY + kDiscRadius * y};
  }

  WedgeId wedge(TubeMesh::Corner c, Chart chart) {
    const std::uint32_t vertex = tube_.vertex(c);
    const std::uint32_t count = 2 * tube_.half_counts[c.ring];
    const std::uint32_t place = chart == kSkin || count == 0 ? c.place : c.place % count;  // only the skin is cut open
    const auto key = std::array<std::uint32_t, 3>{vertex, static_cast<std::uint32_t>(chart), count == 0 ? 0 : place};
    const auto [it, is_new] = wedges_.try_emplace(key, WedgeId(mesh_.wedges.size()));
    if (is_new) mesh_.wedges.push_back({VertexId(vertex), Vec2f(uv({c.ring, key[2]}, chart) * kUnit)});
    return it->second;
  }

  const TubeMesh& tube_;
  std::uint32_t rings_, bill_rings_, base_rings_;
  std::map<std::array<std::uint32_t, 3>, WedgeId> wedges_;
  Mesh mesh_;
};

}  // namespace

Model make_head(const HeadOptions& options) {
  if (options.faces < 72 || options.faces > 2'000'000)
    throw InputError(fmt::format("head: faces: expected 72 to 2000000, got {}", options.faces));
  if (options.texture_size < 64 || options.texture_size > 8192)
    throw InputError(fmt::format("head: texture size: expected 64 to 8192, got {}", options.texture_size));

  TubeOptions tube_options;
  tube_options.faces = static_cast<std::uint32_t>(options.faces);
  tube_options.field = head_field;
  tube_options.density = head_density;
  tube_options.spine = head_spine;
  const TubeMesh tube = wrap_tube(tube_options);

  Model model;
  model.name = "head";
  model.mesh = HeadAtlas(tube).unwrapped();
  std::vector<HeadLight> lights(tube.positions.size());
  parallel_for_blocks(lights.size(), 32, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) lights[v] = head_light_at(tube.positions[v]);
  });
  const Mesh& mesh = model.mesh;
  model.texture = bake_atlas(mesh, options.texture_size, 6 * options.texture_size / 1024 + 2, Vec3d(0.13, 0.16, 0.19), [&](const TexelOnFace& texel) {
    Vec3d p(0, 0, 0);
    HeadLight light{0, 0};
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh.vertex(texel.face, k).index;
      p += tube.positions[v] * texel.weight[k];
      light.sky += lights[v].sky * texel.weight[k];
      light.key += lights[v].key * texel.weight[k];
    }
    return head_color(p, light);
  });
  return model;
}

}  // namespace etalon::procedural
