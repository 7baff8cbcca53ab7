#include "core/procedural/tube_mesh.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"

namespace etalon::procedural {

namespace {

constexpr int kFineRings = 288;  ///< samples along the spine and over half a ring from which lengths are measured
constexpr int kFineHalf = 112;

Vec3d on_ray(const TubeOptions& o, const SpinePose& pose, double half_turns) {
  const double c = cos_turns(half_turns * 0.5), s = sin_turns(half_turns * 0.5);
  const Vec3d around = pose.dorsal * -c + Vec3d(half_turns == 0 || half_turns == 1 ? 0 : s, 0, 0);
  const Vec3d direction = around * pose.cone_cos + pose.forward * pose.cone_sin;
  return pose.center + direction * outermost_hit(o.field, pose.center, direction, o.reach);
}

double weighted_distance(const TubeOptions& o, const Vec3d& a, const Vec3d& b) { return length(b - a) * o.density((a + b) * 0.5); }

using HalfRing = std::vector<Vec3d>;  // kFineHalf + 1 points, ventral to dorsal

std::vector<double> lengths_along(const TubeOptions& o, const HalfRing& ring) {
  std::vector<double> sums(ring.size(), 0);
  for (std::size_t i = 1; i < ring.size(); ++i) sums[i] = sums[i - 1] + weighted_distance(o, ring[i - 1], ring[i]);
  return sums;
}

/// Where a piecewise linear, non-decreasing function given at 0, 1, …, n takes the value `wanted`, as a fraction of n.
double inverse_at(const std::vector<double>& values, double wanted) {
  const auto it = std::upper_bound(values.begin(), values.end(), wanted);
  if (it == values.end()) return 1;
  if (it == values.begin()) return 0;
  const auto i = static_cast<double>(it - values.begin() - 1);
  const double a = *(it - 1), b = *it;
  return (i + (wanted - a) / (b - a)) / static_cast<double>(values.size() - 1);
}

struct Layout {
  std::vector<double> ring_t;
  std::vector<double> half_lengths;  ///< per ring, in weighted units
};

/// Rings every `spacing`, poles left out.
Layout layout_at(const std::vector<double>& spine_lengths, const std::vector<double>& half_lengths, double spacing) {
  Layout result;
  const double total = spine_lengths.back();
  const auto steps = static_cast<int>(std::fmax(6, std::floor(total / (spacing * 0.8660254037844386) + 0.5)));
  for (int k = 1; k < steps; ++k) {
    const double t = inverse_at(spine_lengths, total * k / steps);
    result.ring_t.push_back(t);
    const double x = t * kFineRings;
    const auto i = std::min(static_cast<std::size_t>(x), static_cast<std::size_t>(kFineRings - 1));
    result.half_lengths.push_back(mix(half_lengths[i], half_lengths[i + 1], x - static_cast<double>(i)));
  }
  return result;
}

std::uint32_t half_count_of(double half_length, double spacing) {
  return static_cast<std::uint32_t>(std::fmax(3, std::floor(half_length / spacing + 0.5)));
}

std::uint32_t vertex_count_at(const Layout& layout, double spacing) {
  std::uint32_t sum = 2;
  for (const double l : layout.half_lengths) sum += 2 * half_count_of(l, spacing);
  return sum;
}

/// Connects half ring `a` (front) to half ring `b` (behind it) from the ventral to the dorsal line, and mirrors the strip.
void zip_rings(TubeMesh& mesh, std::uint32_t a, std::uint32_t b) {
  const std::uint32_t ma = mesh.half_counts[a], mb = mesh.half_counts[b];
  std::uint32_t i = 0, j = 0;
  std::vector<std::array<TubeMesh::Corner, 3>> mirrored;
  const auto emit = [&](TubeMesh::Corner p, TubeMesh::Corner q, TubeMesh::Corner r) {
    mesh.faces.push_back({p, q, r});
    const auto mirror = [&](TubeMesh::Corner c) { return TubeMesh::Corner{c.ring, 2 * mesh.half_counts[c.ring] - c.place}; };
    mirrored.push_back({mirror(p), mirror(r), mirror(q)});
  };
  while (i < ma || j < mb) {
    // Whichever next vertex comes first along the ring, compared at mid-edge in integers.
    const bool advance_a = j == mb || (i < ma && (2 * i + 1) * mb <= (2 * j + 1) * ma);
    if (advance_a) {
      emit({a, i}, {b, j}, {a, i + 1});
      ++i;
    } else {
      emit({a, i}, {b, j}, {b, j + 1});
      ++j;
    }
  }
  mesh.faces.insert(mesh.faces.end(), mirrored.rbegin(), mirrored.rend());
}

void zip_all(TubeMesh& mesh) {
  const auto last = static_cast<std::uint32_t>(mesh.half_counts.size() - 1);
  for (std::uint32_t j = 0; j < 2 * mesh.half_counts[1]; ++j) mesh.faces.push_back({TubeMesh::Corner{0, j}, {1, j}, {1, j + 1}});
  for (std::uint32_t r = 1; r + 1 < last; ++r) zip_rings(mesh, r, r + 1);
  for (std::uint32_t j = 0; j < 2 * mesh.half_counts[last - 1]; ++j)
    mesh.faces.push_back({TubeMesh::Corner{last, j}, {last - 1, j + 1}, {last - 1, j}});
}

/// The −x half becomes the exact mirror image of the +x half, and the two midlines lie in x = 0.
void symmetrize(TubeMesh& mesh) {
  for (std::size_t r = 0; r < mesh.half_counts.size(); ++r) {
    const std::uint32_t start = mesh.ring_starts[r], m = mesh.half_counts[r];
    mesh.positions[start].x = 0;
    if (m == 0) continue;
    mesh.positions[start + m].x = 0;
    for (std::uint32_t j = 1; j < m; ++j) {
      const Vec3d p = mesh.positions[start + j];
      mesh.positions[start + 2 * m - j] = {-p.x, p.y, p.z};
    }
  }
}

/// Each vertex goes half the way to the density-weighted mean of its neighbours, then back to the surface.
void relax(TubeMesh& mesh, const TubeOptions& o) {
  const std::size_t count = mesh.positions.size();
  std::vector<std::vector<std::uint32_t>> neighbours(count);
  for (const auto& face : mesh.faces)
    for (int k = 0; k < 3; ++k) neighbours[mesh.vertex(face[k])].push_back(mesh.vertex(face[(k + 1) % 3]));
  std::vector<Vec3d> next(count);
  for (int step = 0; step < o.relaxation_steps; ++step) {
    parallel_for_blocks(count, 64, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        const Vec3d p = mesh.positions[v];
        Vec3d sum(0, 0, 0);
        double weights = 0;
        for (const std::uint32_t n : neighbours[v]) {
          const double w = o.density((mesh.positions[n] + p) * 0.5) * (0.2 + length(mesh.positions[n] - p));
          sum += (mesh.positions[n] - p) * w;
          weights += w;
        }
        Vec3d move = sum * (0.5 / weights);
        const Vec3d normal = field_normal(o.field, p, 1e-4);
        move -= normal * dot(normal, move);
        next[v] = projected(o.field, p + move, 2);
      }
    });
    mesh.positions.swap(next);
    symmetrize(mesh);
  }
}

}  // namespace

TubeMesh wrap_tube(const TubeOptions& o) {
  std::vector<HalfRing> fine(kFineRings + 1, HalfRing(kFineHalf + 1));
  std::vector<double> half_lengths(kFineRings + 1);
  parallel_for(kFineRings + 1, [&](std::size_t i) {
    const SpinePose pose = o.spine(static_cast<double>(i) / kFineRings);
    for (int j = 0; j <= kFineHalf; ++j) fine[i][static_cast<std::size_t>(j)] = on_ray(o, pose, static_cast<double>(j) / kFineHalf);
    half_lengths[i] = lengths_along(o, fine[i]).back();
  });
  std::vector<double> spine_lengths(kFineRings + 1, 0);
  for (std::size_t i = 1; i < fine.size(); ++i) {
    double squares = 0;  // the root mean square leans toward where rings spread most
    for (std::size_t j = 0; j < fine[i].size(); ++j) {
      const double d = weighted_distance(o, fine[i - 1][j], fine[i][j]);
      squares += d * d;
    }
    spine_lengths[i] = spine_lengths[i - 1] + std::sqrt(squares / (kFineHalf + 1));
  }

  const std::uint32_t wanted = std::max<std::uint32_t>(38, (o.faces + 4) / 2 / 2 * 2);
  double low = 1e-5, high = 10;  // spacing: too many vertices at `low`
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (vertex_count_at(layout_at(spine_lengths, half_lengths, middle), middle) > wanted ? low : high) = middle;
  }
  const Layout layout = layout_at(spine_lengths, half_lengths, high);
  const std::size_t rings = layout.ring_t.size();
  std::vector<std::uint32_t> half(rings);
  std::uint32_t count = 2;
  for (std::size_t r = 0; r < rings; ++r) count += 2 * (half[r] = half_count_of(layout.half_lengths[r], high));
  // What is still missing goes to the rings that lost most by rounding; ties to the front.
  while (count < wanted) {
    std::size_t best = 0;
    double best_need = -1e30;
    for (std::size_t r = 0; r < rings; ++r) {
      const double need = layout.half_lengths[r] / high - half[r];
      if (need > best_need) best_need = need, best = r;
    }
    ++half[best];
    count += 2;
  }

  TubeMesh mesh;
  mesh.half_counts.push_back(0);
  mesh.half_counts.insert(mesh.half_counts.end(), half.begin(), half.end());
  mesh.half_counts.push_back(0);
  for (const std::uint32_t m : mesh.half_counts) {
    mesh.ring_starts.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
    mesh.positions.resize(mesh.positions.size() + std::max<std::uint32_t>(1, 2 * m));
  }
  mesh.positions.front() = on_ray(o, o.spine(0), 0);
  mesh.positions.back() = on_ray(o, o.spine(1), 0);
  parallel_for(rings, [&](std::size_t r) {
    const SpinePose pose = o.spine(layout.ring_t[r]);
    HalfRing ring(kFineHalf + 1);
    for (int j = 0; j <= kFineHalf; ++j) ring[static_cast<std::size_t>(j)] = on_ray(o, pose, static_cast<double>(j) / kFineHalf);
    const std::vector<double> lengths = lengths_along(o, ring);
    const std::uint32_t m = half[r], start = mesh.ring_starts[r + 1];
    for (std::uint32_t j = 0; j <= m; ++j) {
      const double at = j == 0 ? 0 : (j == m ? 1 : inverse_at(lengths, lengths.back() * j / m));
      mesh.positions[start + j] = on_ray(o, pose, at);
    }
  });
  symmetrize(mesh);
  zip_all(mesh);
  relax(mesh, o);
  return mesh;
}

}  // namespace etalon::procedural
