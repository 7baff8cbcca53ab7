// Collapses recorded as they happen, then turned around: the last collapse is the first split.
#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/progressive/progressive_mesh.h"

namespace etalon::progressive {

namespace {

using simplify::CollapseEvent;
using simplify::CollapseMesh;

/// A collapse in the original's ids.
struct Recorded {
  std::uint32_t u = kNone, v = kNone;
  std::array<std::uint32_t, 2> faces{kNone, kNone};
  std::array<std::array<std::uint32_t, 3>, 2> face_wedges{};
  std::array<std::uint32_t, 2> wedge_u{kNone, kNone}, wedge_v{kNone, kNone};
  std::size_t first_corner = 0, right_corner = 0, end_corner = 0;
  std::size_t first_gone = 0, end_gone = 0;  // wedges that no face uses any more
};

class Recorder {
 public:
  explicit Recorder(const Mesh& mesh) : mesh_(mesh), uses_(mesh.wedge_count(), 0), only_wedge_(mesh.vertex_count(), kNone) {
    for (std::uint32_t w = static_cast<std::uint32_t>(mesh.wedge_count()); w-- > 0;)
      if (mesh.wedges[w].vertex.index < mesh.vertex_count()) only_wedge_[mesh.wedges[w].vertex.index] = w;
  }

  void record(const CollapseMesh& triangles, const CollapseEvent& event) {
    if (!counted_) count_uses(triangles);
    Recorded r;
    r.u = event.u;
    r.v = triangles.origin(event.v);
    const auto [left, right] = event.edge;
    if (left != kNone) keep_face(triangles, left >> 2, r, 0);
    if (right != kNone) keep_face(triangles, right >> 2, r, 1);
    if (left != kNone) {
      r.wedge_u[0] = wedge(triangles, left);
      r.wedge_v[0] = wedge(triangles, CollapseMesh::next(left));
    }
    if (right != kNone) {
      r.wedge_u[1] = wedge(triangles, CollapseMesh::next(right));
      r.wedge_v[1] = wedge(triangles, right);
    }
    r.first_corner = corners_.size();
    std::vector<std::uint32_t> behind;  // on the right side of u's curve
    std::size_t side = left != kNone ? 0 : 1;
    const std::uint32_t first = left != kNone ? left : triangles.first_out(event.u);
    std::uint32_t h = first;
    do {
      const std::uint32_t back = CollapseMesh::previous(h);
      if (h != left && back != right) {
        if (wedge(triangles, h) != r.wedge_u[side])
          throw InputError(fmt::format("vertex {}: expected one wedge on each side of its curve, got two of equal uv: weld first", r.u));
        (side == 0 ? corners_ : behind).push_back(h);
      }
      if (triangles.on_curve(back)) side = 1;
      h = triangles.opposite(back);
    } while (h != kNone && h != first);
    r.right_corner = corners_.size();
    corners_.insert(corners_.end(), behind.begin(), behind.end());
    r.end_corner = corners_.size();
    r.first_gone = gone_.size();
    move_uses(r);
    r.end_gone = gone_.size();
    records_.push_back(r);
  }

  /// `base`: what is left after the last collapse.
  [[nodiscard]] ProgressiveData data(const simplify::SimplifyResult& base) const;

 private:
  [[nodiscard]] std::uint32_t wedge(const CollapseMesh& triangles, std::uint32_t h) const {
    return mesh_.has_uv ? triangles.wedge(h) : only_wedge_[triangles.origin(triangles.start(h))];
  }

  void count_uses(const CollapseMesh& triangles) {
    counted_ = true;
    for (std::uint32_t f = 0; f < triangles.face_capacity(); ++f)
      for (std::uint32_t k = 0; k < 3 && triangles.face_alive(f); ++k) ++uses_[wedge(triangles, 4 * f + k)];
  }

  void keep_face(const CollapseMesh& triangles, std::uint32_t f, Recorded& r, std::size_t side) const {
    r.faces[side] = f;
    for (std::uint32_t k = 0; k < 3; ++k) r.face_wedges[side][k] = wedge(triangles, 4 * f + k);
  }

  void move_uses(const Recorded& r) {
    std::vector<std::uint32_t> lost;
    for (std::size_t side = 0; side < 2; ++side) {
      if (r.faces[side] != kNone)
        for (const std::uint32_t w : r.face_wedges[side]) lost.push_back(w);
      const std::size_t count = side == 0 ? r.right_corner - r.first_corner : r.end_corner - r.right_corner;
      for (std::size_t i = 0; i < count; ++i) {
        lost.push_back(r.wedge_u[side]);
        ++uses_[r.wedge_v[side]];
      }
    }
    for (const std::uint32_t w : lost) --uses_[w];
    std::sort(lost.begin(), lost.end());
    lost.erase(std::unique(lost.begin(), lost.end()), lost.end());
    for (const std::uint32_t w : lost)
      if (uses_[w] == 0) gone_.push_back(w);
  }

  const Mesh& mesh_;
  std::vector<std::uint32_t> uses_, only_wedge_;
  bool counted_ = false;
  std::vector<Recorded> records_;
  std::vector<std::uint32_t> corners_, gone_;
};

/// Gives ids by appearance and copies what belongs to them.
class Writer {
 public:
  Writer(const Mesh& mesh, ProgressiveData& data)
      : mesh_(mesh), data_(data), vertex_(mesh.vertex_count(), kNone), wedge_(mesh.wedge_count(), kNone), face_(mesh.face_count(), kNone) {}

  void add_vertex(std::uint32_t v) {
    vertex_[v] = static_cast<std::uint32_t>(data_.positions.size());
    data_.positions.push_back(mesh_.positions[v]);
    if (data_.has_colors) data_.colors.push_back(mesh_.colors[v]);
    data_.vertex_ids.push_back(v);
  }
  void add_wedge(std::uint32_t w) {
    wedge_[w] = static_cast<std::uint32_t>(data_.wedges.size());
    data_.wedges.push_back({VertexId(vertex_[mesh_.wedges[w].vertex.index]), mesh_.wedges[w].uv});
    data_.wedge_ids.push_back(w);
  }
  void add_face(std::uint32_t f, const std::array<std::uint32_t, 3>& wedges) {
    face_[f] = static_cast<std::uint32_t>(data_.faces.size());
    data_.faces.push_back({wedge_[wedges[0]], wedge_[wedges[1]], wedge_[wedges[2]]});
    if (data_.has_materials) data_.materials.push_back(mesh_.face_materials[f]);
    data_.face_ids.push_back(f);
  }
  [[nodiscard]] std::uint32_t vertex(std::uint32_t v) const { return vertex_[v]; }
  [[nodiscard]] std::uint32_t wedge(std::uint32_t w) const { return w == kNone ? kNone : wedge_[w]; }
  [[nodiscard]] std::uint32_t corner(std::uint32_t h) const { return 4 * face_[h >> 2] + (h & 3); }

 private:
  const Mesh& mesh_;
  ProgressiveData& data_;
  std::vector<std::uint32_t> vertex_, wedge_, face_;
};

ProgressiveData Recorder::data(const simplify::SimplifyResult& base) const {
  ProgressiveData data;
  data.has_uv = mesh_.has_uv;
  data.has_colors = !mesh_.colors.empty();
  data.has_materials = !mesh_.face_materials.empty();
  Writer writer(mesh_, data);
  for (const VertexId v : base.source_vertex) writer.add_vertex(v.index);
  for (const WedgeId w : base.source_wedge) writer.add_wedge(w.index);
  for (std::size_t f = 0; f < base.mesh.face_count(); ++f) {
    std::array<std::uint32_t, 3> wedges{};
    for (std::size_t k = 0; k < 3; ++k) wedges[k] = base.source_wedge[base.mesh.faces[f][k].index].index;
    writer.add_face(base.source_face[f].index, wedges);
  }
  data.base_vertices = static_cast<std::uint32_t>(data.positions.size());
  data.base_wedges = static_cast<std::uint32_t>(data.wedges.size());
  data.base_faces = static_cast<std::uint32_t>(data.faces.size());

  for (std::size_t i = records_.size(); i-- > 0;) {
    const Recorded& r = records_[i];
    VertexSplit split;
    split.parent = writer.vertex(r.v);
    split.first_wedge = static_cast<std::uint32_t>(data.wedges.size());
    split.first_face = static_cast<std::uint32_t>(data.faces.size());
    writer.add_vertex(r.u);
    for (std::size_t g = r.first_gone; g < r.end_gone; ++g) writer.add_wedge(gone_[g]);
    split.first_corner = static_cast<std::uint32_t>(data.corners.size());
    for (std::size_t c = r.first_corner; c < r.end_corner; ++c) {
      if (c == r.right_corner) split.right_corner = static_cast<std::uint32_t>(data.corners.size());
      data.corners.push_back(writer.corner(corners_[c]));
    }
    split.end_corner = static_cast<std::uint32_t>(data.corners.size());
    if (r.right_corner == r.end_corner) split.right_corner = split.end_corner;
    const std::array<bool, 2> has_corners{split.right_corner > split.first_corner, split.end_corner > split.right_corner};
    for (std::size_t side = 0; side < 2; ++side) {
      if (r.faces[side] != kNone) writer.add_face(r.faces[side], r.face_wedges[side]);
      if (!has_corners[side]) continue;
      split.wedge[side] = writer.wedge(r.wedge_u[side]);
      split.wedge_of_parent[side] = writer.wedge(r.wedge_v[side]);
    }
    data.splits.push_back(split);
  }
  return data;
}

}  // namespace

ProgressiveResult make_progressive(const Mesh& mesh, const simplify::SimplifyOptions& options) {
  if (options.collapse != simplify::CollapseKind::half)
    throw InputError("progressive mesh: expected half-edge collapses, got full-edge: a split does not move its parent back");
  Recorder recorder(mesh);
  simplify::SimplifyOptions observed = options;
  observed.before_collapse = [&](const CollapseMesh& triangles, const CollapseEvent& event) {
    recorder.record(triangles, event);
    if (options.before_collapse) options.before_collapse(triangles, event);
  };
  ProgressiveResult result;
  result.simplified = simplify_mesh(mesh, observed);
  result.data = recorder.data(result.simplified);
  return result;
}

}  // namespace etalon::progressive
