#include "validation/metrics/surface_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/math/nearest_point.h"

namespace etalon::validation {

namespace {

double length_of(const Mesh& mesh, const VertexPair& edge) {
  return std::sqrt(squared_distance(to_double(mesh.positions[edge.low]), to_double(mesh.positions[edge.high])));
}

double area_of(const Mesh& mesh, std::size_t f) {
  const Vec3d a = to_double(mesh.position(FaceId(f), 0)), b = to_double(mesh.position(FaceId(f), 1)),
              c = to_double(mesh.position(FaceId(f), 2));
  const Vec3d n = cross_product({b.x - a.x, b.y - a.y, b.z - a.z}, {c.x - a.x, c.y - a.y, c.z - a.z});
  return 0.5 * std::sqrt(dot_product(n, n));
}

void require_valid(const Mesh& mesh) {
  if (mesh.faces.empty()) throw InputError("surface: expected at least one face, got none");
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    for (const WedgeId w : mesh.faces[f]) {
      if (w.index >= mesh.wedge_count() || mesh.wedges[w.index].vertex.index >= mesh.vertex_count())
        throw InputError(fmt::format("surface: face {} names a vertex that is not there", f));
      const Vec3f& p = mesh.positions[mesh.wedges[w.index].vertex.index];
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        throw InputError(fmt::format("surface: vertex {}: expected a finite position", mesh.wedges[w.index].vertex.index));
    }
}

/// How many samples elements 0..i have together when `total` are shared out by measure: floor of the running share.
template <class Measure>
std::vector<std::uint64_t> running_shares(std::size_t count, double per_unit, const Measure& measure) {
  std::vector<std::uint64_t> ends(count);
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    sum += measure(i);
    ends[i] = static_cast<std::uint64_t>(sum * per_unit);
  }
  return ends;
}

}  // namespace

SurfaceSamples::SurfaceSamples(const Mesh& mesh, std::uint64_t target) : mesh_(mesh) {
  require_valid(mesh);
  std::vector<bool> used(mesh.vertex_count(), false);
  double area = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    area += area_of(mesh, f);
    for (const WedgeId w : mesh.faces[f]) used[mesh.wedges[w.index].vertex.index] = true;
  }
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v)
    if (used[v]) vertices_.push_back(v);
  if (vertices_.size() >= target || !(area > 0)) return;

  const double left = static_cast<double>(target - vertices_.size());
  edges_ = unique_edges(mesh);
  edge_ends_ = running_shares(edges_.size(), std::sqrt(left / area), [&](std::size_t e) { return length_of(mesh, edges_[e]); });
  if (vertices_.size() + edge_count() >= target) return;
  const double for_faces = static_cast<double>(target - vertices_.size() - edge_count());
  face_ends_ = running_shares(mesh.face_count(), for_faces / area, [&](std::size_t f) { return area_of(mesh, f); });
}

SampleBlock SurfaceSamples::block(std::size_t b) const {
  SampleBlock block;
  std::uint64_t at = b * kBlockSamples;
  const std::uint64_t end = std::min(count(), at + kBlockSamples);
  block.points.reserve(end - at);
  if (!mesh_.colors.empty()) block.colors.reserve(end - at);
  for (; at < std::min(end, vertex_count()); ++at) add({vertices_[at], vertices_[at], vertices_[at]}, {1, 0, 0}, block);
  // Samples [at, stop) of those that `ends` shares out, which start at `offset`.
  const auto run = [&](const std::vector<std::uint64_t>& ends, std::uint64_t offset, const auto& add_some) {
    const std::uint64_t stop = ends.empty() ? at : std::min(end, offset + ends.back());
    if (at >= stop) return;
    auto i = static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), at - offset) - ends.begin());
    for (; at < stop; ++i) {
      const std::uint64_t first = i > 0 ? ends[i - 1] : 0, last = std::min(ends[i], stop - offset);
      add_some(i, at - offset - first, last - first);
      at = std::max(at, offset + last);
    }
  };
  run(edge_ends_, vertex_count(), [&](std::size_t e, std::uint64_t first, std::uint64_t last) { add_edge(e, first, last, block); });
  run(face_ends_, vertex_count() + edge_count(),
      [&](std::size_t f, std::uint64_t first, std::uint64_t last) { add_face(f, first, last, block); });
  return block;
}

void SurfaceSamples::add(const std::array<std::uint32_t, 3>& v, const Vec3d& w, SampleBlock& block) const {
  const auto mix = [&](const auto& at, int k) {
    return w.x * static_cast<double>(at[v[0]][k]) + w.y * static_cast<double>(at[v[1]][k]) + w.z * static_cast<double>(at[v[2]][k]);
  };
  block.points.emplace_back(mix(mesh_.positions, 0), mix(mesh_.positions, 1), mix(mesh_.positions, 2));
  if (!mesh_.colors.empty()) block.colors.emplace_back(mix(mesh_.colors, 0), mix(mesh_.colors, 1), mix(mesh_.colors, 2));
}

void SurfaceSamples::add_edge(std::size_t edge, std::uint64_t begin, std::uint64_t end, SampleBlock& block) const {
  const std::uint64_t count = edge_ends_[edge] - (edge > 0 ? edge_ends_[edge - 1] : 0);
  for (std::uint64_t i = begin; i < end; ++i) {
    const double t = static_cast<double>(i + 1) / static_cast<double>(count + 1);
    add({edges_[edge].low, edges_[edge].high, edges_[edge].high}, {1 - t, t, 0}, block);
  }
}

// The sequence R2 [Roberts 2018]: multiples of 1/p and 1/p², p = 1.3247… the real root of p³ = p + 1, modulo 1, in 64-bit integers; the square
// is folded along its diagonal onto the triangle.
void SurfaceSamples::add_face(std::size_t face, std::uint64_t begin, std::uint64_t end, SampleBlock& block) const {
  constexpr std::uint64_t kStepU = 0xC13FA9A902A6328Full, kStepV = 0x91E10DA5C79E7B1Dull;
  const std::array<std::uint32_t, 3> vertices{mesh_.vertex(FaceId(face), 0).index, mesh_.vertex(FaceId(face), 1).index,
                                              mesh_.vertex(FaceId(face), 2).index};
  const std::uint64_t before = face > 0 ? face_ends_[face - 1] : 0;
  for (std::uint64_t i = before + begin; i < before + end; ++i) {
    // 53 bits, centred in their cell, so that no weight is 0.
    double u = (static_cast<double>((i * kStepU) >> 11) + 0.5) * 0x1p-53, v = (static_cast<double>((i * kStepV) >> 11) + 0.5) * 0x1p-53;
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    add(vertices, {1 - u - v, u, v}, block);
  }
}

}  // namespace etalon::validation
