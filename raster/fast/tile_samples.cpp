#include "raster/fast/tile_samples.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <limits>
#include <optional>

#include "raster/fast/depth_plane.h"

namespace etalon::raster::fast {
namespace {

// Spans at most this long are found and tested texel by texel.
constexpr int kNarrow = 2;

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

static_assert(offsetof(RasterVertex, y) == offsetof(RasterVertex, x) + sizeof(std::int32_t));  // copied together

// Margins keep a second depth, and a depth that is not tested is written as it comes: both triangle by triangle. Small triangles' steps have
// room for 11 sub-texel bits.
bool has_small_path(const Frame& frame, SampleNeeds needs) {
  return !needs.runner_up && (!needs.depth || frame.state.depth_test) && frame.state.subtexel_bits <= 11;
}

class SampleFinder {
 public:
  SampleFinder(const DrawList& list, const Frame& frame, const Tile& tile, SampleNeeds needs, const Kernels& kernels, TileSamples& samples,
               EvaluationCounters& counters)
      : list_(list), frame_(frame), tile_(tile), needs_(needs), kernels_(kernels), samples_(samples), counters_(counters) {}

  // By the kernels for small triangles; one at a time what they leave.
  void draw_batches(const std::uint32_t* ids, std::size_t count) {
    const TileFrame tile_frame = tile_frame_of(frame_, tile_);
    float* const depth = needs_.depth ? samples_.depth : nullptr;
    CornerBatch corners{};
    SmallTriangles small;
    for (std::size_t n = 0; n < count; n += kBatch) {
      const int lanes = static_cast<int>(std::min<std::size_t>(kBatch, count - n));
      // A tile's triangles may lie anywhere in the list, and neighbours of one of their corners near it.
      for (std::size_t i = n + 4 * kBatch; i < std::min(n + 5 * kBatch, count); ++i) __builtin_prefetch(&list_.triangles[ids[i]]);
      for (std::size_t i = n + 2 * kBatch; i < std::min(n + 3 * kBatch, count); ++i)
        __builtin_prefetch(&list_.vertices[list_.triangles[ids[i]][2]]);
      for (int t = 0; t < lanes; ++t) {
        const auto& corner = list_.triangles[ids[n + static_cast<std::size_t>(t)]];
        for (std::size_t k = 0; k < 3; ++k) {
          const RasterVertex& v = list_.vertices[corner[k]];
          std::memcpy(corners.xy[k] + 2 * t, &v.x, 2 * sizeof v.x);
          if (depth != nullptr) corners.z[k][t] = v.z;
        }
      }
      kernels_.set_up_small(corners, tile_frame, small);
      if (depth != nullptr && (small.empty & ((1u << lanes) - 1)) != (1u << lanes) - 1) kernels_.set_up_small_depth(corners, small);
      const auto first_slot = static_cast<std::uint32_t>(n + 1);
      for (int t = 0; t < lanes; ++t) {
        t = kernels_.draw_small(small, t, lanes, first_slot, samples_.slot, depth, counters_.values);
        if (t < lanes) draw(ids[n + static_cast<std::size_t>(t)], first_slot + static_cast<std::uint32_t>(t));
      }
    }
  }

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
    } else {
      // Edges that the whole box is inside of clip nothing.
      double reciprocal[3];
      std::size_t clipping[3], clipping_count = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int64_t least =
            biased_[k] + std::min<std::int64_t>(last_column * edges.step_x[k], 0) + std::min<std::int64_t>(last_row * edges.step_y[k], 0);
        if (least >= 0) continue;
        reciprocal[k] = 1 / static_cast<double>(edges.step_x[k]);  // unused where infinite
        clipping[clipping_count++] = k;
      }
      for (int row = 0; row <= last_row; ++row) {
        int first = 0, last = last_column;
        for (std::size_t n = 0; n < clipping_count; ++n) {
          const std::size_t k = clipping[n];
          clip_span(biased_[k] + row * edges.step_y[k], edges.step_x[k], reciprocal[k], first, last);
        }
        if (first <= last) write(first, last, row);
      }
    }
  }

 private:
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
    } else if (lanes <= kShortSpan) {
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

TileFrame tile_frame_of(const Frame& frame, const Tile& tile) {
  const RasterState& state = frame.state;
  const auto to_subtexels = [&](int texel) { return static_cast<std::int32_t>(texel) << state.subtexel_bits; };
  return {to_subtexels(tile.x0),
          to_subtexels(tile.y0),
          tile.width,
          tile.height,
          state.subtexel_bits,
          state.cull,
          state.fill_rule == FillRule::left_ymin || state.fill_rule == FillRule::left_ymax,
          state.fill_rule == FillRule::left_ymin || state.fill_rule == FillRule::right_ymin};
}

void find_samples(const DrawList& list, const Frame& frame, const Tile& tile, const std::uint32_t* ids, std::size_t count,
                  SampleNeeds needs, const Kernels& kernels, TileSamples& samples, EvaluationCounters& counters) {
  const auto texels = static_cast<std::size_t>(tile.height) * kTileSize;
  std::fill_n(samples.slot, texels, kNoSlot);
  if (needs.depth) std::fill_n(samples.depth, texels, 1.0f);
  if (needs.runner_up) std::fill_n(samples.runner_up, texels, std::numeric_limits<float>::infinity());
  SampleFinder finder(list, frame, tile, needs, kernels, samples, counters);
  if (has_small_path(frame, needs)) {
    finder.draw_batches(ids, count);
  } else {
    for (std::size_t n = 0; n < count; ++n) finder.draw(ids[n], static_cast<std::uint32_t>(n + 1));
  }
}

}  // namespace etalon::raster::fast
