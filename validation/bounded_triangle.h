// One triangle with the bounds of everything the device interpolates over it; planes are made as they are asked for: most draws need two of the ten.
#pragma once

#include <array>
#include <optional>

#include "validation/fragments.h"
#include "validation/storage_rounding.h"
#include "validation/texel_lookup.h"

namespace etalon::validation {

/// Values are exact to kEvaluationError, which their bounds include; not thread-safe.
class BoundedTriangle {
 public:
  BoundedTriangle(const DrawList& list, std::uint32_t triangle, const Frame& frame, const DeviceModel& device);

  [[nodiscard]] const TriangleEvaluator& evaluator() const { return evaluator_; }
  [[nodiscard]] Bounded color(const Sample& s, int channel);
  [[nodiscard]] Coordinate coordinate(const Sample& s);
  [[nodiscard]] Bounded barycentric(const Sample& s, int vertex);  ///< vertex of the draw list's triangle
  [[nodiscard]] Bounded depth(const Sample& s);

 private:
  // |device − exact| of the interpolated attribute a at the sample, whose exact value is `value`.
  double attribute_bound(std::optional<PlaneBound>& plane, const std::array<double, 3>& a, const Sample& s, double value);

  TriangleEvaluator evaluator_;
  const DeviceModel& device_;
  bool affine_ = true;
  std::optional<PlaneBound> u_plane_, v_plane_, q_plane_, z_plane_;
  std::array<std::optional<PlaneBound>, 4> color_plane_;
  std::array<std::optional<PlaneBound>, 3> barycentric_plane_;
};

}  // namespace etalon::validation
