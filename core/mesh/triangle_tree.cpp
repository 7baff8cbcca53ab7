#include "core/mesh/triangle_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/error.h"

namespace etalon {

namespace {

// Four floats side by side: plain IEEE operations on each, on every machine.
using Float4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));

Float4 all(float x) { return Float4{x, x, x, x}; }
Float4 larger(Float4 a, Float4 b) { return a > b ? a : b; }

constexpr std::uint32_t kLeaf = 0x80000000u;  // child = kLeaf | index into triangles, below 2^28
constexpr std::uint32_t kNoChild = 0xFFFFFFFFu;

struct alignas(128) Node {
  Float4 lo[3], hi[3];
  std::array<std::uint32_t, 4> child;
};

struct Triangle {
  std::array<Vec3f, 3> corner;
  std::uint32_t face;
};

struct Box {
  Vec3f lo{std::numeric_limits<float>::infinity()}, hi{-std::numeric_limits<float>::infinity()};
  void add(const Vec3f& p) {
    for (int k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], p[k]);
      hi[k] = std::max(hi[k], p[k]);
    }
  }
};

}  // namespace

struct TriangleTree::Impl {
  std::vector<Node> nodes;
  std::vector<Triangle> triangles;  // in the order of the leaves, scaled
  std::vector<std::uint32_t> slot;  // by face: index into triangles
  double scale = 1, unit = 1;       // powers of two: scaled = scale · model, unit = 1 / scale
  std::uint32_t root = kNoChild;
  std::vector<std::uint32_t> order;  // while building
  std::vector<Triangle> source;      // while building, by face
  std::vector<Vec3f> centre;         // while building, by face

  explicit Impl(const Mesh& mesh);
  std::uint32_t build(std::size_t begin, std::size_t end);
  void split(std::size_t begin, std::size_t middle, std::size_t end);
  [[nodiscard]] Box box_of(std::size_t begin, std::size_t end) const;
  void try_triangle(const Triangle& triangle, const Vec3d& p, SurfacePoint& best) const;
};

TriangleTree::Impl::Impl(const Mesh& mesh) {
  if (mesh.faces.empty()) throw InputError("surface: expected at least one face, got none");
  if (mesh.face_count() >= (1u << 28)) throw InputError(fmt::format("surface: expected fewer than 2^28 faces, got {}", mesh.face_count()));
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
  int exponent = 0;
  if (largest > 0) std::frexp(static_cast<double>(largest), &exponent);
  unit = std::ldexp(1.0, exponent);
  scale = std::ldexp(1.0, -exponent);
  centre.resize(source.size());
  order.resize(source.size());
  for (std::uint32_t f = 0; f < source.size(); ++f) {
    for (Vec3f& p : source[f].corner)
      p = {static_cast<float>(p.x * scale), static_cast<float>(p.y * scale), static_cast<float>(p.z * scale)};
    const auto& c = source[f].corner;
    for (int k = 0; k < 3; ++k) centre[f][k] = std::min({c[0][k], c[1][k], c[2][k]}) + std::max({c[0][k], c[1][k], c[2][k]});
    order[f] = f;
  }
  nodes.reserve(source.size() / 2);
  root = build(0, order.size());
  slot.resize(source.size());
  triangles.resize(source.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    triangles[i] = source[order[i]];
    slot[order[i]] = i;
  }
  order = {};
  source = {};
  centre = {};
}

Box TriangleTree::Impl::box_of(std::size_t begin, std::size_t end) const {
  Box box;
  for (std::size_t i = begin; i < end; ++i)
    for (const Vec3f& p : source[order[i]].corner) box.add(p);
  return box;
}

// Halves [begin, end) at `middle` by centres along the longest side of their box, ties by face.
void TriangleTree::Impl::split(std::size_t begin, std::size_t middle, std::size_t end) {
  Box box;
  for (std::size_t i = begin; i < end; ++i) box.add(centre[order[i]]);
  const Vec3f side = box.hi - box.lo;
  const int axis = side.x >= side.y ? (side.x >= side.z ? 0 : 2) : (side.y >= side.z ? 1 : 2);
  const auto at = [&](std::size_t i) { return order.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
    const float ca = centre[a][axis], cb = centre[b][axis];
    return ca != cb ? ca < cb : a < b;
  });
}

std::uint32_t TriangleTree::Impl::build(std::size_t begin, std::size_t end) {
  const std::size_t count = end - begin;
  if (count == 1) return kLeaf | static_cast<std::uint32_t>(begin);
  // The first half is a power of two, so that the lowest nodes are full.
  const auto half = [](std::size_t n) {
    std::size_t full = 1;
    while (2 * full < n) full *= 2;
    return full;
  };
  std::array<std::size_t, 5> cut{begin, begin, begin + half(count), end, end};
  split(begin, cut[2], end);
  cut[1] = cut[2] - begin > 1 ? begin + half(cut[2] - begin) : cut[2];
  cut[3] = end - cut[2] > 1 ? cut[2] + half(end - cut[2]) : end;
  if (cut[1] < cut[2]) split(begin, cut[1], cut[2]);
  if (cut[3] < end) split(cut[2], cut[3], end);

  const auto id = static_cast<std::uint32_t>(nodes.size());
  nodes.emplace_back();
  for (std::size_t i = 0; i < 4; ++i) {
    // An absent child has an empty box at infinity: its distance is never the least.
    const Box box = box_of(cut[i], cut[i + 1]);
    const std::uint32_t child = cut[i] == cut[i + 1] ? kNoChild : build(cut[i], cut[i + 1]);
    Node& node = nodes[id];
    for (int k = 0; k < 3; ++k) {
      node.lo[k][i] = box.lo[k];
      node.hi[k][i] = box.hi[k];
    }
    node.child[i] = child;
  }
  return id;
}

void TriangleTree::Impl::try_triangle(const Triangle& triangle, const Vec3d& p, SurfacePoint& best) const {
  const auto& c = triangle.corner;
  const NearestOnTriangle found = nearest_on_triangle(p, to_double(c[0]), to_double(c[1]), to_double(c[2]));
  if (found.distance2 > best.distance2 || (found.distance2 == best.distance2 && triangle.face > best.face.index)) return;
  best = {FaceId(triangle.face), found.weights, found.point, found.distance2};
}

SurfacePoint TriangleTree::nearest(const Vec3d& p_model, FaceId hint) const {
  const Impl& tree = *impl_;
  const Vec3d p{p_model.x * tree.scale, p_model.y * tree.scale, p_model.z * tree.scale};
  SurfacePoint best;
  if (hint.valid()) {
    ETALON_CHECK(hint.index < tree.slot.size(), fmt::format("hint: face {} of {}", hint.index, tree.slot.size()));
    tree.try_triangle(tree.triangles[tree.slot[hint.index]], p, best);
  }
  // Box distances are floats. Rounding p moves it by 2^-24 of its largest coordinate at most, and nearest_on_triangle() leaves its triangle by less;
  // boxes are widened by 2^-22 of the largest coordinate there is (the mesh's are below 1). The float sum of squares is then off
  // by less than 2^-21 of itself, which the limit allows for: no face that could win is passed over.
  const double reach = std::max({1.0, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  const Float4 slack = all(static_cast<float>(reach * 0x1p-22));
  const Float4 at[3] = {all(static_cast<float>(p.x)), all(static_cast<float>(p.y)), all(static_cast<float>(p.z))};
  const auto limit_of = [](double distance2) {
    return distance2 < 0x1p120 ? static_cast<float>(distance2 * (1 + 0x1p-20)) : std::numeric_limits<float>::infinity();
  };
  float limit = limit_of(best.distance2);

  struct Waiting {
    std::uint32_t child;
    float distance2;
  };
  std::array<Waiting, 96> stack;  // at most 3 a level stay, and 2^28 faces make 15 levels
  std::size_t waiting = 0;
  stack[waiting++] = {tree.root, 0};
  while (waiting > 0) {
    const Waiting next = stack[--waiting];
    if (next.distance2 > limit) continue;
    if (next.child & kLeaf) {
      tree.try_triangle(tree.triangles[next.child & ~kLeaf], p, best);
      limit = limit_of(best.distance2);
      continue;
    }
    const Node& node = tree.nodes[next.child];
    Float4 sum = all(0);
    for (int k = 0; k < 3; ++k) {
      const Float4 outside = larger(larger(node.lo[k] - at[k], at[k] - node.hi[k]) - slack, all(0));
      sum += outside * outside;
    }
    // Farthest first, so that the nearest is on top.
    const std::size_t before = waiting;
    for (std::size_t i = 0; i < 4; ++i) {
      const float distance2 = sum[i];
      if (node.child[i] == kNoChild || distance2 > limit) continue;
      std::size_t place = waiting++;
      for (; place > before && stack[place - 1].distance2 < distance2; --place) stack[place] = stack[place - 1];
      stack[place] = {node.child[i], distance2};
    }
  }
  best.point = {best.point.x * tree.unit, best.point.y * tree.unit, best.point.z * tree.unit};
  best.distance2 = best.distance2 * tree.unit * tree.unit;
  return best;
}

TriangleTree::TriangleTree(const Mesh& mesh) : impl_(std::make_unique<Impl>(mesh)) {}
TriangleTree::~TriangleTree() = default;
TriangleTree::TriangleTree(TriangleTree&&) noexcept = default;
TriangleTree& TriangleTree::operator=(TriangleTree&&) noexcept = default;

}  // namespace etalon
