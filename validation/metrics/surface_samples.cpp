#include "validation/metrics/surface_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/math/nearest_point.h"

namespace etalon::validation {

namespace {

/// Elements (vertices, edges, faces) in a block.
constexpr std::size_t kBlockElements = 512;

std::size_t blocks_of(std::size_t elements) { return (elements + kBlockElements - 1) / kBlockElements; }

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

std::size_t SurfaceSamples::block_count() const {
  return blocks_of(vertices_.size()) + blocks_of(edge_ends_.size()) + blocks_of(face_ends_.size());
}

void SurfaceSamples::append_block(std::size_t block, std::vector<SurfaceSample>& samples) const {
  const auto run = [&](std::size_t elements, const auto& append) {
    const std::size_t first = block * kBlockElements;
    for (std::size_t i = first; i < std::min(elements, first + kBlockElements); ++i) append(i);
  };
  if (block < blocks_of(vertices_.size())) {
    run(vertices_.size(), [&](std::size_t i) { append_vertex(vertices_[i], samples); });
    return;
  }
  block -= blocks_of(vertices_.size());
  if (block < blocks_of(edge_ends_.size())) {
    run(edge_ends_.size(), [&](std::size_t i) { append_edge(i, samples); });
    return;
  }
  block -= blocks_of(edge_ends_.size());
  run(face_ends_.size(), [&](std::size_t i) { append_face(i, samples); });
}

SurfaceSample SurfaceSamples::blend(const std::array<std::uint32_t, 3>& v, const Vec3d& w) const {
  const auto mix = [&](const auto& at, int k) {
    return w.x * static_cast<double>(at[v[0]][k]) + w.y * static_cast<double>(at[v[1]][k]) + w.z * static_cast<double>(at[v[2]][k]);
  };
  SurfaceSample sample;
  for (int k = 0; k < 3; ++k) {
    sample.point[k] = mix(mesh_.positions, k);
    if (!mesh_.colors.empty()) sample.color[k] = mix(mesh_.colors, k);
  }
  return sample;
}

void SurfaceSamples::append_vertex(std::uint32_t vertex, std::vector<SurfaceSample>& samples) const {
  samples.push_back(blend({vertex, vertex, vertex}, {1, 0, 0}));
}

void SurfaceSamples::append_edge(std::size_t edge, std::vector<SurfaceSample>& samples) const {
  const std::uint64_t count = edge_ends_[edge] - (edge > 0 ? edge_ends_[edge - 1] : 0);
  for (std::uint64_t i = 0; i < count; ++i) {
    const double t = static_cast<double>(i + 1) / static_cast<double>(count + 1);
    samples.push_back(blend({edges_[edge].low, edges_[edge].high, edges_[edge].high}, {1 - t, t, 0}));
  }
}

// The sequence R2 [Roberts 2018]: multiples of 1/p and 1/p², p = 1.3247… the real root of p³ = p + 1, modulo 1, in 64-bit integers; the square
// is folded along its diagonal onto the triangle.
void SurfaceSamples::append_face(std::size_t face, std::vector<SurfaceSample>& samples) const {
  constexpr std::uint64_t kStepU = 0xC13FA9A902A6328Full, kStepV = 0x91E10DA5C79E7B1Dull;
  const std::array<std::uint32_t, 3> vertices{mesh_.vertex(FaceId(face), 0).index, mesh_.vertex(FaceId(face), 1).index,
                                              mesh_.vertex(FaceId(face), 2).index};
  for (std::uint64_t i = face > 0 ? face_ends_[face - 1] : 0; i < face_ends_[face]; ++i) {
    // 53 bits, centred in their cell, so that no weight is 0.
    double u = (static_cast<double>((i * kStepU) >> 11) + 0.5) * 0x1p-53, v = (static_cast<double>((i * kStepV) >> 11) + 0.5) * 0x1p-53;
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    samples.push_back(blend(vertices, {1 - u - v, u, v}));
  }
}

}  // namespace etalon::validation
