#include "core/simplify/kim_metric.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace etalon::simplify {

namespace {

/// Diagonals in units, where none is given.
constexpr double kUnitsInDiagonal = 8000;

}  // namespace

KimMetric::KimMetric(const CollapseMesh& mesh, const UnitPositions& positions, const QemOptions& qem, const KimOptions& options)
    : mesh_(mesh), places_(positions.at), qem_(mesh, positions, qem) {
  if (mesh.source().colors.empty()) throw InputError("metric kim: expected vertex colours, got none");
  if (!(options.unit >= 0) || std::isinf(options.unit))
    throw InputError(fmt::format("metric kim: unit: expected a positive length, got {}", options.unit));
  const double diagonal = bounding_box(mesh.source()).diagonal();
  const double unit = options.unit > 0 ? options.unit : diagonal / kUnitsInDiagonal;
  length_ = unit > 0 ? positions.unit / unit : 1;
  length4_ = length_ * length_ * (length_ * length_);

  importance_.assign(mesh.vertex_capacity(), 0);
  largest_.assign(mesh.vertex_capacity(), 0);
  for (std::uint32_t v = 0; v < mesh.vertex_capacity(); ++v) {
    if (!mesh.vertex_alive(v)) continue;
    double sum = 0, largest = 0;
    mesh.for_each_neighbor(v, [&](std::uint32_t n, std::uint32_t) {
      const double distance = std::sqrt(squared_color_distance(point(v), point(n)));  // eq. 13
      sum += distance;
      largest = std::max(largest, distance);
    });
    importance_[v] = largest > 0 ? static_cast<float>(sum / largest) : 0.0f;
    largest_[v] = static_cast<float>(largest);
  }
}

KimMetric::Point KimMetric::point(std::uint32_t v) const {
  const Vec3f& at = places_[v];
  const Vec4f& color = mesh_.color(v);
  return {at.x, at.y, at.z, color.x, color.y, color.z};
}

double KimMetric::squared_color_distance(const Point& a, const Point& b) {
  const double dr = a.r - b.r, dg = a.g - b.g, db = a.b - b.b;
  return dr * dr + dg * dg + db * db;
}

// ‖ca − cb‖·‖va − vb‖; the same bits for (b, a).
double KimMetric::product(const Point& a, const Point& b) {
  const double dx = a.x - b.x, dy = a.y - b.y, dz = a.z - b.z;
  return std::sqrt(squared_color_distance(a, b) * (dx * dx + dy * dy + dz * dz));
}

double KimMetric::color_error(std::uint32_t u, std::uint32_t v) const {
  const Point at_u = point(u), at_v = point(v);
  double sum = 0;
  mesh_.for_each_neighbor(u, [&](std::uint32_t n, std::uint32_t) {
    const Point near = point(n);
    sum += std::fabs(product(at_u, near) - product(at_v, near));
  });
  return sum * length_;
}

void KimMetric::load(std::uint32_t u) {
  loaded_ = u;
  near_.clear();
  points_.clear();
  mesh_.for_each_neighbor(u, [&](std::uint32_t n, std::uint32_t) {
    near_.push_back(n);
    points_.push_back(point(n));
  });
  products_.resize(points_.size());
  terms_.resize(points_.size());
  const Point at_u = point(u);
  for (std::size_t i = 0; i < points_.size(); ++i) products_[i] = product(at_u, points_[i]);
}

double KimMetric::cost_of_bounded(std::uint32_t u, const CollapseCandidate& candidate) {
  if (loaded_ != u) load(u);
  const Point at_v = points_[static_cast<std::size_t>(std::find(near_.begin(), near_.end(), candidate.target) - near_.begin())];
  for (std::size_t i = 0; i < points_.size(); ++i) terms_[i] = std::fabs(products_[i] - product(at_v, points_[i]));
  double sum = 0;
  for (const double term : terms_) sum += term;
  return candidate.cost * (1 + sum * length_);
}

void KimMetric::collapse(std::uint32_t u, std::uint32_t v, const CollapseMesh::Edge& edge) {
  qem_.collapse(u, v, edge);
  importance_[v] = static_cast<float>(static_cast<double>(importance_[u]) + importance_[v]);
  largest_[v] = std::max(largest_[u], largest_[v]);
}

}  // namespace etalon::simplify
