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
  Vec3f position{0, 0, 0};                   // of u, as it goes
  Vec4f color{0, 0, 0, 1};
  std::uint32_t move = kNone;
};

/// A wedge that goes, as it goes.
struct Gone {
  std::uint32_t wedge = kNone;
  Vec2f uv{0, 0};
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
    move_uses(triangles, r);
    r.end_gone = gone_.size();
    r.position = triangles.position(event.u);
    if (!mesh_.colors.empty()) r.color = triangles.color(event.u);
    if (event.moves) keep_parent(triangles, event.v, r);
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

  // v as it is before it moves. A wedge of its that goes is kept with those that do.
  void keep_parent(const CollapseMesh& triangles, std::uint32_t v, Recorded& r) {
    r.move = static_cast<std::uint32_t>(moves_.size());
    ParentMove& move = moves_.emplace_back();
    move.position = triangles.position(v);
    if (!mesh_.colors.empty()) move.color = triangles.color(v);
    for (std::size_t side = 0; side < 2 && mesh_.has_uv; ++side) {
      const std::uint32_t w = r.wedge_v[side];
      if (w == kNone || uses_[w] == 0 || (side == 1 && w == r.wedge_v[0])) continue;
      move.wedge[side] = w, move.uv[side] = triangles.uv_of_wedge(w);
    }
  }

  void move_uses(const CollapseMesh& triangles, const Recorded& r) {
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
      if (uses_[w] == 0) gone_.push_back({w, mesh_.has_uv ? triangles.uv_of_wedge(w) : mesh_.wedges[w].uv});
  }

  const Mesh& mesh_;
  std::vector<std::uint32_t> uses_, only_wedge_;
  bool counted_ = false;
  std::vector<Recorded> records_;
  std::vector<std::uint32_t> corners_;
  std::vector<Gone> gone_;
  std::vector<ParentMove> moves_;  // in the original's ids, by collapse
};

/// Gives ids by appearance and copies what belongs to them.
class Writer {
 public:
  Writer(const Mesh& mesh, ProgressiveData& data)
      : mesh_(mesh), data_(data), vertex_(mesh.vertex_count(), kNone), wedge_(mesh.wedge_count(), kNone), face_(mesh.face_count(), kNone) {}

  void add_vertex(std::uint32_t v, const Vec3f& position, const Vec4f& color) {
    vertex_[v] = static_cast<std::uint32_t>(data_.positions.size());
    data_.positions.push_back(position);
    if (data_.has_colors) data_.colors.push_back(color);
    data_.vertex_ids.push_back(v);
  }
  void add_wedge(std::uint32_t w, const Vec2f& uv) {
    wedge_[w] = static_cast<std::uint32_t>(data_.wedges.size());
    data_.wedges.push_back({VertexId(vertex_[mesh_.wedges[w].vertex.index]), uv});
    data_.wedge_ids.push_back(w);
  }
  void add_face(std::uint32_t f, const std::array<std::uint32_t, 3>& wedges) {
    face_[f] = static_cast<std::uint32_t>(data_.faces.size());
    data_.faces.push_back({wedge_[wedges[0]], wedge_[wedges[1]], wedge_[wedges[2]]});
    if (data_.has_materials) data_.materials.push_back(mesh_.face_materials[f]);
    data_.face_ids.push_back(f);
  }
  void add_move(ParentMove move) {
    for (std::uint32_t& w : move.wedge) w = wedge(w);
    data_.moves.push_back(move);
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
  for (std::size_t v = 0; v < base.mesh.vertex_count(); ++v)
    writer.add_vertex(base.source_vertex[v].index, base.mesh.positions[v], data.has_colors ? base.mesh.colors[v] : Vec4f{0, 0, 0, 1});
  for (std::size_t w = 0; w < base.mesh.wedge_count(); ++w) writer.add_wedge(base.source_wedge[w].index, base.mesh.wedges[w].uv);
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
    if (r.move != kNone) {
      split.move = static_cast<std::uint32_t>(data.moves.size());
      writer.add_move(moves_[r.move]);
    }
    writer.add_vertex(r.u, r.position, r.color);
    for (std::size_t g = r.first_gone; g < r.end_gone; ++g) writer.add_wedge(gone_[g].wedge, gone_[g].uv);
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
