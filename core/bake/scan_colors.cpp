#include "core/bake/scan_colors.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"

namespace etalon::bake {
namespace {

constexpr std::size_t kFacesAtOnce = 16;

// Of the places of one texel, or of all of a node.
struct Sum {
  std::array<std::uint64_t, 3> channels{};
  std::uint64_t places = 0;

  void add(const Sum& other) {
    for (std::size_t c = 0; c < 3; ++c) channels[c] += other.channels[c];
    places += other.places;
  }
  [[nodiscard]] Rgb8 mean() const {
    Rgb8 color{};
    for (std::size_t c = 0; c < 3; ++c) color[c] = static_cast<std::uint8_t>((2 * channels[c] + places) / (2 * places));
    return color;
  }
};

Vec3d scaled(const Vec3d& v, double by) { return {v.x * by, v.y * by, v.z * by}; }
Vec3d unit_or_zero(const Vec3d& v) {
  const double length = std::sqrt(dot_product(v, v));
  return length > 0 ? Vec3d{v.x / length, v.y / length, v.z / length} : Vec3d{0, 0, 0};
}

// A triangle in space: its corners at (0, 0), (1, 0) and (0, 1) of the plane of its tile, and two directions in it at right angles.
struct FacePlane {
  Vec3d corner, right, up, along, across;

  FacePlane(const Mesh& mesh, std::uint32_t face, int right_corner) {
    const auto at = [&](int slot) { return to_double(mesh.position(FaceId(face), (right_corner + slot) % 3)); };
    const Vec3d b = at(1), c = at(2);
    corner = at(0);
    right = {b.x - corner.x, b.y - corner.y, b.z - corner.z};
    up = {c.x - corner.x, c.y - corner.y, c.z - corner.z};
    along = unit_or_zero(right);
    const Vec3d part = scaled(along, dot_product(up, along));
    across = unit_or_zero({up.x - part.x, up.y - part.y, up.z - part.z});
  }
  [[nodiscard]] Vec3d point(double u, double v, double along_by, double across_by) const {
    const auto coordinate = [&](int c) { return corner[c] + (u * right[c] + v * up[c]) + (along_by * along[c] + across_by * across[c]); };
    return {coordinate(0), coordinate(1), coordinate(2)};
  }
};

Sum color_at(const Mesh& scan, const SurfacePoint& at) {
  Sum sum{.places = 1};
  for (int c = 0; c < 3; ++c) {
    double value = 0;
    for (int k = 0; k < 3; ++k)
      value += at.weights[k] * std::clamp(static_cast<double>(scan.colors[scan.vertex(at.face, k).index][c]), 0.0, 1.0);
    sum.channels[static_cast<std::size_t>(c)] = static_cast<std::uint64_t>(std::clamp(value, 0.0, 1.0) * 255 + 0.5);
  }
  return sum;
}

// Samples one face after another; the memory is kept.
class FaceSampler {
 public:
  FaceSampler(const Mesh& scan, const TriangleTree& tree) : scan_(scan), tree_(tree) {}

  /// Into sums, by texel of the face. Returns the largest squared distance of a centre.
  double sample(const FacePlane& plane, int size, Sum* sums) {
    points_.clear();
    for_each_texel(size, [&](int i, int j) { points_.push_back(plane.point((i + 0.5) / size, (j + 0.5) / size, 0, 0)); });
    find();
    distances_.clear();
    double farthest2 = 0;
    for (const SurfacePoint& center : found_) {
      farthest2 = std::max(farthest2, center.distance2);
      sums[distances_.size()].add(color_at(scan_, center));
      distances_.push_back(std::sqrt(center.distance2));
    }
    collect_places(plane, size);
    find();
    for (std::size_t n = 0; n < found_.size(); ++n) sums[texels_[n]].add(color_at(scan_, found_[n]));
    return farthest2;
  }

 private:
  void find() {
    found_.resize(points_.size());
    tree_.nearest(points_, found_);
  }
  // The four around each centre. Of one that lies beyond the hypotenuse the triangle shows nothing.
  void collect_places(const FacePlane& plane, int size) {
    points_.clear(), texels_.clear();
    const int all = 6 * size;  // sixths of a texel along a leg
    std::uint32_t texel = 0;
    for_each_texel(size, [&](int i, int j) {
      const double spread = distances_[texel] * 2 / 3;
      for (const int y : {-1, 1})
        for (const int x : {-1, 1}) {
          const int right = 6 * i + 3 + 2 * x, up = 6 * j + 3 + 2 * y;
          if (right + up > all) continue;
          points_.push_back(plane.point(static_cast<double>(right) / all, static_cast<double>(up) / all, x * spread, y * spread));
          texels_.push_back(texel);
        }
      ++texel;
    });
  }

  const Mesh& scan_;
  const TriangleTree& tree_;
  std::vector<Vec3d> points_;
  std::vector<SurfacePoint> found_;
  std::vector<double> distances_;      // by texel
  std::vector<std::uint32_t> texels_;  // by place
};

}  // namespace

ScanColors sample_scan(const Mesh& scan, const TriangleTree& tree, const Mesh& mesh, const Atlas& atlas, const TexelNodes& nodes) {
  std::vector<Sum> sums(nodes.texel_count());
  std::vector<double> farthest2(mesh.face_count());
  parallel_for_blocks(mesh.face_count(), kFacesAtOnce, [&](std::size_t begin, std::size_t end) {
    FaceSampler sampler(scan, tree);
    for (std::size_t f = begin; f < end; ++f) {
      const auto face = static_cast<std::uint32_t>(f);
      const Tile& tile = atlas.tiles[f];
      farthest2[f] = sampler.sample(FacePlane(mesh, face, tile.right_corner), tile.size, &sums[nodes.first(face)]);
    }
  });
  ScanColors result{.color = std::vector<Rgb8>(nodes.texel_count())};
  for (std::uint32_t t = 0; t < nodes.texel_count(); ++t)
    if (const std::uint32_t node = nodes.node_of(t); node != t) sums[node].add(sums[t]);
  for (std::uint32_t t = 0; t < nodes.texel_count(); ++t) result.color[t] = sums[nodes.node_of(t)].mean();
  for (const double distance2 : farthest2) result.distance_max = std::max(result.distance_max, std::sqrt(distance2));
  return result;
}

}  // namespace etalon::bake
