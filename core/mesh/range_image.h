// A range image: a grid of depths, the explicit surface z = f(x, y) that a range sensor measures [Soucy, Godin & Rioux 1996, section 5],
// and its triangulation.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/mesh/mesh.h"

namespace etalon {

struct RangeImage {
  int width = 0, height = 0;
  double spacing = 1;    ///< model units from sample to sample, along x and y
  std::vector<float> z;  ///< width·height depths in model units, toward the sensor; row-major, row 0 at the lowest y; not finite: no sample

  [[nodiscard]] float at(int i, int j) const {
    return z[static_cast<std::size_t>(j) * static_cast<std::size_t>(width) + static_cast<std::size_t>(i)];
  }
};

/// Samples that are there.
[[nodiscard]] std::size_t sample_count(const RangeImage& range);

struct TriangulateOptions {
  /// Model units; a triangle with an edge along which depth differs by more is left out, as one that would join two parts of the object.
  /// By default 4·spacing (a slope of 76°); infinity joins everything.
  std::optional<double> max_jump;
};

/// The surface through the samples, seen counter-clockwise from +z.
/// - Sample (i, j) lies at ((i + ½)·spacing, (j + ½)·spacing, z), in double, rounded once to float32: pixel centres.
/// - A cell of four samples becomes two triangles along the diagonal of less difference in depth; equal: from (i, j) to (i + 1, j + 1). A
///   cell of three becomes one, a cell of fewer none. `max_jump` then drops triangles one by one.
/// - Vertices are the samples of at least one triangle, in the order of the grid; faces follow the cells in that order. Where parts touch at
///   one sample only, that vertex is not manifold.
/// `rgb`: empty, or 3 bytes a sample in the order of `z` (the bytes of an RGB unorm8 image of this size): vertex colours i/255, alpha 1.
/// No faces where no triangle is left. InputError where sizes do not fit each other, or the spacing or max_jump is not above 0.
[[nodiscard]] Mesh triangulate(const RangeImage& range, std::span<const std::byte> rgb = {}, const TriangulateOptions& options = {});

/// The triangles of a grid by the rules above, as indices of samples; `depth` row-major, not finite: no sample; max_jump above 0.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> grid_triangles(int width, int height, std::span<const float> depth,
                                                                       double max_jump);

}  // namespace etalon
