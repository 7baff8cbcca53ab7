#include "core/procedural/duck.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/procedural/colored_mesh.h"
#include "core/procedural/duck_paint.h"
#include "core/procedural/duck_shape.h"

namespace etalon::procedural {

namespace {

constexpr int kFineRings = 1024, kFineAround = 256;  ///< samples from which lengths are measured

/// Where the ray first leaves the body: farther on it may meet another part of it.
Vec3d exit_point(const SpinePose& pose, double turns) {
  const Vec3d around = pose.dorsal * -cos_turns(turns) + Vec3d(sin_turns(turns), 0, 0);
  const Vec3d way = around * pose.cone_cos + pose.forward * pose.cone_sin;
  double inside = 0, outside = 0;
  for (int i = 0; i < 400; ++i) {
    const double d = duck_field(pose.center + way * outside);
    if (d > 0) break;
    inside = outside;
    outside += std::fmax(-0.6 * d, 2e-3);
  }
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (inside + outside);
    (duck_field(pose.center + way * middle) > 0 ? outside : inside) = middle;
  }
  return pose.center + way * (0.5 * (inside + outside));
}

/// Where a non-decreasing piecewise linear function given at 0, 1, …, n is `wanted`, as a share of n.
double inverse_at(const std::vector<double>& values, double wanted) {
  const auto it = std::upper_bound(values.begin(), values.end(), wanted);
  if (it == values.end()) return 1;
  const auto i = static_cast<double>(it - values.begin() - 1);
  const double a = *(it - 1), b = *it;
  return (i + (wanted - a) / (b - a)) / static_cast<double>(values.size() - 1);
}

/// Root mean square of the ways from ring to ring, summed up: rings go where the surface is long.
std::vector<double> lengths_along_spine(const ProcedureProgress& progress) {
  constexpr int kAround = 48;
  std::vector<std::vector<Vec3d>> rings(kFineRings + 1);
  parallel_for(rings.size(), [&](std::size_t i) {
    const SpinePose pose = duck_spine(static_cast<double>(i) / kFineRings);
    for (int j = 0; j < kAround; ++j) rings[i].push_back(exit_point(pose, static_cast<double>(j) / kAround));
  });
  if (progress) progress(1, 3);
  std::vector<double> lengths(rings.size(), 0);
  for (std::size_t i = 1; i < rings.size(); ++i) {
    double squares = 0;
    for (std::size_t j = 0; j < kAround; ++j) {
      const Vec3d d = rings[i][j] - rings[i - 1][j];
      squares += dot(d, d);
    }
    lengths[i] = lengths[i - 1] + std::sqrt(squares / kAround);
  }
  return lengths;
}

/// Ring r is at positions[1 + r·segments], its vertex 0 below; the front pole is first, the back pole last.
std::vector<Vec3d> place_rings(const DuckOptions& o) {
  const std::vector<double> lengths = lengths_along_spine(o.progress);
  const auto rings = static_cast<std::size_t>(o.rings), segments = static_cast<std::size_t>(o.segments);
  std::vector<Vec3d> positions(rings * segments + 2);
  positions.front() = exit_point(duck_spine(0), 0);
  positions.back() = exit_point(duck_spine(1), 0);
  parallel_for(rings, [&](std::size_t r) {
    const double t = inverse_at(lengths, lengths.back() * static_cast<double>(r + 1) / static_cast<double>(rings + 1));
    const SpinePose pose = duck_spine(t);
    std::vector<double> sums{0};
    Vec3d last = exit_point(pose, 0);
    for (int j = 1; j <= kFineAround; ++j) {
      const Vec3d p = exit_point(pose, static_cast<double>(j) / kFineAround);
      sums.push_back(sums.back() + length(p - last));
      last = p;
    }
    for (std::size_t s = 0; s < segments; ++s) {
      const double at = inverse_at(sums, sums.back() * static_cast<double>(s) / static_cast<double>(segments));
      positions[1 + r * segments + s] = exit_point(pose, at);
    }
  });
  if (o.progress) o.progress(2, 3);
  return positions;
}

/// Whether the quad behind ring r and after segment s is in the hole: around vertex 0 below, between breast and tail.
struct Hole {
  int first_ring, rings, first_segment, segments, around;
  [[nodiscard]] bool has(int r, int s) const {
    const int from_first = ((s - first_segment) % around + around) % around;
    return r >= first_ring && r < first_ring + rings && from_first < segments;
  }
};

std::vector<std::array<std::uint32_t, 3>> connect(const DuckOptions& o) {
  const auto vertex = [&](int r, int s) { return static_cast<std::uint32_t>(1 + r * o.segments + s % o.segments); };
  const Hole hole{o.rings * 5 / 8 - o.hole_rings / 2, o.hole_rings, o.segments - o.hole_segments / 2, o.hole_segments, o.segments};
  const auto back_pole = static_cast<std::uint32_t>(o.rings * o.segments + 1);
  std::vector<std::array<std::uint32_t, 3>> faces;
  for (int s = 0; s < o.segments; ++s) faces.push_back({0, vertex(0, s), vertex(0, s + 1)});
  for (int r = 0; r + 1 < o.rings; ++r)
    for (int s = 0; s < o.segments; ++s) {
      if (hole.has(r, s)) continue;
      faces.push_back({vertex(r, s), vertex(r + 1, s), vertex(r + 1, s + 1)});
      // The notch: of the quad in front of the hole's first one, the triangle that has its side behind.
      const bool notch = hole.rings > 0 && r + 1 == hole.first_ring && hole.has(r + 1, s) && !hole.has(r + 1, s - 1);
      if (notch) faces.pop_back();
      faces.push_back({vertex(r, s), vertex(r + 1, s + 1), vertex(r, s + 1)});
    }
  for (int s = 0; s < o.segments; ++s) faces.push_back({back_pole, vertex(o.rings - 1, s + 1), vertex(o.rings - 1, s)});
  return faces;
}

/// Drops positions of no face and renumbers.
void compact(std::vector<Vec3d>& positions, std::vector<std::array<std::uint32_t, 3>>& faces) {
  std::vector<std::uint32_t> number(positions.size(), 0);
  for (const auto& face : faces)
    for (const std::uint32_t v : face) number[v] = 1;
  std::uint32_t count = 0;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (number[v] == 0) continue;
    positions[count] = positions[v];
    number[v] = count++;
  }
  positions.resize(count);
  for (auto& face : faces)
    for (std::uint32_t& v : face) v = number[v];
}

void require(const DuckOptions& o) {
  if (o.rings < 24 || o.rings > 8000) throw InputError(fmt::format("duck: rings: expected 24 to 8000, got {}", o.rings));
  if (o.segments < 24 || o.segments > 8000) throw InputError(fmt::format("duck: segments: expected 24 to 8000, got {}", o.segments));
  const bool closed = o.hole_rings == 0 && o.hole_segments == 0;
  if (!closed && (o.hole_rings < 2 || o.hole_rings > o.rings / 4 || o.hole_segments < 2 || o.hole_segments > o.segments / 4))
    throw InputError(fmt::format("duck: hole: expected 2 to {} rings and 2 to {} segments, got {} and {}", o.rings / 4, o.segments / 4,
                                 o.hole_rings, o.hole_segments));
}

}  // namespace

// Open: V = R·S + 2 − (p − 1)(q − 1), F = 2·R·S − 2·p·q − 1, so p + q = 52 and R·S = 49,999 + p·q: 289 × 175 with p·q = 36 × 16.
DuckOptions duck_of_paper(bool open) {
  if (open) return {.rings = 289, .segments = 175, .hole_rings = 36, .hole_segments = 16, .progress = {}};
  return {.rings = 259, .segments = 321, .hole_rings = 0, .hole_segments = 0, .progress = {}};
}

DuckOptions duck_of_faces(int faces, bool open) {
  if (faces < 2'000 || faces > 10'000'000) throw InputError(fmt::format("duck: faces: expected 2000 to 10000000, got {}", faces));
  const DuckOptions paper = duck_of_paper(open);
  DuckOptions o;
  const double quads = faces / 2.0 * (open ? 50'575.0 / 49'998.5 : 1);
  o.segments = static_cast<int>(std::floor(std::sqrt(quads * paper.segments / paper.rings) + 0.5));
  o.rings = static_cast<int>(std::floor(quads / o.segments + 0.5));
  if (open) {
    o.hole_rings = std::max(2, o.rings / 8);
    o.hole_segments = std::max(2, o.segments / 11);
  }
  return o;
}

Mesh make_duck(const DuckOptions& options) {
  require(options);
  if (options.progress) options.progress(0, 3);
  std::vector<Vec3d> positions = place_rings(options);
  std::vector<std::array<std::uint32_t, 3>> faces = connect(options);
  compact(positions, faces);
  Mesh mesh = colored_mesh(positions, faces, duck_color);
  if (options.progress) options.progress(3, 3);
  return mesh;
}

}  // namespace etalon::procedural
