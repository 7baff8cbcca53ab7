// What a device does with the freedoms that an API leaves it, measured by drawing (docs/probe.md says how each experiment can fail).
// Takes: a Renderer that draws a list as it stands: positions of up to 16 sub-texel bits, which the device brings to its own grid itself
// (gpu::UncheckedRenderer, or a simulated device). Only what is drawn counts; what the device says of itself is not asked.
// Does not: multisampling, mipmaps, clipping, sRGB, wrap modes.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "core/draw/renderer.h"
#include "validation/bounds.h"

namespace etalon::validation {

/// Where the edges of triangles are: the exact rasterizer draws the same triangles under each of 16 grids, 5 roundings and 4 fill rules.
struct CoverageFinding {
  std::uint64_t triangles = 0, texels = 0;  ///< drawn by the device and compared
  /// What all descriptions that give the device's ids in every texel have in common; nothing where none does, or where they disagree.
  std::optional<int> subtexel_bits;  ///< 1..16; 16: 16 or more, no snapping seen
  std::optional<SnapRounding> snap;  ///< nothing also on a grid of 16 bits
  std::optional<FillRule> fill_rule;
  std::uint64_t differing = 0;  ///< texels in which the description that comes nearest differs; 0 where one is exact
  int nearest_bits = 0;         ///< that description
  SnapRounding nearest_snap = SnapRounding::nearest_even;
  FillRule nearest_rule = FillRule::left_ymin;
  [[nodiscard]] bool exact() const { return triangles > 0 && differing == 0; }
};

/// |device − exact| of interpolated numbers over the bound of docs/bounds.md for factor 1, largest.
struct InterpolationFinding {
  std::uint64_t samples = 0;    ///< that had a useful bound
  std::uint64_t unbounded = 0;  ///< that had none
  double affine = 0, perspective = 0, depth = 0;
  [[nodiscard]] double largest() const;
};

/// From where on the sampler takes the next texel, coordinates being exact float32 numbers.
struct NearestFinding {
  bool steps = false;             ///< every border was one step from one texel to the next
  double earliest_texel = 0;      ///< of all borders: where the texel changed, less where it should, texels
  double latest_texel = 0;        ///< both are multiples of 2^-15
  std::optional<int> fixed_bits;  ///< B where every border is 2^-(B+1) early: coordinates rounded to B fractional bits
};

/// The bilinear filter, for one texture format.
struct LinearFinding {
  std::optional<int> weight_bits;   ///< B where weights change at multiples of 2^-B only; nothing: at least 16
  bool weights_rounded = false;     ///< with weight_bits: changes lie half-way between the multiples, else on them
  double largest_weight_error = 0;  ///< |weight − exact|, texels
  int levels_of_small_step = 0;  ///< different results between two texels that are one byte apart: 2 where results are bytes (unorm8 only)
  double largest_value_error = 0;     ///< of random lookups among texels of 0 to 1 (bytes) or 1/2 to 1 (floats)
  double value_error_over_model = 0;  ///< what of it docs/bounds.md with weights of weight_bits leaves over; floats: relative
};

/// How exact numbers are stored.
struct StorageFinding {
  std::optional<HalfRounding> half;    ///< nothing where some value is rounded by neither rule
  std::uint64_t half_values = 0;       ///< stored
  std::optional<bool> unorm8_nearest;  ///< true: nearest; false: toward zero; nothing: neither
};

struct ProbeFindings {
  CoverageFinding coverage;
  InterpolationFinding interpolation;
  NearestFinding nearest;
  LinearFinding linear_unorm8, linear_float32;
  StorageFinding storage;
};

struct ProbeOptions {
  int coverage_frames = 24;       ///< of 64 triangles inside and, in turn, 32 that begin outside; 1..1000
  int interpolation_frames = 12;  ///< of 48 triangles, half of them in perspective
  std::function<void(const std::string& experiment, int done, int total)> progress;
};

/// UnavailableError where the device does not draw.
[[nodiscard]] ProbeFindings probe_device(Renderer& device, const ProbeOptions& options = {});

inline constexpr double kProbeFactor = 4;  ///< measured magnitudes times this are bounds

/// The bounds that follow: magnitudes times kProbeFactor; fixed-point coordinates and weights cost one whole step of theirs.
[[nodiscard]] DeviceModel model_of_findings(const ProbeFindings& findings, const std::string& device, const std::string& day);

// The experiments one by one.
[[nodiscard]] CoverageFinding probe_coverage(Renderer& device, const ProbeOptions& options);
[[nodiscard]] InterpolationFinding probe_interpolation(Renderer& device, const ProbeOptions& options, int subtexel_bits);
[[nodiscard]] NearestFinding probe_nearest(Renderer& device);
[[nodiscard]] LinearFinding probe_linear(Renderer& device, ChannelType texels);
[[nodiscard]] StorageFinding probe_storage(Renderer& device);

}  // namespace etalon::validation
