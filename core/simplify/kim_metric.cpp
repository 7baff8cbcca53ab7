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
      const double distance = color_distance(v, n);
      sum += distance;
      largest = std::max(largest, distance);
    });
    importance_[v] = largest > 0 ? static_cast<float>(sum / largest) : 0.0f;
    largest_[v] = static_cast<float>(largest);
  }
}

// Equation 13.
double KimMetric::color_distance(std::uint32_t a, std::uint32_t b) const {
  const Vec4f &x = mesh_.source().colors[mesh_.origin(a)], &y = mesh_.source().colors[mesh_.origin(b)];
  return std::sqrt(etalon::squared_distance(Vec3d(x.x, x.y, x.z), Vec3d(y.x, y.y, y.z)));
}

double KimMetric::color_error(std::uint32_t u, std::uint32_t v) const {
  const auto length = [&](std::uint32_t a, std::uint32_t b) {
    const Vec3d d = difference_of(places_[a], places_[b]);
    return std::sqrt(dot_product(d, d));
  };
  double sum = 0;
  mesh_.for_each_neighbor(u, [&](std::uint32_t n, std::uint32_t) {
    sum += std::fabs(color_distance(u, n) * length(u, n) - color_distance(v, n) * length(v, n));
  });
  return sum * length_;
}

void KimMetric::collapse(std::uint32_t u, std::uint32_t v, const CollapseMesh::Edge& edge) {
  qem_.collapse(u, v, edge);
  importance_[v] = static_cast<float>(static_cast<double>(importance_[u]) + importance_[v]);
  largest_[v] = std::max(largest_[u], largest_[v]);
}

}  // namespace etalon::simplify
