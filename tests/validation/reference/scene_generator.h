// Random draw lists over the whole domain of docs/contract.md, every one accepted by validate().
#pragma once

#include <cstdint>
#include <vector>

#include "core/draw/draw_list.h"
#include "tests/validation/reference/triangle_generator.h"

namespace etalon::validation::reference {

struct Scene {
  DrawList list;
  Frame frame;
  std::vector<Aim> aims;  ///< #T or empty: where a tie was aimed at
};

/// A block of triangles with many shadings, formats and sizes (log-uniform, sub-texel to 4096 texels, a few as large as positions go):
/// general ones, slivers, vertices on texel centres and corners, exact ties of lookup and rounding, ties moved by one ulp, fans that
/// share edges, some smaller than a texel, some without area. Frame positions span up to 2^30 sub-texels. For isolated samples.
[[nodiscard]] Scene random_block(std::uint64_t seed, int triangle_count);

/// A small frame with overlapping triangles, equal and touching depths and every kind of target: for whole frames.
[[nodiscard]] Scene random_frame(std::uint64_t seed, int width, int height, int triangle_count);

}  // namespace etalon::validation::reference
