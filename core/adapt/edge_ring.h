// What one full-edge collapse u, v → w changes inside a chart: the triangles around u and v before, the fan of w after.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/math/vec.h"

namespace etalon::adapt {

/// The ring around both, counter-clockwise; corner 0 is the third corner of the triangle left of u→v. Triangles before: (u, k, k + 1) for
/// k < last_of_u, (v, k, k + 1) behind, (u, v, 0) and (v, u, last_of_u); after: (w, k, k + 1). A mirrored chart has its mirror image,
/// (u, −v), as in CollapseRing.
struct EdgeRing {
  Vec3f position_of_u{0, 0, 0}, position_of_v{0, 0, 0}, position_of_w{0, 0, 0};
  Vec2f uv_of_u{0, 0}, uv_of_v{0, 0}, uv_of_w{0, 0};
  std::vector<Vec3f> positions;  ///< #R, model units
  std::vector<Vec2f> uv;         ///< #R
  std::size_t last_of_u = 0;     ///< 1..#R − 1

  [[nodiscard]] std::size_t size() const { return uv.size(); }
};

/// Nodes of a drawing of both triangulations: u, v, w, then the ring.
inline constexpr std::uint16_t kNodeU = 0, kNodeV = 1, kNodeW = 2, kFirstRingNode = 3;

/// The triangles before the collapse, counter-clockwise, by nodes.
[[nodiscard]] std::vector<std::array<std::uint16_t, 3>> triangles_before(const EdgeRing& ring);

/// Whether all triangles before and after are counter-clockwise in the texture plane. Exact.
[[nodiscard]] bool is_unfolded(const EdgeRing& ring);

}  // namespace etalon::adapt
