#include "raster/fast/exact_planes.h"

#include <algorithm>
#include <bit>

#include "core/image/image.h"
#include "core/math/quotient.h"
#include "raster/triangle_setup.h"

namespace etalon::raster::fast {
namespace {

using Wide = __int128;
using UnsignedWide = unsigned __int128;

UnsignedWide magnitude(Wide a) { return a < 0 ? -static_cast<UnsignedWide>(a) : static_cast<UnsignedWide>(a); }

int trailing_zeros(UnsignedWide a) {
  const auto low = static_cast<std::uint64_t>(a);
  return low != 0 ? std::countr_zero(low) : 64 + std::countr_zero(static_cast<std::uint64_t>(a >> 64));
}

// An attribute over the tile: base + anchor + x·columns + y·rows, integers of the scale 2^-scale.
struct DyadicPlane {
  Wide base, anchor, x, y;
  int scale;
};

// Value times size: 38 bits of value and 15 of size (kMaxImageSize) fill a double.
constexpr int kValueBits = 38;
static_assert(kMaxImageSize <= 1 << (53 - kValueBits));

bool fits_double(DyadicPlane& plane, int columns, int rows) {
  const UnsignedWide all = magnitude(plane.base) | magnitude(plane.anchor) | magnitude(plane.x) | magnitude(plane.y);
  if (all == 0) return true;
  const int zeros = trailing_zeros(all);
  for (Wide* number : {&plane.base, &plane.anchor, &plane.x, &plane.y}) *number >>= zeros;  // exact
  plane.scale -= zeros;
  constexpr UnsignedWide limit = UnsignedWide{1} << kValueBits;
  if (magnitude(plane.base) >= limit || magnitude(plane.anchor) >= limit || magnitude(plane.x) >= limit || magnitude(plane.y) >= limit)
    return false;
  return magnitude(plane.base) + magnitude(plane.anchor) + magnitude(plane.x) * static_cast<unsigned>(columns) +
             magnitude(plane.y) * static_cast<unsigned>(rows) <
         limit;
}

}  // namespace

bool make_uv_planes_exact(const DrawList& list, std::uint32_t t, const Frame& frame, const Tile& tile, const PlaneLayout& layout,
                          double* planes) {
  const TriangleSetup setup = make_triangle_setup(list, t, frame);
  if (!setup.affine || !layout.has(kPlaneU)) return false;
  const Edges& edges = setup.edges;
  const int column = tile.x0 + static_cast<int>(planes[kAnchorColumn]), row = tile.y0 + static_cast<int>(planes[kAnchorRow]);
  const EdgeValues e = edges.at(column, row);
  const int twos = std::countr_zero(static_cast<std::uint64_t>(edges.area2));
  const std::int64_t odd = edges.area2 >> twos;
  bool some = false;
  for (const auto& [attribute, place] : {std::pair{kU, kPlaneU}, std::pair{kV, kPlaneV}}) {
    const ExactTriple& a = setup.attribute[attribute];
    if (a.bits > 60) continue;  // edges are below 2^62: sums of two products stay below 2^124
    const Wide d1 = a.m[1] - a.m[0], d2 = a.m[2] - a.m[0];
    const auto numerator = [&](std::int64_t e1, std::int64_t e2) { return e1 * d1 + e2 * d2; };
    const Wide n = numerator(e[1], e[2]);
    const Wide nx = numerator(-(edges.dy[1] << edges.subtexel_bits), -(edges.dy[2] << edges.subtexel_bits));
    const Wide ny = numerator(edges.dx[1] << edges.subtexel_bits, edges.dx[2] << edges.subtexel_bits);
    if (n % odd != 0 || nx % odd != 0 || ny % odd != 0) continue;
    DyadicPlane plane = {a.m[0] << twos, n / odd, nx / odd, ny / odd, a.k + twos};
    if (!fits_double(plane, tile.width, tile.height)) continue;
    double* out = planes + layout.offset(place);
    out[kPlaneBase] = scaled(static_cast<double>(plane.base), -plane.scale);
    out[kPlaneAnchor] = scaled(static_cast<double>(plane.anchor), -plane.scale);
    out[kPlaneX] = scaled(static_cast<double>(plane.x), -plane.scale);
    out[kPlaneY] = scaled(static_cast<double>(plane.y), -plane.scale);
    planes[layout.error(place)] = kExactPlane;
    some = true;
  }
  return some;
}

}  // namespace etalon::raster::fast
