#include "core/procedural/iso_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/parallel.h"

namespace etalon::procedural {

namespace {

using Faces = std::vector<std::array<std::uint32_t, 3>>;

/// One undirected edge with the two faces at it.
struct Edge {
  std::uint32_t a, b;  // a < b
  std::uint32_t face[2];
};

std::vector<Edge> edges_of(const Faces& faces) {
  struct Side {
    std::uint64_t ends;
    std::uint32_t face;
  };
  std::vector<Side> sides(faces.size() * 3);
  parallel_for_blocks(faces.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = faces[f][k], b = faces[f][(k + 1) % 3];
        sides[3 * f + k] = {(std::uint64_t{std::min(a, b)} << 32) | std::max(a, b), static_cast<std::uint32_t>(f)};
      }
  });
  std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) { return x.ends != y.ends ? x.ends < y.ends : x.face < y.face; });
  std::vector<Edge> edges;
  edges.reserve(sides.size() / 2);
  for (std::size_t i = 0; i + 1 < sides.size(); i += 2)  // closed and manifold: each edge twice
    edges.push_back(
        {static_cast<std::uint32_t>(sides[i].ends >> 32), static_cast<std::uint32_t>(sides[i].ends), {sides[i].face, sides[i + 1].face}});
  return edges;
}

/// Halves the `count` longest edges of which no two share a face; fewer where there are not so many.
std::size_t split_longest(IsoTriangles& mesh, std::size_t count) {
  const std::vector<Edge> edges = edges_of(mesh.faces);
  std::vector<std::pair<double, std::uint32_t>> order(edges.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const Vec3d d = mesh.positions[edges[e].b] - mesh.positions[edges[e].a];
    order[e] = {-dot(d, d), static_cast<std::uint32_t>(e)};
  }
  std::sort(order.begin(), order.end());
  std::vector<bool> touched(mesh.faces.size(), false);
  std::size_t done = 0;
  for (const auto& [key, e] : order) {
    if (done == count) break;
    const Edge& edge = edges[e];
    if (touched[edge.face[0]] || touched[edge.face[1]]) continue;
    const auto middle = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back((mesh.positions[edge.a] + mesh.positions[edge.b]) * 0.5);
    for (const std::uint32_t f : edge.face) {
      touched[f] = true;
      std::array<std::uint32_t, 3> half = mesh.faces[f];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t p = half[k], q = half[(k + 1) % 3];
        if ((p != edge.a || q != edge.b) && (p != edge.b || q != edge.a)) continue;
        mesh.faces[f][(k + 1) % 3] = middle;
        half[k] = middle;
        break;
      }
      mesh.faces.push_back(half);
    }
    ++done;
  }
  return done;
}

/// Neighbours of each vertex, as ranges of one array.
struct Neighbors {
  std::vector<std::uint32_t> starts, all;
};

Neighbors neighbors_of(const IsoTriangles& mesh) {
  // On a closed manifold each neighbour follows the vertex in exactly one face.
  Neighbors n;
  n.starts.assign(mesh.positions.size() + 1, 0);
  for (const auto& face : mesh.faces)
    for (const std::uint32_t v : face) ++n.starts[v + 1];
  for (std::size_t v = 1; v < n.starts.size(); ++v) n.starts[v] += n.starts[v - 1];
  n.all.resize(n.starts.back());
  std::vector<std::uint32_t> fill(n.starts.begin(), n.starts.end() - 1);
  for (const auto& face : mesh.faces)
    for (std::size_t k = 0; k < 3; ++k) n.all[fill[face[k]]++] = face[(k + 1) % 3];
  return n;
}

void relax(IsoTriangles& mesh, const IsoMeshOptions& o, int steps_before) {
  const Neighbors near = neighbors_of(mesh);
  const double h = 0.25 * o.lattice.spacing;
  std::vector<Vec3d> moved(mesh.positions.size());
  for (int step = 0; step < o.relaxation_steps; ++step) {
    if (o.progress) o.progress(steps_before + step, steps_before + o.relaxation_steps);
    const bool last = step + 1 == o.relaxation_steps;
    parallel_for_blocks(mesh.positions.size(), 512, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        const Vec3d p = mesh.positions[v];
        Vec3d mean(0, 0, 0);
        for (std::uint32_t i = near.starts[v]; i < near.starts[v + 1]; ++i) mean += mesh.positions[near.all[i]];
        const Vec3d way = mean * (1.0 / (near.starts[v + 1] - near.starts[v])) - p;
        const Vec3d normal = field_normal(o.lattice.field, p, h);
        Vec3d q = p + (way - normal * dot(way, normal)) * 0.7;
        // Back to the surface along the old normal; on the way no farther than a spacing, where a crease makes that no Newton step.
        for (int i = 0; i < (last ? 2 : 1); ++i) {
          const double d = o.lattice.field(q), limit = 0.5 * o.lattice.spacing;
          q -= normal * std::fmin(limit, std::fmax(-limit, d));
        }
        moved[v] = q;
      }
    });
    mesh.positions.swap(moved);
  }
}

}  // namespace

IsoTriangles make_iso_mesh(const IsoMeshOptions& options) {
  if (options.faces < 1000 || options.faces % 2 != 0 || options.faces > 20'000'000)
    throw InputError(fmt::format("implicit mesh: faces: expected an even number, 1000 to 20000000, got {}", options.faces));
  const std::size_t wanted = options.faces / 2 + 2;
  constexpr int kMarches = 4;
  const int total = kMarches + options.relaxation_steps;
  const auto tell = [&](int done) {
    if (options.progress) options.progress(done, total);
  };
  IsoMeshOptions o = options;
  tell(0);
  // A coarse march tells the area, whatever the field's scale; then from below by the inverse square law.
  o.lattice.spacing = length(o.lattice.hi - o.lattice.lo) / 120;
  double aim = static_cast<double>(wanted) * 0.996;
  IsoTriangles mesh;
  for (int i = 0; i < 12; ++i) {
    tell(std::min(i + 1, kMarches));
    mesh = march_lattice(o.lattice);
    const auto count = static_cast<double>(mesh.positions.size());
    // A lattice may see a hole in what is thinner than its spacing, and the next one not.
    const bool sphere = mesh.faces.size() + 4 == 2 * mesh.positions.size();
    if (sphere && mesh.positions.size() <= wanted && count >= 0.96 * static_cast<double>(wanted)) break;
    if (i >= 2) aim *= 0.997;
    o.lattice.spacing *= std::sqrt(count / aim);
  }
  if (mesh.positions.size() > wanted) throw InputError(fmt::format("implicit mesh: no lattice gives fewer than {} vertices", wanted));
  while (mesh.positions.size() < wanted && split_longest(mesh, wanted - mesh.positions.size()) > 0) {
  }
  relax(mesh, o, kMarches);
  if (mesh.faces.size() != options.faces)
    throw InputError(
        fmt::format("implicit mesh: the surface is not of genus 0 at this size: {} faces of {} vertices", mesh.faces.size(), wanted));
  tell(total);
  return mesh;
}

}  // namespace etalon::procedural
