// How far a device's arithmetic may lead it from the exact number: the only place in etalon where a tolerance is written down.
// Every bound is derived from the device's own formula (docs/bounds.md gives the derivations and the Mesa functions they cite)
// or measured by a probe and multiplied by a stated factor; DeviceModel says which, and for what renderer.
// Does: bounds of interpolated values, of depth, of a texel coordinate, of the linear filter. Does not: coverage, whose bound is 0.
#pragma once

#include <array>
#include <string>

namespace etalon::validation {

inline constexpr double kUnitRoundoff = 0x1p-24;  ///< u of float32: |fl(x) − x| <= u·|x|

/// specified: what an API promises of single operations, put into the shape of a derived bound; like measured, no proof.
enum class BoundOrigin { exact, derived, measured, specified };

/// What is known about the arithmetic of a device. Make one with contract_model(), llvmpipe_model(), measured_model() or specified_model().
struct DeviceModel {
  std::string name;
  BoundOrigin origin = BoundOrigin::derived;
  std::string valid_for;              ///< renderer and versions, or date and factor of the measurement
  double factor = 1;                  ///< multiplies every interpolation bound; 0 for a device that keeps the contract to the last bit
  bool fixed_point_linear8 = false;   ///< unorm8 textures are filtered with 8-bit weights and 8-bit results (gallivm's AoS path)
  bool srgb_polynomial = false;       ///< sRGB is decoded by gallivm's polynomial and encoded by its approximation
  bool unorm_toward_zero = false;     ///< unorm targets are truncated: no device declares it, diagnosis asks it
  double unorm_error_steps = 0;       ///< of unorm targets, beside the half step of rounding to the nearest
  double coordinate_error_texel = 0;  ///< of texel coordinates that are kept in fixed point, beside what float32 costs them
  // Of a device whose filter was measured; fixed_point_linear8 has its own, derived.
  double weight_error_unorm8_texel = 0;  ///< how far the filter's weights are from exact, textures of bytes
  double weight_error_texel = 0;         ///< the same, all other textures
  double filter_error_unorm8 = 0;        ///< of a filtered value beside its weights, textures of bytes
  double filter_error = 0;               ///< the same, all other textures, in units of the largest texel involved
  double depth_quantum = 0;              ///< spacing of the depth buffer's values; 0 for float32
};

/// The oracle itself: every bound 0, any difference is a defect.
[[nodiscard]] DeviceModel contract_model();
/// Mesa's llvmpipe; derived; the arithmetic was read in 22.x–23.x sources and checked against 22.3.6.
[[nodiscard]] DeviceModel llvmpipe_model();
/// The shape of llvmpipe's bound times `factor`, for a device whose arithmetic is not published. A result on it is not called proven.
[[nodiscard]] DeviceModel measured_model(const std::string& name, double factor, const std::string& valid_for);

/// The same shape at the accuracy that a specification gives single operations: `unit_roundoffs` times 2^-24, and texel coordinates in
/// fixed point of `coordinate_bits` (0: they stay float32). `section`: where it says so.
[[nodiscard]] DeviceModel specified_model(const std::string& name, double unit_roundoffs, int coordinate_bits, const std::string& section);

[[nodiscard]] std::string to_string(BoundOrigin origin);

/// A triangle as the device's setup sees it, in texels of the frame (row 0 at y = 0); any orientation, area not 0.
struct TriangleGeometry {
  std::array<double, 3> x{}, y{};
  std::array<double, 3> w{1, 1, 1};
  double center_x = 0, center_y = 0;  ///< of the viewport (gpu/guard_viewport.h), texels
  bool exact_positions = false;       ///< the device reproduces the window positions exactly: equal w, and positions that are float32
};

/// Bound δ, in texels, of the device's window position against the snapped one, each axis (docs/bounds.md#displacement).
[[nodiscard]] double displacement(const TriangleGeometry& g);

/// Bound of one interpolated plane, |device − exact| at a sample, for the worst of the three start vertices a driver may choose.
class PlaneBound {
 public:
  PlaneBound() = default;
  /// `a`: the exact values at the vertices; `vertex_error`: how far the device's vertex values may be from them.
  PlaneBound(const TriangleGeometry& g, const std::array<double, 3>& a, double vertex_error, const DeviceModel& device);

  /// x, y: the sample in texels. +inf where float32 setup degenerates (docs/bounds.md#unbounded).
  [[nodiscard]] double at(double x, double y) const;
  /// |∂a/∂x|, |∂a/∂y| of the exact plane, per texel.
  [[nodiscard]] double gradient_x() const { return gx_; }
  [[nodiscard]] double gradient_y() const { return gy_; }

 private:
  struct Start {
    double dx = 0, dy = 0;  // slope errors
    double a = 0, x = 0, y = 0;
  };
  std::array<Start, 3> start_{};
  double gx_ = 0, gy_ = 0;
  double constant_ = 0;
  double factor_ = 1;
  bool unbounded_ = true;
};

/// Bound of the perspective quotient p/q from the bounds of its planes; `value` = p/q, `q` exact at the sample. +inf where B_q >= q/2.
[[nodiscard]] double quotient_bound(double bound_p, double bound_q, double value, double q, const DeviceModel& device);

/// Error of the window depth at a vertex: z travels as clip z = float((2z − 1)·w) and comes back as z_clip · rcp(w) · 0.5 + 0.5.
[[nodiscard]] double vertex_depth_error(double z, const DeviceModel& device);

/// True where a bound says nothing any more: infinite, or more than a quarter of the range `a` spans
/// (for nearly constant attributes, where the range itself is rounding noise, more than 2^-16 of the largest |a|).
[[nodiscard]] bool is_useless(double bound, const std::array<double, 3>& a);

/// Bound of u·size − (the device's float32 product), in texels. `wraps_by_fraction`: repeat of a size that is no power of two.
[[nodiscard]] double texel_margin_bound(double u, double error_u, int size, bool wraps_by_fraction, bool linear, const DeviceModel& device);

/// Relative error of the float32 bilinear filter: |device − exact| <= this · max|t|, for exact weights.
inline constexpr double kLinearFilterError = 11 * kUnitRoundoff;
/// Relative error of float(i)·float(1/255): two roundings.
inline constexpr double kUnormDecodeError = 2 * kUnitRoundoff;
/// Half the step of 8 fractional bits: how far the AoS path moves a coordinate, in texels, beside texel_margin_bound().
inline constexpr double kFixedCoordinateError = 0x1p-9;
/// Error of the two 8-bit lerp stages, in units of 1/255: 1/2 each where pmulhrsw rounds, 1 each where the shift truncates.
inline constexpr double kFixedLerpError = 2;
/// Error of gallivm's sRGB encoding in units of 1/255 of the encoded value; measured by its author (lp_build_linear_to_srgb: "max +-0.17").
inline constexpr double kSrgbEncodeError = 0.17;

/// gallivm's sRGB decode of byte c (lp_build_srgb_to_linear), as a real number; its float32 error is below 8u.
[[nodiscard]] double srgb_polynomial_decode(int c);
inline constexpr double kSrgbPolynomialError = 8 * kUnitRoundoff;

}  // namespace etalon::validation
