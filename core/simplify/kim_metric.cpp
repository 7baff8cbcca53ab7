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
  if (std::isinf(length4_))
    throw InputError(
        fmt::format("metric kim: unit: expected a length beside which the model's fourth power is a finite number, got {}", options.unit));

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

void KimMetric::surround(std::uint32_t u, std::span<const CollapseCandidate> neighbors) {
  const std::size_t n = neighbors.size();
  if (n > x_.size())
    for (std::vector<double>* lane : {&x_, &y_, &z_, &r_, &g_, &b_, &products_, &terms_, &bounds_, &bases_}) lane->resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Point at = point(neighbors[i].target);
    x_[i] = at.x;
    y_[i] = at.y;
    z_[i] = at.z;
    r_[i] = at.r;
    g_[i] = at.g;
    b_[i] = at.b;
    bases_[i] = qem_.constant(neighbors[i].target);
  }
  count_ = n;
  const Point at_u = point(u);
  write_products(at_u, products_.data());
  const Quadric3<double> own = qem_.state(u);
  const double importance = 1 + static_cast<double>(importance_[u]);
  for (std::size_t i = 0; i < n; ++i) {
    const double q = evaluate(own, {x_[i] - at_u.x, y_[i] - at_u.y, z_[i] - at_u.z}) + bases_[i];
    bases_[i] = (1 + (q > 0 ? q : 0) * length4_) * importance;
    bounds_[i] = bases_[i] * (1 + products_[i] * length_);
  }
}

// The products of one point with all neighbours in hand.
void KimMetric::write_products(const Point& p, double* to) const {
  const double *x = x_.data(), *y = y_.data(), *z = z_.data(), *r = r_.data(), *g = g_.data(), *b = b_.data();
  for (std::size_t i = 0; i < count_; ++i) to[i] = product(p, {x[i], y[i], z[i], r[i], g[i], b[i]});
}

double KimMetric::cost_of(std::size_t i) {
  write_products({x_[i], y_[i], z_[i], r_[i], g_[i], b_[i]}, terms_.data());
  double sum = 0;
  for (std::size_t k = 0; k < count_; ++k) sum += std::fabs(products_[k] - terms_[k]);
  return bases_[i] * (1 + sum * length_);
}

void KimMetric::collapse(std::uint32_t u, std::uint32_t v, const CollapseMesh::Edge& edge) {
  qem_.collapse(u, v, edge);
  importance_[v] = static_cast<float>(static_cast<double>(importance_[u]) + importance_[v]);
  largest_[v] = std::max(largest_[u], largest_[v]);
}

}  // namespace etalon::simplify
