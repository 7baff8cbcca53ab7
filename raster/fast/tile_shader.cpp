#include "raster/fast/tile_shader.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <memory>

#include "raster/fast/exact_planes.h"

namespace etalon::raster::fast {
namespace {

// So many texels of one triangle are shaded by themselves: numbers of one triangle are loaded once, those of several gathered.
constexpr int kLongRun = 16;
constexpr std::uint32_t kNotVisible = 0xFFFFFFFFu;

// A triangle that some texel of the tile shows.
struct VisibleTriangle {
  const Draw* draw;
  bool perspective;
  bool exact_tried = false;
};

// One row's consecutive texels of one draw.
struct Run {
  int column, row, lanes;
  const Draw* draw;
  const std::uint32_t* slots;
  bool uniform, perspective;
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
    index_of_.assign(ids_.size(), kNotVisible);
    const std::size_t likely = std::min<std::size_t>(ids_.size(), kTileSize * kTileSize / 8);
    visible_.reserve(likely), planes_.reserve(likely * static_cast<std::size_t>(context_.layout.stride()));
    for (int row = 0; row < tile_.height; ++row) shade_row(row);
    return counters_;
  }

 private:
  // Runs of one value are mostly a few texels or a whole row long.
  [[nodiscard]] int equal_run(const std::uint32_t* numbers, int count) const {
    const int near = std::min(count, 8);
    for (int n = 1; n < near; ++n)
      if (numbers[n] != numbers[0]) return n;
    return near == count ? count : context_.kernels.equal_run(numbers, count);
  }

  // The triangle of a slot, its planes made when the first texel shows it.
  std::uint32_t visible_index(std::uint32_t slot) {
    std::uint32_t& index = index_of_[slot];
    if (index != kNotVisible) return index;
    const std::uint32_t id = ids_[slot];
    const Draw* draw = visible_.empty() ? nullptr : visible_.back().draw;
    if (draw == nullptr || id - draw->first_triangle >= draw->triangle_count) draw = &context_.list.draw_of(id);
    const std::size_t at = planes_.size();
    planes_.resize(at + static_cast<std::size_t>(context_.layout.stride()));
    const bool perspective = make_planes(context_.list, id, context_.frame, tile_, context_.layout, planes_.data() + at);
    visible_.push_back({draw, perspective});
    return index = static_cast<std::uint32_t>(visible_.size() - 1);
  }

  void shade_row(int row) {
    const std::uint32_t* const slots = samples_.slot + row * kTileSize;
    for (int column = 0; column < tile_.width;) {
      int equal = equal_run(slots + column, tile_.width - column);
      if (slots[column] == kNoSlot) {
        clear(column, row, equal);
        column += equal;
        continue;
      }
      Run run = {column, row, 0, nullptr, slots + column, true, false};
      while (append(run, equal) && equal < kLongRun && column + run.lanes < tile_.width && slots[column + run.lanes] != kNoSlot) {
        equal = equal_run(slots + column + run.lanes, tile_.width - column - run.lanes);
        if (equal >= kLongRun) break;  // a run of its own
      }
      shade(run);
      column += run.lanes;
    }
  }

  // Takes the next `lanes` texels, which show one triangle, into the run; false, and nothing taken, where they are of another draw.
  bool append(Run& run, int lanes) {
    const std::uint32_t index = visible_index(run.slots[run.lanes]);
    const VisibleTriangle& triangle = visible_[index];
    if (run.draw == nullptr) run.draw = triangle.draw;
    if (triangle.draw != run.draw) return false;
    std::fill_n(offset_.at + run.lanes, lanes, static_cast<std::int64_t>(index) * context_.layout.stride());
    run.uniform = run.lanes == 0;
    run.lanes += lanes;
    run.perspective |= triangle.perspective;
    return true;
  }

  void shade(const Run& run) {
    for (int n = run.lanes; n % 8 != 0; ++n) offset_.at[n] = offset_.at[0];  // the last vector's lanes behind the run are computed too
    if (context_.layout.stride() > kFirstPlane)
      values_.begin({planes_.data(), &offset_, run.uniform, run.perspective}, run.lanes, run.column, run.row);
    for (std::size_t n = 0; n < images_.size(); ++n) shade_target(run, n);
  }

  void shade_target(const Run& run, std::size_t n) {
    const TargetSpec& target = context_.frame.targets[n];
    std::byte* const texels = images_[n].texel(tile_.x0 + run.column, tile_.y0 + run.row);
    LaneMask undecided = store_run(run, target, texels);
    if (undecided != 0 && make_exact(run, undecided, target)) undecided = store_run(run, target, texels);
    counters_.values += static_cast<std::uint64_t>(run.lanes) * static_cast<std::uint64_t>(target.format.channels);
    if (undecided == 0) return;
    counters_.scalar += static_cast<std::uint64_t>(std::popcount(undecided)) * static_cast<std::uint64_t>(target.format.channels);
    const auto texel_bytes = static_cast<std::ptrdiff_t>(bytes_per_texel(target.format));
    for (; undecided != 0; undecided &= undecided - 1) {
      const int lane = std::countr_zero(undecided);
      store_alone(run, lane, target, texels + lane * texel_bytes);
    }
  }

  // Bytes of a target's texels, and the lanes where they are not decided.
  LaneMask store_run(const Run& run, const TargetSpec& target, std::byte* texels) {
    LaneMask undecided = 0;
    switch (target.content) {
      case TargetContent::color: undecided = values_.store_color(*run.draw, target, texels); break;
      case TargetContent::coordinate: undecided = values_.store_coordinate(target, texels); break;
      case TargetContent::barycentrics: undecided = values_.store_barycentrics(target, texels); break;
      case TargetContent::triangle_id:
        for (int lane = 0; lane < run.lanes; ++lane) std::memcpy(texels + 4 * lane, &ids_[run.slots[lane]], 4);
        break;
      case TargetContent::depth:
        std::memcpy(texels, samples_.depth + run.row * kTileSize + run.column, sizeof(float) * static_cast<std::size_t>(run.lanes));
        break;
      case TargetContent::margins: {
        FloatLanes gap;
        for (int lane = 0; lane < run.lanes; ++lane) gap.at[lane] = depth_at(run, lane).gap;
        undecided = values_.store_margins(*run.draw, gap, texels) & lanes_of(run);
        break;
      }
      case TargetContent::bound_terms: undecided = lanes_of(run); break;
    }
    return undecided;
  }

  // Undecided texel choices may be true ties, which exact planes decide; each triangle is tried once. Targets stored before and after it
  // agree: both planes enclose the same numbers.
  bool make_exact(const Run& run, LaneMask undecided, const TargetSpec& target) {
    const bool looks_up = target.content == TargetContent::color || target.content == TargetContent::margins;
    if (!looks_up || run.draw->shading == Shading::vertex_color) return false;
    bool some = false;
    for (; undecided != 0; undecided &= undecided - 1) {
      const std::uint32_t slot = run.slots[std::countr_zero(undecided)];
      VisibleTriangle& triangle = visible_[index_of_[slot]];
      if (triangle.exact_tried) continue;
      triangle.exact_tried = true;
      double* const planes =
          planes_.data() + static_cast<std::size_t>(index_of_[slot]) * static_cast<std::size_t>(context_.layout.stride());
      some |= make_uv_planes_exact(context_.list, ids_[slot], context_.frame, tile_, context_.layout, planes);
    }
    if (some) values_.begin({planes_.data(), &offset_, run.uniform, run.perspective}, run.lanes, run.column, run.row);
    return some;
  }

  void store_alone(const Run& run, int lane, const TargetSpec& target, std::byte* texel) {
    const std::uint32_t id = ids_[run.slots[lane]];
    if (id != current_) setup_ = make_triangle_setup(context_.list, id, context_.frame), current_ = id;
    // An affine triangle's gradients are the same at every sample.
    const bool constant = target.content == TargetContent::bound_terms && setup_.affine;
    if (constant && id == bound_terms_of_) return void(std::memcpy(texel, bound_terms_, sizeof bound_terms_));
    EvaluationCounters plain;
    store_target(context_.list, *run.draw, context_.frame, target, setup_, id, tile_.x0 + run.column + lane, tile_.y0 + run.row,
                 depth_at(run, lane), Evaluation::filtered, texel, plain);
    counters_.narrow += plain.narrow, counters_.exact_path += plain.exact_path;
    if (constant) std::memcpy(bound_terms_, texel, sizeof bound_terms_), bound_terms_of_ = id;
  }

  [[nodiscard]] static LaneMask lanes_of(const Run& run) { return run.lanes == kRunLanes ? ~LaneMask{0} : (LaneMask{1} << run.lanes) - 1; }

  [[nodiscard]] SampleDepth depth_at(const Run& run, int lane) const {
    const int at = run.row * kTileSize + run.column + lane;
    // A difference of two float32 in [0, 1] is exact in double unless their exponents differ by more than 29, where it still rounds to
    // the same float32: then the smaller is below 2^-29 of the larger and float32 keeps 24 bits of a number just below a float32.
    return {needs_.depth ? samples_.depth[at] : 1.0f,
            needs_.runner_up ? static_cast<float>(static_cast<double>(samples_.runner_up[at]) - samples_.depth[at])
                             : std::numeric_limits<float>::infinity()};
  }

  void clear(int column, int row, int lanes) {
    for (std::size_t n = 0; n < images_.size(); ++n) {
      const auto texel_bytes = static_cast<std::size_t>(bytes_per_texel(context_.frame.targets[n].format));
      std::memcpy(images_[n].texel(tile_.x0 + column, tile_.y0 + row), context_.clear_row[n].data(),
                  static_cast<std::size_t>(lanes) * texel_bytes);
    }
  }

  const RunContext& context_;
  const Tile& tile_;
  std::span<const std::uint32_t> ids_;
  std::vector<Image>& images_;
  SampleNeeds needs_;
  EvaluationCounters counters_;
  TileSamples samples_;
  std::vector<std::uint32_t> index_of_;  ///< per slot, into visible_
  std::vector<VisibleTriangle> visible_;
  std::vector<double> planes_;
  RunValues values_;
  OffsetLanes offset_{};
  std::uint32_t current_ = kNoTriangle;  ///< whose setup setup_ is
  TriangleSetup setup_;
  std::uint32_t bound_terms_of_ = kNoTriangle;  ///< whose bound_terms_ are
  std::byte bound_terms_[2 * sizeof(float)];
};

}  // namespace

EvaluationCounters draw_tile(const RunContext& context, const Tile& tile, std::span<const std::uint32_t> ids, std::vector<Image>& images) {
  return std::make_unique<TileShader>(context, tile, ids, images)->draw();  // too large for every thread's stack
}

}  // namespace etalon::raster::fast
