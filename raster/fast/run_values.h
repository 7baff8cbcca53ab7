// Values of one run of texels by the vector kernels: what a draw's shading gives each lane, and its way into a target.
#pragma once

#include <cstddef>
#include <vector>

#include "core/draw/draw_list.h"
#include "raster/fast/kernels.h"
#include "raster/fast/planes.h"

namespace etalon::raster::fast {

/// The planes a frame's targets need for the draws of a list.
[[nodiscard]] PlaneLayout plane_layout(const DrawList& list, const Frame& frame);

/// Largest magnitude among an image's texels, as far as linear lookups need it (1 for the bounded formats); indexed like list.images.
[[nodiscard]] std::vector<double> largest_texels(const DrawList& list);

/// What one render shares among its tiles.
struct RunContext {
  const DrawList& list;
  const Frame& frame;
  const Kernels& kernels;
  PlaneLayout layout;
  std::vector<double> largest;                    ///< largest_texels()
  std::vector<std::vector<std::byte>> clear_row;  ///< per target, a tile's row where nothing is drawn
};

class RunValues {
 public:
  explicit RunValues(const RunContext& context) : context_(context) {}

  /// Begins a tile, whose triangles have these planes.
  void begin_tile(const double* planes, bool perspective) {
    triangles_.planes = planes, triangles_.stride = context_.layout.stride(), triangles_.perspective = perspective;
  }
  /// Begins a run of `lanes` texels from (column, row) of the tile on, with their triangles' numbers.
  void begin(const std::uint32_t* numbers, bool uniform, int lanes, int column, int row) {
    triangles_.number = numbers, triangles_.uniform = uniform;
    lanes_ = lanes, column_ = column, row_ = row, has_positions_ = false, has_uv_ = false;
  }

  /// Write a target's texels; the lanes of the mask are not decided and hold unspecified bytes.
  [[nodiscard]] LaneMask store_color(const Draw& draw, const TargetSpec& target, std::byte* texels);
  [[nodiscard]] LaneMask store_coordinate(const TargetSpec& target, std::byte* texels);
  [[nodiscard]] LaneMask store_barycentrics(const TargetSpec& target, std::byte* texels);
  /// `gap`: to the runner-up, per lane.
  [[nodiscard]] LaneMask store_margins(const Draw& draw, const FloatLanes& gap, std::byte* texels);

 private:
  const Positions& positions();
  void evaluate(PlaneAttribute a, Values& result);
  LaneMask store_planes(PlaneAttribute first, const TargetSpec& target, std::byte* texels);
  LaneMask store_values(const TargetSpec& target, std::byte* texels);
  void interpolate_uv();
  LaneMask nearest(const Image& image, const Sampler& sampler);
  LaneMask copy_nearest(const Image& image, const Sampler& sampler, PixelFormat target, std::byte* texels);
  LaneMask linear_pairs(const Image& image, const Sampler& sampler, double largest, std::byte* texels);
  LaneMask linear(const Image& image, const Sampler& sampler);
  LaneMask look_up(const Image& image, const Sampler& sampler, double largest, int channels);
  void interpolate(const Image& image, double largest, int channels);
  LaneMask through_map(const Draw& draw);

  const RunContext& context_;
  RunTriangles triangles_{};
  int lanes_ = 0, column_ = 0, row_ = 0;
  bool has_positions_ = false;  ///< positions_ are the run's
  bool has_uv_ = false;         ///< uv_ holds the run's interpolated uv
  Positions positions_{};
  Values uv_[2]{};          ///< the triangles' coordinates
  Values coordinate_[2]{};  ///< those of the lookup at hand
  Values value_[4]{};
  LinearAxis axis_[2]{};
  DoubleLanes index_[2]{};
  DoubleLanes texel_[4]{};
  IntLanes offset_[4]{};
  IntLanes integer_[4]{};
  FloatLanes float_[4]{};
};

}  // namespace etalon::raster::fast
