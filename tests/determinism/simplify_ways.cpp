#include "core/procedural/head.h"
#include "core/procedural/knot.h"
#include "core/simplify/simplify.h"
#include "tests/determinism/canonical_hash.h"
#include "tests/determinism/jobs.h"

namespace etalon::test {
namespace {

using namespace simplify;

bool suits(const Mesh& mesh, MetricName metric, CollapseKind kind) {
  switch (metric) {
    case MetricName::qem: return true;
    case MetricName::qem5: return mesh.has_uv;
    case MetricName::qem6:
    case MetricName::hoppe: return !mesh.colors.empty();
    case MetricName::kim: return !mesh.colors.empty() && kind == CollapseKind::half;
    case MetricName::aps: return mesh.has_uv && kind == CollapseKind::half;
  }
  return false;
}

// Everything that goes into files and documents.
std::string hash_of(const SimplifyResult& result) {
  CanonicalHash hash;
  hash.add(result.mesh);
  hash.add(result.source_face);
  for (const Landing& landing : result.landings) hash.add(landing.face), hash.add(landing.weights);
  hash.add(result.refusals);
  for (const double figure : {result.max_cost, result.error, result.distance_max.value_or(-1), result.distance_audited.value_or(-1)})
    hash.add(figure);
  return hash.hex();
}

}  // namespace

std::vector<HashedWay> simplify_ways(const std::string& model, const Mesh& mesh) {
  std::vector<HashedWay> ways;
  for (const MetricName metric : kMetricNames)
    for (const CollapseKind collapse : {CollapseKind::half, CollapseKind::full}) {
      if (!suits(mesh, metric, collapse)) continue;
      // A tolerance of a hundredth of the diagonal: landings, and the audit, which is the part that has threads.
      ways.push_back({"simplify " + model + " " + to_string(metric) + " " + to_string(collapse), [=] {
                        return hash_of(simplify_mesh(mesh, {.metric = metric,
                                                            .collapse = collapse,
                                                            .target_faces = faces_for_ratio(mesh.face_count(), 0.1),
                                                            .tolerance = 0.01 * bounding_box(mesh).diagonal()}));
                      }});
    }
  return ways;
}

std::vector<HashedWay> simplify_ways() {
  std::vector<HashedWay> ways = simplify_ways("knot", procedural::make_knot(procedural::knot_of_faces(10'000)));
  for (HashedWay& way : simplify_ways("head", procedural::make_head().mesh)) ways.push_back(std::move(way));
  return ways;
}

}  // namespace etalon::test
