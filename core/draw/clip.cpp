#include "core/draw/clip.h"

namespace etalon {
namespace {

double side(const ClipPlane& p, const ClipVertex& v) { return p.x * v.x + p.y * v.y + p.z * v.z + p.w * v.w + p.constant; }

ClipVertex intersection(ClipVertex a, ClipVertex b, const ClipPlane& plane, std::uint64_t plane_index) {
  if (b.order < a.order) std::swap(a, b);
  const double da = side(plane, a), db = side(plane, b);
  const double t = da / (da - db);
  const auto mix = [t](float from, float to) { return static_cast<float>(double{from} + t * (double{to} - double{from})); };
  ClipVertex v;
  v.x = mix(a.x, b.x), v.y = mix(a.y, b.y), v.z = mix(a.z, b.z), v.w = mix(a.w, b.w);
  for (int c = 0; c < 2; ++c) v.uv[c] = mix(a.uv[c], b.uv[c]);
  for (int c = 0; c < 4; ++c) v.color[c] = mix(a.color[c], b.color[c]);
  // SplitMix-style mixing of both ends and the plane: one name per cut point, whichever face asks.
  std::uint64_t h = a.order * 0x9E3779B97F4A7C15ull ^ (b.order + 0x7F4A7C15u) * 0xBF58476D1CE4E5B9ull ^ (plane_index + 1) << 58;
  h = (h ^ (h >> 30)) * 0x94D049BB133111EBull;
  v.order = h | std::uint64_t{1} << 63;
  return v;
}

}  // namespace

std::array<ClipPlane, 8> clip_planes(int width, int height, int guard) {
  // x_window = (x/w + 1)·W/2 >= −guard  ⇔  x + w·(1 + 2·guard/W) >= 0, and so on.
  const double gx = 1 + 2.0 * guard / width, gy = 1 + 2.0 * guard / height;
  return {{{0, 0, 1, 1, 0},
           {0, 0, -1, 1, 0},
           {1, 0, 0, gx, 0},
           {-1, 0, 0, gx, 0},
           {0, 1, 0, gy, 0},
           {0, -1, 0, gy, 0},
           {0, 0, 0, 1, -0x1p-20},
           {0, 0, 0, -1, 0x1p20}}};
}

std::vector<ClipVertex> clip_triangle(const std::array<ClipVertex, 3>& triangle, const std::array<ClipPlane, 8>& planes) {
  std::vector<ClipVertex> polygon(triangle.begin(), triangle.end());
  std::vector<ClipVertex> next;
  for (std::size_t p = 0; p < planes.size() && !polygon.empty(); ++p) {
    next.clear();
    for (std::size_t n = 0; n < polygon.size(); ++n) {
      const ClipVertex& a = polygon[n];
      const ClipVertex& b = polygon[(n + 1) % polygon.size()];
      const bool a_in = side(planes[p], a) >= 0, b_in = side(planes[p], b) >= 0;
      if (a_in) next.push_back(a);
      if (a_in != b_in) next.push_back(intersection(a, b, planes[p], p));
    }
    polygon.swap(next);
  }
  if (polygon.size() < 3) polygon.clear();
  return polygon;
}

}  // namespace etalon
