#include "core/procedural/knot.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/procedural/noise.h"
#include "core/procedural/smooth_math.h"

namespace etalon::procedural {

namespace {

constexpr double kTubeRadius = 0.45;
constexpr double kNoiseHeight = 0.06;
constexpr double kRibHeight = 0.015;
constexpr int kOctaves = 6;
constexpr std::uint64_t kFormSeed = 11, kMarbleSeed = 29;

/// A point of the knot with the frame of its cross section. The torus that carries the knot gives the normal: it is perpendicular to every
/// curve on the torus, so the frame closes without a twist to spread.
struct KnotPose {
  Vec3d center;
  Vec3d normal;
  Vec3d binormal;
};

KnotPose knot_pose(double t) {
  const double c2 = cos_turns(2 * t), s2 = sin_turns(2 * t), c3 = cos_turns(3 * t), s3 = sin_turns(3 * t);
  const double r = 2 + c3;
  KnotPose pose;
  pose.center = {r * c2, r * s2, s3};
  pose.normal = {c3 * c2, c3 * s2, s3};
  const Vec3d tangent(-3 * s3 * c2 - 2 * r * s2, -3 * s3 * s2 + 2 * r * c2, 3 * c3);  // d/dt without its factor 2π
  pose.binormal = cross(normalized(tangent), pose.normal);
  return pose;
}

Vec4f knot_color(const Vec3d& p, double t, double w) {
  const double marble = 0.5 + 0.5 * sin_turns(0.9 * p.x + 0.7 * p.y + 0.8 * fractal_noise(p * 1.7, 4, kMarbleSeed));
  const bool odd = (static_cast<int>(t * 60) + static_cast<int>(w * 12)) % 2 != 0;
  const Vec3d veins = mix(Vec3d(0.16, 0.22, 0.34), Vec3d(0.93, 0.88, 0.78), marble);
  const Vec3d color = mix(veins, odd ? Vec3d(0.78, 0.31, 0.16) : Vec3d(0.20, 0.52, 0.42), 0.35);
  return {static_cast<float>(color.x), static_cast<float>(color.y), static_cast<float>(color.z), 1};
}

}  // namespace

KnotOptions knot_of_faces(int faces) {
  if (faces < 250 || faces > 10'000'000) throw InputError(fmt::format("knot: faces: expected 250 to 10000000, got {}", faces));
  KnotOptions options;
  options.around = static_cast<int>(std::floor(std::sqrt(faces / 10.0) + 0.5));
  options.rings = static_cast<int>(std::floor(faces / (2.0 * options.around) + 0.5));
  return options;
}

Mesh make_knot(const KnotOptions& options) {
  if (options.rings < 12 || options.rings > 20'000)
    throw InputError(fmt::format("knot: rings: expected 12 to 20000, got {}", options.rings));
  if (options.around < 3 || options.around > 4'000)
    throw InputError(fmt::format("knot: vertices around: expected 3 to 4000, got {}", options.around));
  const auto rings = static_cast<std::uint32_t>(options.rings), around = static_cast<std::uint32_t>(options.around);
  const std::size_t count = std::size_t{rings} * around;

  Mesh mesh;
  mesh.positions.resize(count);
  mesh.colors.resize(count);
  mesh.wedges.resize(count);
  mesh.faces.resize(2 * count);
  parallel_for(rings, [&](std::size_t i) {
    const double t = static_cast<double>(i) / rings;
    const KnotPose pose = knot_pose(t);
    for (std::uint32_t j = 0; j < around; ++j) {
      const double w = static_cast<double>(j) / around;
      const Vec3d outward = pose.normal * cos_turns(w) + pose.binormal * sin_turns(w);
      const Vec3d undisplaced = pose.center + outward * kTubeRadius;
      const double height =
          kNoiseHeight * fractal_noise(undisplaced * 2.5, kOctaves, kFormSeed) + kRibHeight * sin_turns(18 * t) * sin_turns(5 * w);
      const Vec3d p = undisplaced + outward * height;
      const std::size_t v = i * around + j;
      mesh.positions[v] = Vec3f(p);
      mesh.colors[v] = knot_color(p, t, w);
      mesh.wedges[v] = {VertexId(v), {0, 0}};

      const std::size_t next_ring = (i + 1) % rings * around, next = (j + 1) % around;
      const WedgeId a(v), b(i * around + next), c(next_ring + next), d(next_ring + j);
      mesh.faces[2 * v] = {a, b, c};
      mesh.faces[2 * v + 1] = {a, c, d};
    }
  });
  return mesh;
}

}  // namespace etalon::procedural
