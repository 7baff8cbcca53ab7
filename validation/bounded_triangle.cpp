#include "validation/bounded_triangle.h"

#include <algorithm>
#include <cmath>

namespace etalon::validation {

namespace {

double largest(const std::array<double, 3>& a) { return std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])}); }

}  // namespace

BoundedTriangle::BoundedTriangle(const DrawList& list, std::uint32_t triangle, const Frame& frame, const DeviceModel& device)
    : evaluator_(list, triangle, frame), device_(device) {
  const auto& w = evaluator_.geometry().w;
  affine_ = w[0] == w[1] && w[1] == w[2];
}

double BoundedTriangle::attribute_bound(std::optional<PlaneBound>& plane, const std::array<double, 3>& a, const Sample& s, double value) {
  if (device_.factor == 0) return 0;
  const auto& w = evaluator_.geometry().w;
  const double slack = kEvaluationError * largest(a);
  // Equal w reach the device as w = 1: the plane of 1/w is 1 and the quotient exact.
  if (affine_) {
    if (!plane) plane.emplace(evaluator_.geometry(), a, 0, device_);
    return plane->at(s.x, s.y) + slack;
  }
  if (!plane) {
    const std::array<double, 3> p{a[0] / w[0], a[1] / w[1], a[2] / w[2]};
    plane.emplace(evaluator_.geometry(), p, 3 * kUnitRoundoff * largest(p), device_);
  }
  if (!q_plane_) {
    const std::array<double, 3> q{1 / w[0], 1 / w[1], 1 / w[2]};
    q_plane_.emplace(evaluator_.geometry(), q, 2 * kUnitRoundoff * largest(q), device_);
  }
  return quotient_bound(plane->at(s.x, s.y), q_plane_->at(s.x, s.y), value, s.q, device_) + slack;
}

Bounded BoundedTriangle::color(const Sample& s, int channel) {
  const auto& a = evaluator_.color(channel);
  const double value = evaluator_.perspective(s, a);
  return {value, attribute_bound(color_plane_[static_cast<std::size_t>(channel)], a, s, value)};
}

Coordinate BoundedTriangle::coordinate(const Sample& s) {
  Coordinate at;
  at.u = evaluator_.perspective(s, evaluator_.u());
  at.v = evaluator_.perspective(s, evaluator_.v());
  at.error_u = attribute_bound(u_plane_, evaluator_.u(), s, at.u);
  at.error_v = attribute_bound(v_plane_, evaluator_.v(), s, at.v);
  return at;
}

Bounded BoundedTriangle::barycentric(const Sample& s, int vertex) {
  std::array<double, 3> a{};
  for (std::size_t k = 0; k < 3; ++k) a[k] = evaluator_.order()[k] == vertex ? 1.0 : 0.0;
  const double value = evaluator_.perspective(s, a);
  return {value, attribute_bound(barycentric_plane_[static_cast<std::size_t>(vertex)], a, s, value)};
}

Bounded BoundedTriangle::depth(const Sample& s) {
  const auto& z = evaluator_.z();
  if (!z_plane_) {
    const double vertex =
        std::max({vertex_depth_error(z[0], device_), vertex_depth_error(z[1], device_), vertex_depth_error(z[2], device_)});
    z_plane_.emplace(evaluator_.geometry(), z, vertex, device_);
  }
  const double slack = device_.factor == 0 ? 0 : device_.depth_quantum + kEvaluationError;
  return {evaluator_.linear(s, z), z_plane_->at(s.x, s.y) + slack};
}

}  // namespace etalon::validation
