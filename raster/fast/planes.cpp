#include "raster/fast/planes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "raster/fast/tile_edges.h"

namespace etalon::raster::fast {
namespace {

// Three numbers per edge function: at the anchor, per column, per row, exact integers (each below 2^62, so one rounding as doubles).
struct EdgePlane {
  double anchor, x, y;
};

// The largest distance of a sample of the triangle in this tile from the anchor.
struct Reach {
  double x, y;
};

// ΣE_k·p_k·d_k for the corners k = 1, 2 (the differences d are to corner 0), and the sum of the terms' magnitudes over the reach.
struct Numerator {
  double anchor, x, y, magnitude;
};

Numerator numerator(const std::array<EdgePlane, 3>& e, const std::array<double, 3>& weight, const Reach& reach, double d1, double d2) {
  const double s1 = weight[1] * d1, s2 = weight[2] * d2;
  const auto magnitude = [&](double a, double b) { return std::abs(a * s1) + std::abs(b * s2); };
  return {e[1].anchor * s1 + e[2].anchor * s2, e[1].x * s1 + e[2].x * s2, e[1].y * s1 + e[2].y * s2,
          magnitude(e[1].anchor, e[2].anchor) + reach.x * magnitude(e[1].x, e[2].x) + reach.y * magnitude(e[1].y, e[2].y)};
}

struct Denominator {
  bool affine = true;
  bool usable = true;
  std::array<double, 3> weight{1, 1, 1};  ///< of the edge functions: 1/area, or w_j·w_k
  double anchor = 1, x = 0, y = 0;
  double least = 1;  ///< Q is at least this at every sample inside
  double error = 0;  ///< absolute, of the computed Q
};

Denominator denominator(const std::array<EdgePlane, 3>& e, const Reach& reach, double area2, const std::array<double, 3>& w) {
  Denominator q;
  if (w[0] == w[1] && w[1] == w[2]) {
    q.weight.fill(1 / area2);
    return q;
  }
  q.affine = false;
  q.weight = {w[1] * w[2], w[2] * w[0], w[0] * w[1]};  // exact: two mantissas of 24 bits
  q.anchor = q.x = q.y = 0;
  double magnitude = 0;
  for (int k = 0; k < 3; ++k) {
    q.anchor += e[k].anchor * q.weight[k], q.x += e[k].x * q.weight[k], q.y += e[k].y * q.weight[k];
    magnitude += (std::abs(e[k].anchor) + reach.x * std::abs(e[k].x) + reach.y * std::abs(e[k].y)) * q.weight[k];
  }
  // Every term rounds at most five times on its way into the sum (edge, product, two additions, product with the position) and the three
  // parts are added with two more: 7·2^-53 of the magnitudes, bounded by 16·2^-53.
  q.error = magnitude * 0x1p-49;
  q.least = area2 * std::min({q.weight[0], q.weight[1], q.weight[2]});  // ΣE_k = area, all E_k >= 0 inside
  q.usable = q.error <= 0x1p-10 * q.least;
  return q;
}

// Bound of |computed − exact| of base + R/Q. With u = 2^-53: every term of R rounds at most ten times (difference, area, its reciprocal,
// edge, three products, three additions), so R errs by less than 12u·magnitude; R/Q <= d = max|d_k| (a convex combination of 0, d1, d2); the
// quotient, its product and the sum round by less than 4u(|base| + d). Affine: Q = 1 without error. The factor of two that is left covers
// the arithmetic of this bound and one rounding of the value's size where it is used: value ± error, or value · image size. Fused or not
// makes no difference: fusing only removes roundings.
double error_bound(const Numerator& r, const Denominator& q, double base, double d) {
  const double quotient_error = (12 * 0x1p-53 * r.magnitude + d * q.error) / (q.least * (1 - 0x1p-10));
  return 2 * quotient_error + 8 * 0x1p-53 * (std::abs(base) + d);
}

void write_plane(const std::array<EdgePlane, 3>& e, const Denominator& q, const Reach& reach, const std::array<double, 3>& a, double* out,
                 double& error) {
  const double d1 = a[1] - a[0], d2 = a[2] - a[0];
  out[kPlaneBase] = a[0];
  if (d1 == 0 && d2 == 0) {  // base + 0/Q is exact
    out[kPlaneAnchor] = out[kPlaneX] = out[kPlaneY] = error = 0;
    return;
  }
  const Numerator r = numerator(e, q.weight, reach, d1, d2);
  out[kPlaneAnchor] = r.anchor, out[kPlaneX] = r.x, out[kPlaneY] = r.y;
  error = error_bound(r, q, a[0], std::max(std::abs(d1), std::abs(d2)));
}

void write_useless_plane(double* out, double& error) {
  std::fill_n(out, kPlaneGroup, 0.0);
  error = std::numeric_limits<double>::infinity();
}

double canonical_attribute(const RasterVertex& v, PlaneAttribute a) {
  if (a <= kPlaneV) return canonical(a == kPlaneU ? v.uv.x : v.uv.y);
  return canonical(v.color[a - kPlaneRed]);
}

}  // namespace

bool make_planes(const DrawList& list, std::uint32_t t, const Frame& frame, const Tile& tile, const PlaneLayout& layout, double* out) {
  const auto& corner = list.triangles[t];
  const std::array<const RasterVertex*, 3> v = {&list.vertices[corner[0]], &list.vertices[corner[1]], &list.vertices[corner[2]]};
  TileEdges edges;
  ETALON_CHECK(edges.set(*v[0], *v[1], *v[2], frame.state, tile), "a visible triangle draws nothing");
  const Reach reach = {static_cast<double>(edges.column1 - edges.column0), static_cast<double>(edges.row1 - edges.row0)};
  std::array<EdgePlane, 3> e;
  for (std::size_t k = 0; k < 3; ++k)
    e[k] = {static_cast<double>(edges.value[k]), static_cast<double>(edges.step_x[k]), static_cast<double>(edges.step_y[k])};
  const Denominator q = denominator(e, reach, static_cast<double>(edges.area2), {v[0]->w, v[1]->w, v[2]->w});

  out[kAnchorColumn] = edges.column0, out[kAnchorRow] = edges.row0;
  out[kQ] = q.usable ? q.anchor : 1, out[kQ + 1] = q.usable ? q.x : 0, out[kQ + 2] = q.usable ? q.y : 0, out[kQ + 3] = 0;
  if (layout.edges() >= 0) {
    double* edge = out + layout.edges();
    for (int k = 0; k < 3; ++k, edge += kEdgeNumbers) {
      const __int128 dx = edges.dx[k], dy = edges.dy[k];
      edge[kEdgeAnchor] = e[k].anchor, edge[kEdgeX] = e[k].x, edge[kEdgeY] = e[k].y;
      edge[kEdgeReciprocalLength] = 1 / std::sqrt(static_cast<double>(dx * dx + dy * dy));
    }
  }
  for (int n = 0; n < kPlaneAttributes; ++n) {
    const auto a = static_cast<PlaneAttribute>(n);
    if (!layout.has(a)) continue;
    double* plane = out + layout.offset(a);
    double& error = out[layout.error(a)];
    if (!q.usable) {
      write_useless_plane(plane, error);
    } else if (a >= kPlaneWeight0) {
      std::array<double, 3> unit{};
      unit[static_cast<std::size_t>(a - kPlaneWeight0)] = 1;
      write_plane(e, q, reach, unit, plane, error);
    } else {
      write_plane(e, q, reach, {canonical_attribute(*v[0], a), canonical_attribute(*v[1], a), canonical_attribute(*v[2], a)}, plane, error);
    }
  }
  return !q.affine && q.usable;
}

}  // namespace etalon::raster::fast
