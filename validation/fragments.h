// One triangle of a draw list evaluated at texels, in double from exact integer edges; and all the triangles that cover a texel.
// This is the diff's own evaluation: it shares no code with the renderers it judges. Coverage is exact (128-bit integers);
// values are within 2^-48 of the exact rational, relative to the largest vertex value (all weights are of one sign: docs/bounds.md#evaluation).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/draw/draw_list.h"
#include "validation/bounds.h"

namespace etalon::validation {

inline constexpr double kEvaluationError = 0x1p-48;

/// The weights of one sample: exact edge values, rounded once each to double, and what follows from them.
struct Sample {
  double x = 0, y = 0;             ///< texels
  std::array<double, 3> edge{};    ///< E_i, of the triangle made counter-clockwise
  std::array<double, 3> linear{};  ///< E_i / Σ E
  std::array<double, 3> weight{};  ///< perspective-correct b_i
  double q = 1;                    ///< Σ linear_i / w_i
};

/// Vertices 1 and 2 are exchanged where the area is negative; `order` says which vertex of the draw list's triangle each one is.
class TriangleEvaluator {
 public:
  TriangleEvaluator(const DrawList& list, std::uint32_t triangle, const Frame& frame);

  [[nodiscard]] std::uint32_t id() const { return id_; }
  [[nodiscard]] const Draw& draw() const { return *draw_; }
  [[nodiscard]] bool draws() const { return draws_; }  ///< its area is not 0 and it is not culled
  /// Exact, with the frame's fill rule.
  [[nodiscard]] bool covers(int i, int j) const;
  /// The sample lies exactly on an edge (and inside or on the others).
  [[nodiscard]] bool touches(int i, int j) const;
  /// Texel rectangle outside which it covers nothing: x0 <= i < x1.
  [[nodiscard]] std::array<int, 4> box() const { return {x0_, y0_, x1_, y1_}; }

  [[nodiscard]] Sample sample(int i, int j) const;
  /// Distance to the nearest edge in sub-texels; negative outside.
  [[nodiscard]] double edge_margin(const Sample& s) const;

  [[nodiscard]] double linear(const Sample& s, const std::array<double, 3>& a) const;       ///< Σ E a / Σ E
  [[nodiscard]] double perspective(const Sample& s, const std::array<double, 3>& a) const;  ///< Σ b a

  [[nodiscard]] const TriangleGeometry& geometry() const { return geometry_; }
  [[nodiscard]] const std::array<int, 3>& order() const { return order_; }
  /// Vertex values in evaluator order, canonical.
  [[nodiscard]] const std::array<double, 3>& z() const { return z_; }
  [[nodiscard]] const std::array<double, 3>& u() const { return u_; }
  [[nodiscard]] const std::array<double, 3>& v() const { return v_; }
  [[nodiscard]] const std::array<double, 3>& color(int channel) const { return color_[static_cast<std::size_t>(channel)]; }

 private:
  using Wide = __int128;
  [[nodiscard]] std::array<Wide, 3> edges(int i, int j) const;

  std::uint32_t id_ = 0;
  const Draw* draw_ = nullptr;
  bool draws_ = false;
  int half_texel_ = 128, shift_ = 8;
  std::array<std::int64_t, 3> x_{}, y_{};    // sub-texels
  std::array<std::int64_t, 3> dx_{}, dy_{};  // of the edge opposite each vertex, counter-clockwise
  std::array<bool, 3> owns_{};
  std::array<int, 3> order_{0, 1, 2};
  int x0_ = 0, y0_ = 0, x1_ = 0, y1_ = 0;
  TriangleGeometry geometry_;
  std::array<double, 3> z_{}, u_{}, v_{};
  std::array<std::array<double, 3>, 4> color_{};
};

/// Which triangles may cover a texel: a grid of square tiles over the frame, each with its triangles in draw order.
class TriangleGrid {
 public:
  TriangleGrid(const DrawList& list, const Frame& frame);
  /// Candidates in ascending order; a superset of those which cover texel (i, j).
  [[nodiscard]] std::vector<std::uint32_t>::const_iterator begin(int i, int j) const {
    return entries_.begin() + static_cast<std::ptrdiff_t>(first_[tile(i, j)]);
  }
  [[nodiscard]] std::vector<std::uint32_t>::const_iterator end(int i, int j) const {
    return entries_.begin() + static_cast<std::ptrdiff_t>(first_[tile(i, j) + 1]);
  }

 private:
  static constexpr int kTile = 16;
  [[nodiscard]] std::size_t tile(int i, int j) const {
    return static_cast<std::size_t>(j / kTile) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(i / kTile);
  }
  int columns_ = 0;
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> entries_;
};

}  // namespace etalon::validation
