#include "core/mesh/triangle_tree.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/mesh/triangle_tree_impl.h"

namespace etalon {

namespace {

struct Box {
  Vec3f lo{std::numeric_limits<float>::infinity()}, hi{-std::numeric_limits<float>::infinity()};
  void add(const Vec3f& p) {
    for (int k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], p[k]);
      hi[k] = std::max(hi[k], p[k]);
    }
  }
};

/// The corners of all faces; the largest absolute coordinate.
float read_corners(const Mesh& mesh, std::vector<TreeTriangle>& source) {
  float largest = 0;
  source.resize(mesh.face_count());
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    source[f].face = f;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t w = mesh.faces[f][k].index;
      if (w >= mesh.wedge_count() || mesh.wedges[w].vertex.index >= mesh.vertex_count())
        throw InputError(fmt::format("surface: face {} names a vertex that is not there", f));
      const Vec3f& p = mesh.positions[mesh.wedges[w].vertex.index];
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        throw InputError(fmt::format("surface: vertex {}: expected a finite position", mesh.wedges[w].vertex.index));
      source[f].corner[k] = p;
      largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    }
  }
  return largest;
}

/// Halves faces by their centres, again and again.
class Builder {
 public:
  Builder(TriangleTree::Impl& tree, std::vector<TreeTriangle> source) : tree_(tree), source_(std::move(source)), scaled_(source_.size()) {
    centre_.resize(source_.size());
    order_.resize(source_.size());
    for (std::uint32_t f = 0; f < source_.size(); ++f) {
      auto& c = scaled_[f];
      for (std::size_t k = 0; k < 3; ++k) c[k] = Vec3f(tree_.scaled(to_double(source_[f].corner[k])));
      for (int k = 0; k < 3; ++k) centre_[f][k] = std::min({c[0][k], c[1][k], c[2][k]}) + std::max({c[0][k], c[1][k], c[2][k]});
      order_[f] = f;
    }
    tree_.slot.resize(source_.size());
    tree_.leaves.reserve(source_.size() / 3);
    tree_.triangles.reserve(4 * (source_.size() / 3));
    tree_.nodes.reserve(source_.size() / 8);
    tree_.root = build(0, order_.size());
  }

 private:
  std::uint32_t build(std::size_t begin, std::size_t end) {
    if (end - begin <= 4) return leaf(begin, end);
    // The first half holds four times a power of two, so that most leaves are full.
    const auto half = [](std::size_t n) {
      std::size_t full = 4;
      while (2 * full < n) full *= 2;
      return full;
    };
    std::array<std::size_t, 5> cut{begin, begin, begin + half(end - begin), end, end};
    split(begin, cut[2], end);
    cut[1] = cut[2] - begin > 4 ? begin + half(cut[2] - begin) : cut[2];
    cut[3] = end - cut[2] > 4 ? cut[2] + half(end - cut[2]) : end;
    if (cut[1] < cut[2]) split(begin, cut[1], cut[2]);
    if (cut[3] < end) split(cut[2], cut[3], end);

    const auto id = static_cast<std::uint32_t>(tree_.nodes.size());
    tree_.nodes.emplace_back();
    for (std::size_t i = 0; i < 4; ++i) {
      // An absent child has an empty box at infinity: its distance is never the least.
      Box box;
      for (std::size_t k = cut[i]; k < cut[i + 1]; ++k)
        for (const Vec3f& p : scaled_[order_[k]]) box.add(p);
      const std::uint32_t child = cut[i] == cut[i + 1] ? kTreeNoChild : build(cut[i], cut[i + 1]);
      TreeNode& node = tree_.nodes[id];
      for (int k = 0; k < 3; ++k) {
        node.lo[k][i] = box.lo[k];
        node.hi[k][i] = box.hi[k];
      }
      node.child[i] = child;
    }
    return id;
  }

  // At `middle`, along the longest side of the centres' box, ties by face.
  void split(std::size_t begin, std::size_t middle, std::size_t end) {
    Box box;
    for (std::size_t i = begin; i < end; ++i) box.add(centre_[order_[i]]);
    const Vec3f side = box.hi - box.lo;
    const int axis = side.x >= side.y ? (side.x >= side.z ? 0 : 2) : (side.y >= side.z ? 1 : 2);
    const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
      const float ca = centre_[a][axis], cb = centre_[b][axis];
      return ca != cb ? ca < cb : a < b;
    });
  }

  std::uint32_t leaf(std::size_t begin, std::size_t end) {
    const auto id = static_cast<std::uint32_t>(tree_.leaves.size());
    float at[3][3][4];
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t f = order_[std::min(begin + i, end - 1)];
      if (begin + i < end) tree_.slot[f] = static_cast<std::uint32_t>(tree_.triangles.size());
      tree_.triangles.push_back(source_[f]);
      for (std::size_t c = 0; c < 3; ++c)
        for (int k = 0; k < 3; ++k) at[c][k][i] = scaled_[f][c][k];
    }
    Float4 corner[3][3];
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t k = 0; k < 3; ++k) corner[c][k] = Float4{at[c][k][0], at[c][k][1], at[c][k][2], at[c][k][3]};
    tree_.leaves.emplace_back(corner);
    return kTreeLeaf | id;
  }

  TriangleTree::Impl& tree_;
  std::vector<TreeTriangle> source_;
  std::vector<std::array<Vec3f, 3>> scaled_;
  std::vector<Vec3f> centre_;
  std::vector<std::uint32_t> order_;
};

}  // namespace

TriangleTree::Impl::Impl(const Mesh& mesh) {
  if (mesh.faces.empty()) throw InputError("surface: expected at least one face, got none");
  if (mesh.face_count() >= (1u << 28)) throw InputError(fmt::format("surface: expected fewer than 2^28 faces, got {}", mesh.face_count()));
  std::vector<TreeTriangle> source;
  const float largest = read_corners(mesh, source);
  int exponent = 0;
  if (largest > 0) std::frexp(static_cast<double>(largest), &exponent);
  scale = std::ldexp(1.0, -exponent);
  const Builder builder(*this, std::move(source));
}

void TriangleTree::Impl::search(const Vec3d& p, SurfacePoint& best) const {
  const ScaledPoint at(scaled(p));
  float limit = limit_of(best.distance2);
  struct Waiting {
    std::uint32_t child;
    float distance2;
  };
  std::array<Waiting, 96> stack;  // at most 3 a level stay, and 2^28 faces make 14 levels
  std::size_t waiting = 0;
  stack[waiting++] = {root, 0};
  while (waiting > 0) {
    const Waiting next = stack[--waiting];
    if (next.distance2 > limit) continue;
    if (next.child & kTreeLeaf) {
      try_leaf(next.child & ~kTreeLeaf, p, at, best);
      limit = limit_of(best.distance2);
      continue;
    }
    const TreeNode& node = nodes[next.child];
    const Float4 distance2 = box_distance2(node.lo, node.hi, at);
    // Farthest first, so that the nearest is on top.
    const std::size_t before = waiting;
    for (std::size_t i = 0; i < 4; ++i) {
      if (node.child[i] == kTreeNoChild || distance2[i] > limit) continue;
      std::size_t place = waiting++;
      for (; place > before && stack[place - 1].distance2 < distance2[i]; --place) stack[place] = stack[place - 1];
      stack[place] = {node.child[i], distance2[i]};
    }
  }
}

SurfacePoint TriangleTree::nearest(const Vec3d& p, FaceId hint) const {
  const Impl& tree = *impl_;
  SurfacePoint best;
  if (hint.valid()) {
    ETALON_CHECK(hint.index < tree.slot.size(), fmt::format("hint: face {} of {}", hint.index, tree.slot.size()));
    Impl::try_triangle(tree.triangles[tree.slot[hint.index]], p, best);
  }
  tree.search(p, best);
  return best;
}

TriangleTree::TriangleTree(const Mesh& mesh) : impl_(std::make_unique<Impl>(mesh)) {}
TriangleTree::~TriangleTree() = default;
TriangleTree::TriangleTree(TriangleTree&&) noexcept = default;
TriangleTree& TriangleTree::operator=(TriangleTree&&) noexcept = default;

}  // namespace etalon
