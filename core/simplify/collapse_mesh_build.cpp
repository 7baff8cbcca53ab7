// From indexed triangles to half-edges: who is across, where the surface is no manifold, which edges are on curves.
#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <tuple>

#include "core/base/error.h"
#include "core/simplify/collapse_mesh.h"

namespace etalon::simplify {

namespace {

constexpr std::size_t kPlacesNamed = 5;
/// Charts under one texel of a map of this side are untextured: nothing of them could be seen in it.
constexpr int kTextureSide = 1024;

void note(Defect& defect, std::uint32_t place) {
  ++defect.count;
  if (defect.first.size() < kPlacesNamed) defect.first.push_back(place);
}

}  // namespace

class CollapseMeshBuilder {
 public:
  CollapseMeshBuilder(CollapseMesh& to, const Mesh& mesh) : to_(to), mesh_(mesh) {}

  void build(const std::vector<VertexId>& locked) {
    read_faces();
    group_half_edges();
    drop_duplicates();
    join();
    find_fans();
    mark_curves();
    find_color_seams();
    classify(locked);
    texture_signs();
  }

 private:
  using Face = CollapseMesh::Face;
  struct Outgoing {
    std::uint32_t end, half_edge;
    friend auto operator<=>(const Outgoing&, const Outgoing&) = default;
  };

  [[nodiscard]] std::span<Outgoing> outgoing(std::uint32_t v) { return {entries_.data() + starts_[v], starts_[v + 1] - starts_[v]}; }
  [[nodiscard]] bool alive(std::uint32_t h) const { return to_.faces_[h >> 2].flags & CollapseMesh::kAlive; }

  void read_faces() {
    to_.faces_.resize(mesh_.face_count());
    to_.face_count_ = static_cast<std::uint32_t>(mesh_.face_count());
    if (mesh_.has_uv) to_.wedges_.resize(4 * mesh_.face_count(), kNone);
    starts_.assign(mesh_.vertex_count() + 1, 0);
    for (std::uint32_t f = 0; f < mesh_.face_count(); ++f) {
      Face& face = to_.faces_[f];
      face.flags = CollapseMesh::kAlive;
      face.opposite = {kNone, kNone, kNone};
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t w = mesh_.faces[f][k].index;
        ETALON_CHECK(w < mesh_.wedge_count(), fmt::format("face {}, wedge {} of {}", f, w, mesh_.wedge_count()));
        face.vertex[k] = mesh_.wedges[w].vertex.index;
        ETALON_CHECK(face.vertex[k] < mesh_.vertex_count(),
                     fmt::format("wedge {}, vertex {} of {}", w, face.vertex[k], mesh_.vertex_count()));
        if (mesh_.has_uv) to_.wedges_[4 * f + k] = w;
      }
      if (face.vertex[0] == face.vertex[1] || face.vertex[1] == face.vertex[2] || face.vertex[2] == face.vertex[0]) {
        note(to_.repair_.repeated_corners, f);
        drop(f);
        continue;
      }
      for (const std::uint32_t v : face.vertex) ++starts_[v + 1];
    }
  }

  void drop(std::uint32_t f) {
    to_.faces_[f].flags = 0;
    --to_.face_count_;
  }

  // Outgoing half-edges of each vertex, by (end, half-edge).
  void group_half_edges() {
    for (std::size_t v = 1; v < starts_.size(); ++v) starts_[v] += starts_[v - 1];
    entries_.resize(starts_.back());
    std::vector<std::uint32_t> fill(starts_.begin(), starts_.end() - 1);
    for (std::uint32_t f = 0; f < to_.faces_.size(); ++f) {
      if (!alive(4 * f)) continue;
      const auto& v = to_.faces_[f].vertex;
      for (std::uint32_t k = 0; k < 3; ++k) entries_[fill[v[k]]++] = {v[(k + 1) % 3], 4 * f + k};
    }
    for (std::uint32_t v = 0; v + 1 < starts_.size(); ++v) {
      const std::span<Outgoing> out = outgoing(v);
      std::sort(out.begin(), out.end());
    }
  }

  // Two faces that run along a→b with the same third vertex are one face twice; the later one goes.
  void drop_duplicates() {
    std::vector<std::uint32_t> repeated;
    for (std::uint32_t v = 0; v + 1 < starts_.size(); ++v) {
      const std::span<Outgoing> out = outgoing(v);
      for (std::size_t i = 1; i < out.size(); ++i)
        for (std::size_t j = i; j-- > 0 && out[j].end == out[i].end;) {
          const std::uint32_t third_i = to_.start(CollapseMesh::previous(out[i].half_edge));
          const std::uint32_t third_j = to_.start(CollapseMesh::previous(out[j].half_edge));
          if (third_i == third_j) {
            repeated.push_back(out[i].half_edge >> 2);
            break;
          }
        }
    }
    std::sort(repeated.begin(), repeated.end());
    repeated.erase(std::unique(repeated.begin(), repeated.end()), repeated.end());
    for (const std::uint32_t f : repeated) {
      note(to_.repair_.duplicate_faces, f);
      drop(f);
    }
    if (repeated.empty()) return;
    // The lists without them.
    std::size_t kept = 0;
    for (std::uint32_t v = 0; v + 1 < starts_.size(); ++v) {
      const std::uint32_t from = starts_[v], to = starts_[v + 1];
      starts_[v] = static_cast<std::uint32_t>(kept);
      for (std::uint32_t i = from; i < to; ++i)
        if (alive(entries_[i].half_edge)) entries_[kept++] = entries_[i];
    }
    starts_.back() = static_cast<std::uint32_t>(kept);
    entries_.resize(kept);
  }

  void join() {
    must_stay_.assign(mesh_.vertex_count(), false);
    std::vector<std::uint32_t> many, turned;
    const auto first_to = [&](std::uint32_t from, std::uint32_t to) {
      const std::span<Outgoing> out = outgoing(from);
      return std::lower_bound(out.begin(), out.end(), Outgoing{to, 0}) - out.begin();
    };
    for (std::uint32_t a = 0; a + 1 < starts_.size(); ++a) {
      const std::span<Outgoing> out = outgoing(a);
      for (std::size_t i = 0; i < out.size();) {
        const std::uint32_t b = out[i].end;
        std::size_t here = 1;
        while (i + here < out.size() && out[i + here].end == b) ++here;
        const std::span<Outgoing> back = outgoing(b);
        std::size_t j = static_cast<std::size_t>(first_to(b, a)), there = 0;
        while (j + there < back.size() && back[j + there].end == a) ++there;
        if (here == 1 && there == 1) {
          to_.faces_[out[i].half_edge >> 2].opposite[out[i].half_edge & 3] = back[j].half_edge;
        } else if (here + there > 1 && (a < b || there == 0)) {
          const std::uint32_t lowest =
              std::min(out[i].half_edge >> 2, there > 0 ? back[j].half_edge >> 2 : out[i].half_edge >> 2);  // lists ascend
          (here + there == 2 ? turned : many).push_back(lowest);
          must_stay_[a] = must_stay_[b] = true;
        }
        i += here;
      }
    }
    std::sort(many.begin(), many.end());
    std::sort(turned.begin(), turned.end());
    for (const std::uint32_t f : many) note(to_.repair_.non_manifold_edges, f);
    for (const std::uint32_t f : turned) note(to_.repair_.inconsistent_edges, f);
  }

  // From h counter-clockwise to the end of its fan, or once around.
  template <class Visit>
  void walk_fan(std::uint32_t h, const Visit& visit) const {
    const std::uint32_t first = h;
    do {
      const std::uint32_t following = to_.rotate(h);
      visit(h);
      h = following;
    } while (h != kNone && h != first);
  }

  void find_fans() {
    to_.out_.assign(mesh_.vertex_count(), kNone);
    std::vector<std::uint32_t> open;
    for (std::uint32_t v = 0; v < mesh_.vertex_count(); ++v) {
      const std::span<Outgoing> out = outgoing(v);
      if (out.empty()) {
        note(to_.repair_.unreferenced_vertices, v);
        continue;
      }
      std::uint32_t first = out[0].half_edge;
      for (std::size_t i = out.size(); i-- > 0;)
        if (to_.opposite(out[i].half_edge) == kNone) first = out[i].half_edge;
      to_.out_[v] = first;
      std::size_t reached = 0;
      walk_fan(first, [&](std::uint32_t) { ++reached; });
      if (reached < out.size()) split_fans(v, first);
    }
    to_.out_.insert(to_.out_.end(), extra_first_.begin(), extra_first_.end());
    must_stay_.resize(to_.out_.size(), true);
  }

  // Every fan but the first becomes a vertex of its own at the same place.
  void split_fans(std::uint32_t v, std::uint32_t first) {
    note(to_.repair_.non_manifold_vertices, v);
    must_stay_[v] = true;
    std::vector<std::uint32_t> rest;
    for (const Outgoing& out : outgoing(v)) rest.push_back(out.half_edge);
    const auto take = [&](std::uint32_t from) {
      walk_fan(from, [&](std::uint32_t h) { rest.erase(std::find(rest.begin(), rest.end(), h)); });
    };
    take(first);
    while (!rest.empty()) {
      std::uint32_t start = rest.front();
      for (std::size_t i = rest.size(); i-- > 0;)
        if (to_.opposite(rest[i]) == kNone) start = rest[i];
      take(start);
      const auto id = static_cast<std::uint32_t>(mesh_.vertex_count() + extra_first_.size());
      extra_first_.push_back(start);
      to_.extra_origin_.push_back(v);
      walk_fan(start, [&](std::uint32_t h) { to_.faces_[h >> 2].vertex[h & 3] = id; });
    }
  }

  void mark_curves() {
    const auto uv = [&](std::uint32_t h) { return mesh_.wedges[to_.wedges_[h]].uv; };
    const auto material = [&](std::uint32_t h) { return mesh_.face_materials.empty() ? 0u : mesh_.face_materials[h >> 2]; };
    for (std::uint32_t f = 0; f < to_.faces_.size(); ++f) {
      if (!alive(4 * f)) continue;
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t h = 4 * f + k, o = to_.opposite(h);
        const bool curve = o == kNone || material(h) != material(o) ||
                           (mesh_.has_uv && (uv(h) != uv(CollapseMesh::next(o)) || uv(CollapseMesh::next(h)) != uv(o)));
        if (curve) to_.faces_[f].flags |= 1u << k;
      }
    }
  }

  // Vertices have one colour each, so where colours part the surface is in two pieces that touch: they must not move apart.
  void find_color_seams() {
    if (mesh_.colors.empty()) return;
    std::vector<std::uint32_t> open;
    for (std::uint32_t v = 0; v < mesh_.vertex_count(); ++v)
      if (to_.vertex_alive(v) && to_.on_boundary(v)) open.push_back(v);
    const auto key = [&](std::uint32_t v) { return std::tuple(mesh_.positions[v].x, mesh_.positions[v].y, mesh_.positions[v].z); };
    std::sort(open.begin(), open.end(), [&](std::uint32_t a, std::uint32_t b) { return std::tuple(key(a), a) < std::tuple(key(b), b); });
    std::vector<std::uint32_t> found;
    for (std::size_t i = 0, end = 0; i < open.size(); i = end) {
      bool parts = false;
      for (end = i; end < open.size() && key(open[end]) == key(open[i]); ++end)
        parts = parts || mesh_.colors[open[end]] != mesh_.colors[open[i]];
      if (parts) found.insert(found.end(), open.begin() + static_cast<std::ptrdiff_t>(i), open.begin() + static_cast<std::ptrdiff_t>(end));
    }
    std::sort(found.begin(), found.end());
    for (const std::uint32_t v : found) {
      note(to_.repair_.color_seam_vertices, v);
      must_stay_[v] = true;
    }
  }

  void classify(const std::vector<VertexId>& locked) {
    to_.kinds_.assign(to_.out_.size(), VertexKind::locked);
    for (std::uint32_t v = 0; v < to_.out_.size(); ++v) {
      if (must_stay_[v] || !to_.vertex_alive(v)) continue;
      int curves = 0;
      to_.for_each_neighbor(v, [&](std::uint32_t, std::uint32_t h) { curves += to_.on_curve(h) ? 1 : 0; });
      if (curves == 0) to_.kinds_[v] = VertexKind::interior;
      if (curves == 2) to_.kinds_[v] = VertexKind::curve;
    }
    for (const VertexId v : locked) {
      ETALON_CHECK(v.index < mesh_.vertex_count(), fmt::format("locked vertex {} of {}", v.index, mesh_.vertex_count()));
      to_.kinds_[v.index] = VertexKind::locked;
    }
  }

  void texture_signs() {
    Charts charts;
    if (mesh_.has_uv) charts = find_charts(mesh_);
    for (std::uint32_t f = 0; f < to_.faces_.size(); ++f) {
      int sign = 0;
      if (mesh_.has_uv) {
        const Chart& chart = charts.charts[charts.of_face[f]];
        if (chart.area_texels(kTextureSide, kTextureSide) >= 1) sign = chart.sign;
      }
      if (alive(4 * f)) to_.faces_[f].flags |= static_cast<std::uint32_t>(sign + 1) << CollapseMesh::kUvShift;
    }
  }

  CollapseMesh& to_;
  const Mesh& mesh_;
  std::vector<std::uint32_t> starts_;  // #V + 1
  std::vector<Outgoing> entries_;
  std::vector<bool> must_stay_;
  std::vector<std::uint32_t> extra_first_;
};

CollapseMesh::CollapseMesh(const Mesh& mesh, const std::vector<VertexId>& locked) : source_(&mesh) {
  CollapseMeshBuilder(*this, mesh).build(locked);
}

}  // namespace etalon::simplify
