// The triangles of a PLY file's range grid. Not for use outside core/io.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/math/vec.h"

namespace etalon::io {

/// Points in rows and columns, as `element range_grid` with one list of no or one vertex for each sample [Turk 1994; Curless & Levoy 1996].
struct RangeGrid {
  static constexpr std::uint32_t kNoSample = 0xFFFFFFFF;
  std::uint64_t columns = 0, rows = 0;
  std::vector<std::uint32_t> vertices;  ///< row-major; kNoSample
};

/// By the rules of triangulate() (core/mesh/range_image.h), depth being z, as indices of vertices; `max_jump`: above 0, by default four times
/// the median distance in x and y of neighbours in a row. Wound so that the sum of the areas seen from +z is not negative, whichever way
/// rows and columns run.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> range_grid_faces(const RangeGrid& grid, const std::vector<Vec3f>& positions,
                                                                         std::optional<double> max_jump);

}  // namespace etalon::io
