#include "tests/validation/reference/fast_subject.h"

#include <fmt/format.h>

#include <cstring>

#include "core/base/error.h"
#include "core/base/float_environment.h"
#include "raster/cpu_renderer.h"
#include "raster/fast/tile_shader.h"

namespace etalon::validation::reference {

namespace {

constexpr int kColumns = 8;

// A triangle alone, moved by whole texels so that the row in question is a frame of its own: a move that changes no exact number.
class FastSubject final : public SampleSubject {
 public:
  FastSubject(const DrawList& list, const Frame& frame) : list_(list), row_frame_(frame) {
    row_frame_.width = kColumns, row_frame_.height = 1;
    row_frame_.state.depth_test = false;  // visible whatever its depth
    row_frame_.targets.push_back({TargetContent::triangle_id, kR32ui, {}});
    alone_.images = list.images;
    alone_.vertices.resize(3);
    alone_.triangles = {{0, 1, 2}};
    alone_.draws.resize(1);
    const std::vector<double> largest = raster::fast::largest_texels(list);
    for (const raster::SimdLevel level : raster::available_simd_levels()) {
      raster::fast::RunContext context = {
          alone_, row_frame_, *raster::fast::kernels_for(level), raster::fast::plane_layout(list, row_frame_), largest, {}};
      for (const TargetSpec& target : row_frame_.targets)
        context.clear_row.emplace_back(static_cast<std::size_t>(raster::kTileSize * bytes_per_texel(target.format)), std::byte{0xFF});
      contexts_.push_back(std::move(context));
    }
    for (const TargetSpec& target : row_frame_.targets) images_.emplace_back(kColumns, 1, target.format);
  }

  bool covers(std::uint32_t t, int i, int j) const override {
    draw(t, i, j);
    return *images_.back().channels<std::uint32_t>(i - column_, 0) != kNoTriangle;
  }

  void store(std::uint32_t t, int i, int j, std::byte* const* target_bytes) const override {
    draw(t, i, j);
    for (std::size_t n = 0; n + 1 < images_.size(); ++n) {
      const TargetSpec& target = row_frame_.targets[n];
      std::memcpy(target_bytes[n], images_[n].texel(i - column_, 0), static_cast<std::size_t>(bytes_per_texel(target.format)));
      if (target.content == TargetContent::triangle_id) std::memcpy(target_bytes[n], &t, sizeof t);
    }
  }

 private:
  void draw(std::uint32_t t, int i, int j) const {
    const int column = i - i % kColumns;
    if (t == current_ && column == column_ && j == row_) return;
    current_ = t, column_ = column, row_ = j;
    const int bits = row_frame_.state.subtexel_bits;
    for (std::size_t n = 0; n < 3; ++n) {
      RasterVertex& v = alone_.vertices[n] = list_.vertices[list_.triangles[t][n]];
      v.x = static_cast<std::int32_t>(v.x - (std::int64_t{column} << bits)),
      v.y = static_cast<std::int32_t>(v.y - (std::int64_t{j} << bits));
    }
    alone_.draws[0] = list_.draw_of(t);
    alone_.draws[0].first_triangle = 0, alone_.draws[0].triangle_count = 1;
    const DefaultFloatEnvironment environment;
    constexpr std::uint32_t ids[] = {0};
    for (std::size_t level = 0; level < contexts_.size(); ++level) {
      raster::fast::draw_tile(contexts_[level], {0, 0, kColumns, 1}, ids, level == 0 ? images_ : others_);
      if (level == 0) {
        others_ = images_;
      } else if (others_ != images_) {
        throw InternalError(fmt::format("triangle {}, row {}, columns {}..{}: SIMD levels disagree", t, j, column, column + kColumns - 1));
      }
    }
  }

  const DrawList& list_;
  Frame row_frame_;
  std::vector<raster::fast::RunContext> contexts_;
  mutable DrawList alone_;
  mutable std::vector<Image> images_, others_;
  mutable std::uint32_t current_ = kNoTriangle;  // one subject serves one thread
  mutable int column_ = 0, row_ = 0;
};

}  // namespace

MakeSubject fast_subject() {
  return [](const DrawList& list, const Frame& frame) { return std::make_unique<FastSubject>(list, frame); };
}

std::vector<Image> EveryLevelRenderer::render(const DrawList& list, const Frame& frame) {
  const raster::SimdLevel before = raster::simd_level();
  raster::CpuRenderer renderer(raster::Evaluation::vectorised);
  std::vector<Image> images;
  for (const raster::SimdLevel level : raster::available_simd_levels()) {
    raster::set_simd_level(level);
    std::vector<Image> at_level = renderer.render(list, frame);
    if (!images.empty() && at_level != images) {
      raster::set_simd_level(before);
      throw InternalError("SIMD level " + raster::to_string(level) + " disagrees with those before");
    }
    images = std::move(at_level);
  }
  raster::set_simd_level(before);
  return images;
}

}  // namespace etalon::validation::reference
