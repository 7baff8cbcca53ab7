#include "core/joint/texel_view.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/parallel.h"

namespace etalon::joint {
namespace {

double dot(const Vec3d& a, const Vec3d& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3d cross(const Vec3d& a, const Vec3d& b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
Vec3d unit_vector(const Vec3d& a) {
  const double length = std::sqrt(dot(a, a));
  return {a.x / length, a.y / length, a.z / length};
}

// start + slope·y >= 0.
struct HalfLine {
  double start, slope;
};

struct Interval {
  double low, high;
  [[nodiscard]] bool is_empty() const { return !(low <= high); }
  void clip(const HalfLine& h) {
    if (h.slope == 0) {
      if (h.start < 0) high = low - 1;
      return;
    }
    const double root = -h.start / h.slope;
    if (h.slope > 0)
      low = std::max(low, root);
    else
      high = std::min(high, root);
  }
};

// The frustum on vertical lines.
class VerticalCut {
 public:
  explicit VerticalCut(const terrain::TerrainView& view) : view_(view) {
    forward_ = unit_vector({view.target.x - view.eye.x, view.target.y - view.eye.y, view.target.z - view.eye.z});
    right_ = unit_vector(cross(forward_, view.up));
    up_ = cross(right_, forward_);
    tan_x_ = view.tan_half_fov_y * view.width / view.height;
  }

  /// The depth nearest to the eye at which the line (x, low..high, z) is seen; 0 where it is not.
  [[nodiscard]] double nearest_depth(double x, double z, double low, double high) const {
    const Vec3d from{x - view_.eye.x, -view_.eye.y, z - view_.eye.z};
    const HalfLine depth{dot(from, forward_), forward_.y}, across{dot(from, right_), right_.y}, upward{dot(from, up_), up_.y};
    const auto combined = [&](const HalfLine& a, double of_depth, double of_a) {
      return HalfLine{of_depth * depth.start + of_a * a.start, of_depth * depth.slope + of_a * a.slope};
    };
    Interval seen{low, high};
    seen.clip({depth.start - view_.near, depth.slope});
    seen.clip({view_.far - depth.start, -depth.slope});
    seen.clip(combined(across, tan_x_, 1));
    seen.clip(combined(across, tan_x_, -1));
    seen.clip(combined(upward, view_.tan_half_fov_y, 1));
    seen.clip(combined(upward, view_.tan_half_fov_y, -1));
    if (seen.is_empty()) return 0;
    return std::max(view_.near, std::min(depth.start + depth.slope * seen.low, depth.start + depth.slope * seen.high));
  }

 private:
  terrain::TerrainView view_;
  Vec3d forward_, right_, up_;
  double tan_x_ = 0;
};

}  // namespace

wavelet::TexelView texel_view(const TerrainExtent& extent, const terrain::TerrainView& view, int texture_width, int texture_height) {
  const bool is_extent = extent.bits >= terrain::kMinGridBits && extent.bits <= terrain::kMaxGridBits && extent.spacing > 0 &&
                         extent.uv_step > 0 && std::isfinite(extent.spacing) && std::isfinite(extent.uv_start) &&
                         std::isfinite(extent.uv_step) && extent.lowest_m <= extent.highest_m && std::isfinite(extent.lowest_m) &&
                         std::isfinite(extent.highest_m);
  if (!is_extent || texture_width < 1 || texture_height < 1) throw InputError("texel view: expected a terrain and a texture");
  (void)terrain::ViewFrustum(view);  // refuses views that are none
  const VerticalCut cut(view);
  const int steps = 1 << extent.bits;
  // The length of a texel's longer side in metres, and the pixels of a metre at depth 1.
  const double texel_m = extent.spacing / (extent.uv_step * std::min(texture_width, texture_height));
  const double scale_px = view.height / (2 * view.tan_half_fov_y);
  wavelet::TexelView result{texture_width, texture_height, {}, {}};
  const auto texels = static_cast<std::size_t>(texture_width) * static_cast<std::size_t>(texture_height);
  result.pixels_per_texel.assign(texels, 0);
  result.covered_pixels.assign(texels, 0);
  const auto grid_place = [&](int n, int size) { return ((n + 0.5) / size - extent.uv_start) / extent.uv_step; };
  // Half a texel beyond the border a texel still colours the terrain.
  const auto is_beside = [&](double place, int size) {
    const double texel = 1 / (extent.uv_step * size);
    return place < -texel || place > steps + texel;
  };
  parallel_for(static_cast<std::size_t>(texture_height), [&](std::size_t row) {
    const double j = grid_place(static_cast<int>(row), texture_height);
    if (is_beside(j, texture_height)) return;
    const double z = (steps / 2.0 - j) * extent.spacing;
    for (int column = 0; column < texture_width; ++column) {
      const double i = grid_place(column, texture_width);
      if (is_beside(i, texture_width)) continue;
      const double depth = cut.nearest_depth((i - steps / 2.0) * extent.spacing, z, extent.lowest_m, extent.highest_m);
      if (depth == 0) continue;
      const double pixels = scale_px * texel_m / depth;
      const std::size_t n = row * static_cast<std::size_t>(texture_width) + static_cast<std::size_t>(column);
      result.pixels_per_texel[n] = static_cast<float>(std::min(pixels, 0x1p40));
      result.covered_pixels[n] = result.pixels_per_texel[n] * result.pixels_per_texel[n];
    }
  });
  return result;
}

}  // namespace etalon::joint
