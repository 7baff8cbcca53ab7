// Window depth over a triangle's texels of one tile, as the contract stores it: by a plane where its bound decides.
#pragma once

#include <array>
#include <bit>
#include <cmath>

#include "raster/fast/kernels.h"
#include "raster/fast/tile_edges.h"
#include "raster/sample_values.h"
#include "raster/triangle_setup.h"

namespace etalon::raster::fast {

/// Depths of at most so many texels are not worth a call.
inline constexpr int kShortSpan = 4;

/// Window depth over one triangle's texels of the tile, as a plane with a bound; the exact number where that cannot decide.
class DepthPlane {
 public:
  DepthPlane(const RasterVertex* const v[3], const TileEdges& edges) : vertices_{v[0], v[1], v[2]}, edges_(edges) {
    const double z0 = canonical(v[0]->z), d1 = canonical(v[1]->z) - z0, d2 = canonical(v[2]->z) - z0;
    anchor_ = z0;
    if (d1 == 0 && d2 == 0) return;
    const double reciprocal = 1 / static_cast<double>(edges.area2);
    const double s1 = d1 * reciprocal, s2 = d2 * reciprocal;
    const auto part = [&](const std::array<std::int64_t, 3>& e) {
      return std::array<double, 2>{static_cast<double>(e[1]) * s1, static_cast<double>(e[2]) * s2};
    };
    const auto at = part(edges.value), x = part(edges.step_x), y = part(edges.step_y);
    anchor_ += at[0] + at[1], x_ = x[0] + x[1], y_ = y[0] + y[1];
    // As the affine bound in planes.cpp: 12·2^-53 of the magnitudes and 4·2^-53 of the sum, doubled.
    error_ = 0x1p-48 * (z0 + std::abs(at[0]) + std::abs(at[1]) + (edges.column1 - edges.column0) * (std::abs(x[0]) + std::abs(x[1])) +
                        (edges.row1 - edges.row0) * (std::abs(y[0]) + std::abs(y[1])));
  }

  /// Stored depths of `lanes` texels from (column, row) on, counted from the edges' first sample.
  void span(int column, int row, int lanes, const Kernels& kernels, float* result, EvaluationCounters& counters) const {
    const double z = anchor_ + y_ * row + x_ * column;
    counters.values += static_cast<std::uint64_t>(lanes);
    if (lanes > kShortSpan) {
      for (LaneMask open = kernels.depth(z, x_, error_, lanes, result); open != 0; open &= open - 1)
        result[std::countr_zero(open)] = exact(column + std::countr_zero(open), row, counters);
      return;
    }
    for (int n = 0; n < lanes; ++n) {
      const double value = z + x_ * n;
      const float low = static_cast<float>(value - error_), high = static_cast<float>(value + error_);
      result[n] = low == high ? low + 0.0f : exact(column + n, row, counters);
    }
  }

 private:
  [[nodiscard]] float exact(int column, int row, EvaluationCounters& counters) const {
    ++counters.scalar;
    EdgeValues e;
    for (std::size_t k = 0; k < 3; ++k) e[k] = edges_.value[k] + column * edges_.step_x[k] + row * edges_.step_y[k];
    return stored_depth(e, edges_.area2, exact_triple(vertices_[0]->z, vertices_[1]->z, vertices_[2]->z));
  }
  const RasterVertex* vertices_[3];
  const TileEdges& edges_;
  double anchor_ = 0, x_ = 0, y_ = 0, error_ = 0;
};

}  // namespace etalon::raster::fast
