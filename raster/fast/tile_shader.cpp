#include "raster/fast/tile_shader.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <memory>

#include "raster/fast/exact_planes.h"
#include "raster/fast/visible_triangles.h"

namespace etalon::raster::fast {
namespace {

// So many texels of one triangle are shaded by themselves: numbers of one triangle are loaded once, those of several gathered.
constexpr int kLongRun = 16;

// One row's consecutive texels of one draw.
struct Run {
  int column, row, lanes;
  const Draw* draw;
  const std::uint32_t* numbers;  ///< of the texels' triangles
  bool uniform;                  ///< all of one
};

class TileShader {
 public:
  TileShader(const RunContext& context, const Tile& tile, std::span<const std::uint32_t> ids, std::vector<Image>& images,
             std::vector<CoveredRun>* covered)
      : context_(context), tile_(tile), ids_(ids), images_(images), covered_(covered), values_(context) {
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
    visible_.find(context_.list, tile_, samples_, ids_, context_.kernels);
    visible_.make_planes(context_.list, context_.frame, tile_, context_.layout, context_.kernels);
    values_.begin_tile(visible_.planes.get(), visible_.perspective);
    exact_tried_.assign(visible_.id.size(), false);
    for (int row = 0; row < tile_.height; ++row) shade_row(row);
    return counters_;
  }

 private:
  void shade_row(int row) {
    const std::uint32_t* const numbers = visible_.number + row * kTileSize;
    for (int column = 0; column < tile_.width;) {
      const int rest = tile_.width - column;
      if (numbers[column] == 0) {
        const int lanes = context_.kernels.equal_run(numbers + column, rest);
        clear(column, row, lanes);
        column += lanes;
      } else {
        const int end = column + of_one_draw(numbers + column, context_.kernels.nonzero_run(numbers + column, rest));
        while (column < end) {
          const Run run = next_run(column, row, end);
          shade(run);
          column += run.lanes;
        }
      }
    }
  }

  [[nodiscard]] int of_one_draw(const std::uint32_t* numbers, int count) const {
    if (context_.list.draws.size() == 1) return count;
    int n = 1;
    while (n < count && visible_.draw[numbers[n]] == visible_.draw[numbers[0]]) ++n;
    return n;
  }

  // A long run of one triangle, or what comes before the next one.
  [[nodiscard]] Run next_run(int column, int row, int end) const {
    const std::uint32_t* const numbers = visible_.number + row * kTileSize + column;
    const int most = end - column;
    const auto equal_from = [&](int n) {
      if (n + kLongRun > most || numbers[n] != numbers[n + kLongRun - 1]) return 0;
      const int equal = context_.kernels.equal_run(numbers + n, most - n);
      return equal >= kLongRun ? equal : 0;
    };
    int lanes = equal_from(0);
    bool uniform = lanes > 0;
    if (!uniform) {
      lanes = std::min(kLongRun, most);
      while (lanes < most && equal_from(lanes) == 0) lanes = std::min(lanes + kLongRun, most);
      uniform = numbers[0] == numbers[lanes - 1] && context_.kernels.equal_run(numbers, lanes) == lanes;
    }
    return {column, row, lanes, visible_.draw[*numbers], numbers, uniform};
  }

  void shade(const Run& run) {
    if (covered_ != nullptr) covered_->push_back({tile_.x0 + run.column, tile_.y0 + run.row, run.lanes});
    begin(run);
    for (std::size_t n = 0; n < images_.size(); ++n) shade_target(run, n);
  }

  void begin(const Run& run) { values_.begin(run.numbers, run.uniform, run.lanes, run.column, run.row); }

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
        for (int lane = 0; lane < run.lanes; ++lane) std::memcpy(texels + 4 * lane, &visible_.id[run.numbers[lane]], 4);
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
      const std::uint32_t number = run.numbers[std::countr_zero(undecided)];
      if (exact_tried_[number]) continue;
      exact_tried_[number] = true;
      double* const planes = visible_.planes.get() + static_cast<std::ptrdiff_t>(number) * context_.layout.stride();
      some |= make_uv_planes_exact(context_.list, visible_.id[number], context_.frame, tile_, context_.layout, planes);
    }
    if (some) begin(run);
    return some;
  }

  void store_alone(const Run& run, int lane, const TargetSpec& target, std::byte* texel) {
    const std::uint32_t id = visible_.id[run.numbers[lane]];
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
    if (covered_ != nullptr) return;
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
  std::vector<CoveredRun>* covered_;
  SampleNeeds needs_;
  EvaluationCounters counters_;
  TileSamples samples_;
  VisibleTriangles visible_;
  std::vector<bool> exact_tried_;  ///< by number
  RunValues values_;
  std::uint32_t current_ = kNoTriangle;  ///< whose setup setup_ is
  TriangleSetup setup_;
  std::uint32_t bound_terms_of_ = kNoTriangle;  ///< whose bound_terms_ are
  std::byte bound_terms_[2 * sizeof(float)];
};

}  // namespace

EvaluationCounters draw_tile(const RunContext& context, const Tile& tile, std::span<const std::uint32_t> ids, std::vector<Image>& images,
                             std::vector<CoveredRun>* covered) {
  return std::make_unique<TileShader>(context, tile, ids, images, covered)->draw();  // too large for every thread's stack
}

}  // namespace etalon::raster::fast
