#include "tests/bench/simplify_way.h"

#include <ctime>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/simplify/simplify.h"

namespace etalon::bench {
namespace {

using simplify::CollapseKind;
using simplify::MetricName;

/// Of the metrics with attributes: the length of a difference of 1 in colour, the longest side of the model's box being 1. With 1, Garland &
/// Heckbert's own, colours outweigh the form.
constexpr double kColourWeight = 0.05;

SimplifyWay ours(MetricName metric, CollapseKind collapse, double weight = 1) {
  const std::string name = to_string(metric), kind = to_string(collapse);
  const std::string weighted = weight == 1 ? "" : fmt::format(", colour weight {}", weight);
  return {.name = fmt::format("ours-{}{}{}", name, collapse == CollapseKind::full ? "-full" : "", weight == 1 ? "" : "-weighted"),
          .title = fmt::format("ours, {}, {}-edge{}", name, kind, weighted),
          .run =
              [metric, collapse, weight](const Mesh& mesh, std::size_t target_faces) {
                const double start = process_cpu_seconds();
                simplify::SimplifyResult result = simplify::simplify_mesh(
                    mesh, {.metric = metric, .collapse = collapse, .target_faces = target_faces, .attribute_weight = weight});
                return SimplifyOutcome{.mesh = std::move(result.mesh), .seconds = process_cpu_seconds() - start};
              },
          .absent = ""};
}

std::vector<SimplifyWay> make_ways() {
  std::vector<SimplifyWay> ways{ours(MetricName::qem, CollapseKind::half),
                                ours(MetricName::qem, CollapseKind::full),
                                ours(MetricName::qem6, CollapseKind::half),
                                ours(MetricName::qem6, CollapseKind::full),
                                ours(MetricName::qem6, CollapseKind::full, kColourWeight),
                                ours(MetricName::kim, CollapseKind::half)};
  SimplifyWay cgal{.name = "cgal-gh", .title = "CGAL, Garland–Heckbert, full-edge", .run = {}, .absent = "libcgal-dev, libeigen3-dev"};
  SimplifyWay openmesh{.name = "openmesh", .title = "OpenMesh, ModQuadric, half-edge", .run = {}, .absent = "libopenmesh-dev"};
  SimplifyWay meshopt{.name = "meshopt", .title = "meshoptimizer, half-edge", .run = {}, .absent = "libmeshoptimizer-dev"};
#ifdef ETALON_HAS_CGAL
  cgal.run = simplify_with_cgal;
#endif
#ifdef ETALON_HAS_OPENMESH
  openmesh.run = simplify_with_openmesh;
#endif
#ifdef ETALON_HAS_MESHOPT
  meshopt.run = simplify_with_meshopt;
#endif
  ways.insert(ways.end(), {cgal, openmesh, meshopt});
  return ways;
}

}  // namespace

double process_cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

const std::vector<SimplifyWay>& simplify_ways() {
  static const std::vector<SimplifyWay> ways = make_ways();
  return ways;
}

const SimplifyWay& simplify_way(const std::string& name) {
  for (const SimplifyWay& way : simplify_ways())
    if (way.name == name) return way;
  throw InputError(fmt::format("way to simplify: expected one of simplify_ways(), got '{}'", name));
}

}  // namespace etalon::bench
