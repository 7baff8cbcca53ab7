// What one half-edge collapse u → v changes in one chart: the triangles around u before, the fan from v after [Chen & Chuang 2006, sec. 3.2].
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/math/vec.h"

namespace etalon::adapt {

/// The ring around u, counter-clockwise, from v = corner 0. Triangles before: (u, k, k + 1); after: (0, k, k + 1). Where the texture plane has
/// it clockwise (a mirrored chart, the right side of a curve) coordinates are those of its mirror image, (u, −v), which is exact.
struct CollapseRing {
  Vec3f position_of_u{0, 0, 0};
  Vec2f uv_of_u{0, 0};
  std::vector<Vec3f> positions;  ///< #R, model units
  std::vector<Vec2f> uv;         ///< #R
  /// u lies on a curve (border or seam), which leads from v over u to the last corner: there is no triangle (u, last, 0).
  bool on_curve = false;
  /// Where v is before the collapse in the texture, if elsewhere: of a full-edge collapse on a curve, which is one of each end into a point
  /// between them (split_cells.h).
  std::optional<Vec2f> uv_of_v_before;

  [[nodiscard]] const Vec2f& target_before() const { return uv_of_v_before ? *uv_of_v_before : uv[0]; }
  [[nodiscard]] std::size_t size() const { return uv.size(); }
  /// Triangles (u, k, k + 1) before the collapse.
  [[nodiscard]] std::size_t triangles_before() const { return on_curve ? size() - 1 : size(); }
};

/// Whether all triangles before and after are counter-clockwise in the texture plane. Exact.
[[nodiscard]] bool is_unfolded(const CollapseRing& ring);

/// Where u goes in texture space: the coordinate of the point nearest to u on the triangles after the collapse, in double; ties go to the
/// first triangle. On a curve: of the edge between v and the last corner, one parameter.
[[nodiscard]] Vec2d new_place_of_u(const CollapseRing& ring);

}  // namespace etalon::adapt
