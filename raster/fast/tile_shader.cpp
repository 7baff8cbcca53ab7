#include "raster/fast/tile_shader.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <memory>

namespace etalon::raster::fast {
namespace {

// So many texels of one triangle are shaded by themselves: numbers of one triangle are loaded once, those of several gathered.
constexpr int kLongRun = 16;

// A triangle that some texel of the tile shows.
struct VisibleTriangle {
  std::uint32_t id;
  const Draw* draw;
};

// One row's consecutive texels of one draw.
struct Run {
  int column, row, lanes;
  const Draw* draw;
};

class TileShader {
 public:
  TileShader(const RunContext& context, const Tile& tile, std::span<const std::uint32_t> ids, std::vector<Image>& images)
      : context_(context), tile_(tile), ids_(ids), images_(images), values_(context) {
    const Frame& frame = context.frame;
    needs_.depth = frame.state.depth_test;
    for (const TargetSpec& target : frame.targets) {
      needs_.depth |= target.content == TargetContent::depth || target.content == TargetContent::margins;
      needs_.runner_up |= frame.state.depth_test && target.content == TargetContent::margins;
    }
  }

  EvaluationCounters draw() {
    if (ids_.empty()) {
      for (int row = 0; row < tile_.height; ++row) clear(0, row, tile_.width);
      return counters_;
    }
    find_samples(context_.list, context_.frame, tile_, ids_.data(), ids_.size(), needs_, context_.kernels, samples_, counters_);
    collect_visible();
    for (int row = 0; row < tile_.height; ++row) shade_row(row);
    return counters_;
  }

 private:
  // Replaces the slots by indices into visible_, in order of first appearance, and makes the planes.
  void collect_visible() {
    std::vector<std::uint32_t> index_of(ids_.size(), kNoSlot);
    for (int row = 0; row < tile_.height; ++row) {
      std::uint32_t* const slots = samples_.slot + row * kTileSize;
      for (int column = 0; column < tile_.width;) {
        const std::uint32_t slot = slots[column];
        const int equal = equal_run(slots + column, tile_.width - column);
        if (slot != kNoSlot) {
          std::uint32_t& index = index_of[slot];
          if (index == kNoSlot) index = add_visible(ids_[slot]);
          if (index != slot) std::fill_n(slots + column, equal, index);
        }
        column += equal;
      }
    }
    planes_.resize(visible_.size() * static_cast<std::size_t>(context_.layout.stride()));
    const PlaneTile plane_tile = {tile_.x0, tile_.y0, tile_.width, tile_.height};
    for (std::size_t n = 0; n < visible_.size(); ++n)
      perspective_ |= make_planes(context_.list, visible_[n].id, context_.frame, plane_tile, context_.layout,
                                  planes_.data() + n * static_cast<std::size_t>(context_.layout.stride()));
  }

  std::uint32_t add_visible(std::uint32_t id) {
    const Draw* draw = visible_.empty() ? nullptr : visible_.back().draw;
    if (draw == nullptr || id - draw->first_triangle >= draw->triangle_count) draw = &context_.list.draw_of(id);
    visible_.push_back({id, draw});
    return static_cast<std::uint32_t>(visible_.size() - 1);
  }

  // Runs of one value are mostly one texel or a whole row long.
  [[nodiscard]] int equal_run(const std::uint32_t* numbers, int count) const {
    return count == 1 || numbers[1] != numbers[0] ? 1 : context_.kernels.equal_run(numbers, count);
  }

  void shade_row(int row) {
    const std::uint32_t* const index = samples_.slot + row * kTileSize;
    for (int column = 0; column < tile_.width;) {
      int end = column + equal_run(index + column, tile_.width - column);
      if (index[column] == kNoSlot) {
        clear(column, row, end - column);
      } else {
        const Draw* const draw = visible_[index[column]].draw;
        bool uniform = true;
        const bool alone = end - column >= kLongRun;
        while (!alone && end < tile_.width && index[end] != kNoSlot && visible_[index[end]].draw == draw) {
          const int equal = equal_run(index + end, tile_.width - end);
          if (equal >= kLongRun) break;  // a run of its own
          end += equal, uniform = false;
        }
        shade({column, row, end - column, draw}, uniform);
      }
      column = end;
    }
  }

  void shade(const Run& run, bool uniform) {
    const std::uint32_t* const index = samples_.slot + run.row * kTileSize + run.column;
    const auto stride = static_cast<std::int64_t>(context_.layout.stride());
    offset_.at[0] = index[0] * stride;
    if (!uniform) {
      for (int n = 1; n < run.lanes; ++n) offset_.at[n] = index[n] * stride;
      std::fill(offset_.at + run.lanes, offset_.at + kRunLanes, offset_.at[0]);  // lanes behind the run are computed too
    }
    if (stride > kFirstPlane) values_.begin({planes_.data(), &offset_, uniform, perspective_}, run.lanes, run.column, run.row);
    for (std::size_t n = 0; n < images_.size(); ++n) shade_target(run, index, n);
  }

  void shade_target(const Run& run, const std::uint32_t* index, std::size_t n) {
    const TargetSpec& target = context_.frame.targets[n];
    std::byte* const texels = images_[n].texel(tile_.x0 + run.column, tile_.y0 + run.row);
    LaneMask undecided = 0;
    switch (target.content) {
      case TargetContent::color: undecided = values_.store_color(*run.draw, target, texels); break;
      case TargetContent::coordinate: undecided = values_.store_coordinate(target, texels); break;
      case TargetContent::barycentrics: undecided = values_.store_barycentrics(target, texels); break;
      case TargetContent::triangle_id:
        for (int lane = 0; lane < run.lanes; ++lane) std::memcpy(texels + 4 * lane, &visible_[index[lane]].id, 4);
        break;
      case TargetContent::depth:
        std::memcpy(texels, samples_.depth + run.row * kTileSize + run.column, sizeof(float) * static_cast<std::size_t>(run.lanes));
        break;
      case TargetContent::margins:
      case TargetContent::bound_terms: undecided = run.lanes == kRunLanes ? ~LaneMask{0} : (LaneMask{1} << run.lanes) - 1; break;
    }
    counters_.values += static_cast<std::uint64_t>(run.lanes) * static_cast<std::uint64_t>(target.format.channels);
    counters_.scalar += static_cast<std::uint64_t>(std::popcount(undecided)) * static_cast<std::uint64_t>(target.format.channels);
    const auto texel_bytes = static_cast<std::ptrdiff_t>(bytes_per_texel(target.format));
    for (; undecided != 0; undecided &= undecided - 1) {
      const int lane = std::countr_zero(undecided);
      store_alone(run, index[lane], lane, target, texels + lane * texel_bytes);
    }
  }

  void store_alone(const Run& run, std::uint32_t index, int lane, const TargetSpec& target, std::byte* texel) {
    const std::uint32_t id = visible_[index].id;
    if (id != current_) setup_ = make_triangle_setup(context_.list, id, context_.frame), current_ = id;
    SampleDepth depth;
    const int at = run.row * kTileSize + run.column + lane;
    if (needs_.depth) depth.stored = samples_.depth[at];
    // The difference rounds to the right float32: see docs/contract.md#targets on the depth gap.
    depth.gap = needs_.runner_up ? static_cast<float>(static_cast<double>(samples_.runner_up[at]) - samples_.depth[at])
                                 : std::numeric_limits<float>::infinity();
    EvaluationCounters plain;
    store_target(context_.list, *run.draw, context_.frame, target, setup_, id, tile_.x0 + run.column + lane, tile_.y0 + run.row, depth,
                 Evaluation::filtered, texel, plain);
    counters_.exact_path += plain.exact_path;
  }

  void clear(int column, int row, int lanes) {
    for (std::size_t n = 0; n < images_.size(); ++n) {
      const std::vector<std::byte>& texel = context_.clear[n];
      std::byte* const texels = images_[n].texel(tile_.x0 + column, tile_.y0 + row);
      for (int lane = 0; lane < lanes; ++lane)
        std::memcpy(texels + static_cast<std::size_t>(lane) * texel.size(), texel.data(), texel.size());
    }
  }

  const RunContext& context_;
  const Tile& tile_;
  std::span<const std::uint32_t> ids_;
  std::vector<Image>& images_;
  SampleNeeds needs_;
  EvaluationCounters counters_;
  TileSamples samples_;
  std::vector<VisibleTriangle> visible_;
  std::vector<double> planes_;
  bool perspective_ = false;
  RunValues values_;
  OffsetLanes offset_{};
  std::uint32_t current_ = kNoTriangle;  ///< whose setup setup_ is
  TriangleSetup setup_;
};

}  // namespace

EvaluationCounters draw_tile(const RunContext& context, const Tile& tile, std::span<const std::uint32_t> ids, std::vector<Image>& images) {
  return std::make_unique<TileShader>(context, tile, ids, images)->draw();  // too large for every thread's stack
}

}  // namespace etalon::raster::fast
