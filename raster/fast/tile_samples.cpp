#include "raster/fast/tile_samples.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include "raster/fast/tile_edges.h"
#include "raster/triangle_setup.h"

namespace etalon::raster::fast {
namespace {

// Spans at most this long are found and tested texel by texel.
constexpr int kNarrow = 2;
// Boxes at most this wide are covered by one vector a row.
constexpr int kSmall = 8;
// Depths of at most so many texels are not worth a call.
constexpr int kShort = 4;

// The texels of [first, last] where value + x·column >= 0, by one product and an exact correction.
void clip_span(std::int64_t value, std::int64_t x, double reciprocal, int& first, int& last) {
  if (x == 0) {
    if (value < 0) last = first - 1;
    return;
  }
  // The crossing −value/x; clamped to the tile its double errs by less than 1, and the loops below make it exact.
  const double crossing = std::clamp(static_cast<double>(value) * -reciprocal, -2.0, kTileSize + 1.0);
  int column = static_cast<int>(crossing);
  if (x > 0) {  // inside from some column on
    while (value + x * (column - 1) >= 0 && column > first) --column;
    while (column <= last && value + x * column < 0) ++column;
    first = std::max(first, column);
  } else {  // inside up to some column
    while (value + x * (column + 1) >= 0 && column < last) ++column;
    while (column >= first && value + x * column < 0) --column;
    last = std::min(last, column);
  }
}

// Window depth over one triangle's texels of the tile, as a plane with a bound; the exact number where that cannot decide.
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
    if (lanes > kShort) {
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

class SampleFinder {
 public:
  SampleFinder(const DrawList& list, const Frame& frame, const Tile& tile, SampleNeeds needs, const Kernels& kernels, TileSamples& samples,
               EvaluationCounters& counters)
      : list_(list), frame_(frame), tile_(tile), needs_(needs), kernels_(kernels), samples_(samples), counters_(counters) {}

  void draw(std::uint32_t id, std::uint32_t slot) {
    const auto& corner = list_.triangles[id];
    const RasterVertex* const v[3] = {&list_.vertices[corner[0]], &list_.vertices[corner[1]], &list_.vertices[corner[2]]};
    TileEdges edges;
    if (!edges.set(*v[0], *v[1], *v[2], frame_.state, tile_)) return;
    std::optional<DepthPlane> plane;  // made for the first span that is not empty
    const auto write = [&](int first, int last, int row) {
      if (needs_.depth && !plane) plane.emplace(v, edges);
      write_span(edges, first, last, row, slot, plane ? &*plane : nullptr);
    };
    // Biased, "inside" is >= 0; columns and rows count from the edges' first sample.
    for (std::size_t k = 0; k < 3; ++k) biased_[k] = edges.value[k] - (edges.owns[k] ? 0 : 1);
    const int last_column = edges.column1 - edges.column0, last_row = edges.row1 - edges.row0;
    if (last_column < kNarrow) {
      for (int row = 0; row <= last_row; ++row) {
        int first = 0, last = last_column;
        narrow_span(edges, row, first, last);
        if (first <= last) write(first, last, row);
      }
    } else if (last_column < kSmall && is_small(edges)) {
      SmallTriangle small;
      for (std::size_t k = 0; k < 3; ++k)
        small.value[k] = static_cast<std::int32_t>(biased_[k]), small.x[k] = static_cast<std::int32_t>(edges.step_x[k]),
        small.y[k] = static_cast<std::int32_t>(edges.step_y[k]);
      std::uint8_t rows[kTileSize];
      kernels_.cover_small(small, last_row + 1, rows);
      for (int row = 0; row <= last_row; ++row) {
        const unsigned inside = rows[row] & ((2u << last_column) - 1);  // one span: a triangle is convex
        if (inside != 0) write(std::countr_zero(inside), static_cast<int>(std::bit_width(inside)) - 1, row);
      }
    } else {
      double reciprocal[3];
      for (std::size_t k = 0; k < 3; ++k) reciprocal[k] = 1 / static_cast<double>(edges.step_x[k]);  // unused where infinite
      for (int row = 0; row <= last_row; ++row) {
        int first = 0, last = last_column;
        for (std::size_t k = 0; k < 3; ++k) clip_span(biased_[k] + row * edges.step_y[k], edges.step_x[k], reciprocal[k], first, last);
        if (first <= last) write(first, last, row);
      }
    }
  }

 private:
  // With |dx|, |dy| and |step_x| / 2^11 of at most 2^14 sub-texels: over the triangle's box an edge function is below 2·2^28, and 8 columns
  // more add 8·2^25. Rows need no bound of their own: a box of three columns or more, at most 2^14 wide, has texels of at most 2^13.
  static bool is_small(const TileEdges& edges) {
    std::int64_t most = 0;
    for (std::size_t k = 0; k < 3; ++k)
      most = std::max({most, std::abs(edges.dx[k]), std::abs(edges.dy[k]), std::abs(edges.step_x[k]) >> 11});
    return most <= 1 << 14;
  }

  void narrow_span(const TileEdges& edges, int row, int& first, int& last) const {
    const std::int64_t at[3] = {biased_[0] + row * edges.step_y[0], biased_[1] + row * edges.step_y[1], biased_[2] + row * edges.step_y[2]};
    const auto inside = [&](int column) {
      return ((at[0] + column * edges.step_x[0]) | (at[1] + column * edges.step_x[1]) | (at[2] + column * edges.step_x[2])) >= 0;
    };
    while (first <= last && !inside(first)) ++first;
    while (last > first && !inside(last)) --last;
  }

  void write_span(const TileEdges& edges, int first, int last, int row, std::uint32_t slot, const DepthPlane* plane) {
    const int lanes = last - first + 1;
    const int at = (edges.row0 + row) * kTileSize + edges.column0 + first;
    if (plane == nullptr) return void(std::fill_n(samples_.slot + at, lanes, slot));
    const float* const candidate = candidate_;
    plane->span(first, row, lanes, kernels_, candidate_, counters_);
    if (!frame_.state.depth_test) {
      std::fill_n(samples_.slot + at, lanes, slot);
      std::copy_n(candidate, lanes, samples_.depth + at);
    } else if (needs_.runner_up) {
      for (int n = 0; n < lanes; ++n) test_with_runner_up(candidate[n], at + n, slot);
    } else if (lanes <= kShort) {
      for (int n = 0; n < lanes; ++n)
        if (candidate[n] < samples_.depth[at + n]) samples_.depth[at + n] = candidate[n], samples_.slot[at + n] = slot;
    } else {
      kernels_.depth_test(candidate, lanes, slot, samples_.depth + at, samples_.slot + at);
    }
  }

  void test_with_runner_up(float depth, int at, std::uint32_t slot) {
    const bool drawn = samples_.slot[at] != kNoSlot;
    if (depth < samples_.depth[at]) {
      if (drawn) samples_.runner_up[at] = samples_.depth[at];
      samples_.slot[at] = slot, samples_.depth[at] = depth;
    } else if (drawn && depth < 1 && depth < samples_.runner_up[at]) {
      samples_.runner_up[at] = depth;
    }
  }

  const DrawList& list_;
  const Frame& frame_;
  const Tile& tile_;
  SampleNeeds needs_;
  const Kernels& kernels_;
  TileSamples& samples_;
  EvaluationCounters& counters_;
  std::array<std::int64_t, 3> biased_{};
  alignas(64) float candidate_[kTileSize];
};

}  // namespace

void find_samples(const DrawList& list, const Frame& frame, const Tile& tile, const std::uint32_t* ids, std::size_t count,
                  SampleNeeds needs, const Kernels& kernels, TileSamples& samples, EvaluationCounters& counters) {
  const auto texels = static_cast<std::size_t>(tile.height) * kTileSize;
  std::fill_n(samples.slot, texels, kNoSlot);
  if (needs.depth) std::fill_n(samples.depth, texels, 1.0f);
  if (needs.runner_up) std::fill_n(samples.runner_up, texels, std::numeric_limits<float>::infinity());
  SampleFinder finder(list, frame, tile, needs, kernels, samples, counters);
  // A tile's triangles may lie anywhere in the list: asked for early, their corners first and then those vertices.
  constexpr std::size_t kAhead = 16;
  for (std::size_t n = 0; n < count; ++n) {
    if (n + 2 * kAhead < count) __builtin_prefetch(&list.triangles[ids[n + 2 * kAhead]]);
    if (n + kAhead < count)
      for (const std::uint32_t corner : list.triangles[ids[n + kAhead]]) {  // a vertex may lie in two cache lines
        __builtin_prefetch(&list.vertices[corner]);
        __builtin_prefetch(reinterpret_cast<const std::byte*>(&list.vertices[corner] + 1) - 1);
      }
    finder.draw(ids[n], static_cast<std::uint32_t>(n));
  }
}

}  // namespace etalon::raster::fast
