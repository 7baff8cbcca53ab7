// Many queries at once: points are put in order along a curve through space, and each run of them gathers the few leaves that can hold the nearest
// triangle of any of its points; then each point looks into those alone.
#include <fmt/format.h>

#include <numeric>

#include "core/base/error.h"
#include "core/mesh/triangle_tree_impl.h"

namespace etalon {

namespace {

/// How many points look for their leaves together at most, and at how few each goes its own way.
constexpr std::size_t kMostPoints = 24, kFewestPoints = 2;
/// How many leaves are too many for a group.
constexpr std::size_t kMostLeaves = 48;

// Bits 0 to 6 to bits 0, 3, …, 18.
std::uint32_t spread(std::uint32_t x) {
  x = (x | (x << 8)) & 0x0000F00Fu;
  x = (x | (x << 4)) & 0x000C30C3u;
  return (x | (x << 2)) & 0x00249249u;
}

/// The points' indices in the order of a Z curve through 128³ cells of their box.
std::vector<std::uint32_t> curve_order(std::span<const Vec3d> points) {
  Vec3d lo = points[0], hi = points[0];
  for (const Vec3d& p : points)
    for (int k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], p[k]);
      hi[k] = std::max(hi[k], p[k]);
    }
  const double side = std::max({hi.x - lo.x, hi.y - lo.y, hi.z - lo.z});
  const double cells = side > 0 ? 127.0 / side : 0;
  std::vector<std::uint32_t> key(points.size()), order(points.size()), other(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::uint32_t cell[3];
    for (int k = 0; k < 3; ++k) cell[k] = static_cast<std::uint32_t>((points[i][k] - lo[k]) * cells) & 127u;
    key[i] = spread(cell[0]) | spread(cell[1]) << 1 | spread(cell[2]) << 2;
  }
  std::iota(order.begin(), order.end(), 0u);
  constexpr std::uint32_t kDigits = 1u << 11;
  for (const unsigned shift : {0u, 11u}) {
    std::array<std::uint32_t, kDigits> place{};
    for (const std::uint32_t k : key) ++place[(k >> shift) % kDigits];
    std::exclusive_scan(place.begin(), place.end(), place.begin(), 0u);
    for (const std::uint32_t i : order) other[place[(key[i] >> shift) % kDigits]++] = i;
    order.swap(other);
  }
  return order;
}

}  // namespace

class TriangleTree::Groups {
 public:
  Groups(const Impl& tree, std::span<const Vec3d> points, std::span<SurfacePoint> found) : tree_(tree), points_(points), found_(found) {}

  void run() {
    const std::vector<std::uint32_t> order = curve_order(points_);
    for (std::size_t i = 0; i < order.size(); i += kMostPoints) run(std::span(order).subspan(i, std::min(kMostPoints, order.size() - i)));
  }

 private:
  struct Ball {
    Vec3d centre{0, 0, 0};
    double radius = 0;
  };

  void run(std::span<const std::uint32_t> group) {
    if (group.size() <= kFewestPoints) {
      for (const std::uint32_t i : group) search(i);
    } else if (gather(ball_of(group))) {
      for (const std::uint32_t i : group) compare(i);
    } else {
      run(group.first(group.size() / 2));
      run(group.subspan(group.size() / 2));
    }
  }

  [[nodiscard]] Ball ball_of(std::span<const std::uint32_t> group) const {
    Vec3d lo = points_[group[0]], hi = lo;
    for (const std::uint32_t i : group)
      for (int k = 0; k < 3; ++k) {
        lo[k] = std::min(lo[k], points_[i][k]);
        hi[k] = std::max(hi[k], points_[i][k]);
      }
    Ball ball{.centre = {0.5 * (lo.x + hi.x), 0.5 * (lo.y + hi.y), 0.5 * (lo.z + hi.z)}};
    double radius2 = 0;
    for (const std::uint32_t i : group) radius2 = std::max(radius2, squared_distance(points_[i], ball.centre));
    ball.radius = std::sqrt(radius2);
    return ball;
  }

  // The triangle that was nearest to a point nearby.
  void try_hint(const Vec3d& p, SurfacePoint& best) const {
    if (hint_.valid()) Impl::try_triangle(tree_.triangles[tree_.slot[hint_.index]], p, best);
  }

  void search(std::uint32_t i) {
    SurfacePoint best;
    try_hint(points_[i], best);
    tree_.search(points_[i], best);
    hint_ = best.face;
    found_[i] = best;
  }

  // All leaves that can hold the nearest triangle of a point of the ball: p is at most r from its centre c, so its nearest triangle is at most
  // d(c) + r from p and d(c) + 2r from c. False where they are too many.
  bool gather(const Ball& ball) {
    const ScaledPoint at(tree_.scaled(ball.centre));
    SurfacePoint nearest;
    try_hint(ball.centre, nearest);
    float near_limit = 0, limit = 0;
    const auto tighten = [&] {
      const double reach = (std::sqrt(nearest.distance2) + 2 * ball.radius) * (1 + 0x1p-20);
      near_limit = tree_.limit_of(nearest.distance2);
      limit = tree_.limit_of(reach * reach);
    };
    tighten();
    leaves_ = 0;
    struct Waiting {
      std::uint32_t child, node;
      float distance2;
    };
    std::array<Waiting, 96> stack;
    std::size_t waiting = 0;
    stack[waiting++] = {tree_.root, kTreeNoChild, 0};
    while (waiting > 0) {
      const Waiting next = stack[--waiting];
      if (next.distance2 > limit) continue;
      if (next.child & kTreeLeaf) {
        if (leaves_ == kMostLeaves) return false;
        add_leaf(next.child, next.node);
        if (next.distance2 <= near_limit) {
          tree_.try_leaf(next.child & ~kTreeLeaf, ball.centre, at, nearest);
          tighten();
        }
        continue;
      }
      const TreeNode& node = tree_.nodes[next.child];
      const Float4 distance2 = box_distance2(node.lo, node.hi, at);
      const std::size_t before = waiting;
      for (std::size_t i = 0; i < 4; ++i) {
        if (node.child[i] == kTreeNoChild || distance2[i] > limit) continue;
        std::size_t place = waiting++;
        for (; place > before && stack[place - 1].distance2 < distance2[i]; --place) stack[place] = stack[place - 1];
        stack[place] = {node.child[i], next.child, distance2[i]};
      }
    }
    hint_ = nearest.face;
    return true;
  }

  void add_leaf(std::uint32_t child, std::uint32_t node) {
    leaf_[leaves_] = child & ~kTreeLeaf;
    const std::size_t lane = leaves_ % 4;
    LeafBoxes& boxes = boxes_[leaves_ / 4];
    ++leaves_;
    if (lane == 0)
      for (int k = 0; k < 3; ++k) {
        boxes.lo[k] = all_four(std::numeric_limits<float>::infinity());
        boxes.hi[k] = -boxes.lo[k];
      }
    if (node == kTreeNoChild) {  // a tree of one leaf: anywhere
      for (int k = 0; k < 3; ++k) boxes.lo[k] = all_four(-1), boxes.hi[k] = all_four(1);
      return;
    }
    const TreeNode& parent = tree_.nodes[node];
    const auto i = static_cast<std::size_t>(std::find(parent.child.begin(), parent.child.end(), child) - parent.child.begin());
    for (int k = 0; k < 3; ++k) {
      boxes.lo[k][lane] = parent.lo[k][i];
      boxes.hi[k][lane] = parent.hi[k][i];
    }
  }

  // One point with the gathered leaves.
  void compare(std::uint32_t i) {
    const Vec3d& p = points_[i];
    const ScaledPoint at(tree_.scaled(p));
    SurfacePoint best;
    if (hint_.valid()) tree_.try_leaf(tree_.slot[hint_.index] / 4, p, at, best);
    const std::uint32_t tried = hint_.valid() ? tree_.slot[hint_.index] / 4 : kTreeNoChild;
    float limit = tree_.limit_of(best.distance2);
    for (std::size_t n = 0; n < leaves_; n += 4) {
      const Float4 distance2 = box_distance2(boxes_[n / 4].lo, boxes_[n / 4].hi, at);
      for (std::size_t k = 0; k < 4; ++k) {
        if (distance2[k] > limit || n + k >= leaves_ || leaf_[n + k] == tried) continue;
        tree_.try_leaf(leaf_[n + k], p, at, best);
        limit = tree_.limit_of(best.distance2);
      }
    }
    hint_ = best.face;
    found_[i] = best;
  }

  struct LeafBoxes {
    Float4 lo[3], hi[3];
  };

  const Impl& tree_;
  std::span<const Vec3d> points_;
  std::span<SurfacePoint> found_;
  FaceId hint_;
  std::size_t leaves_ = 0;
  std::array<std::uint32_t, kMostLeaves> leaf_;
  std::array<LeafBoxes, kMostLeaves / 4> boxes_;
};

void TriangleTree::nearest(std::span<const Vec3d> points, std::span<SurfacePoint> found) const {
  ETALON_CHECK(points.size() == found.size(), fmt::format("{} points, {} places", points.size(), found.size()));
  if (!points.empty()) Groups(*impl_, points, found).run();
}

}  // namespace etalon
