#include "core/simplify/simplify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/float_environment.h"
#include "core/simplify/collapse_loop.h"
#include "core/simplify/extract.h"
#include "core/simplify/hoppe_metric.h"
#include "core/simplify/landing_tracker.h"
#include "core/simplify/qem5_metric.h"
#include "core/simplify/qem6_metric.h"

namespace etalon::simplify {

namespace {

void require_valid(const Mesh& mesh, const SimplifyOptions& options) {
  if (mesh.faces.empty()) throw InputError("mesh: expected at least one face, got none");
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3f& p = mesh.positions[v];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      throw InputError(fmt::format("vertex {}: position: expected finite numbers, got {} {} {}", v, p.x, p.y, p.z));
  }
  for (std::size_t w = 0; w < mesh.wedge_count(); ++w) {
    const Wedge& wedge = mesh.wedges[w];
    if (wedge.vertex.index >= mesh.vertex_count())
      throw InputError(fmt::format("wedge {}: vertex: expected below {}, got {}", w, mesh.vertex_count(), wedge.vertex.index));
    if (mesh.has_uv && (!std::isfinite(wedge.uv.x) || !std::isfinite(wedge.uv.y)))
      throw InputError(fmt::format("wedge {}: uv: expected finite numbers, got {} {}", w, wedge.uv.x, wedge.uv.y));
  }
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    for (const WedgeId w : mesh.faces[f])
      if (w.index >= mesh.wedge_count())
        throw InputError(fmt::format("face {}: wedge: expected below {}, got {}", f, mesh.wedge_count(), w.index));
  const bool by_color = options.metric == MetricName::qem6 || options.metric == MetricName::hoppe || options.metric == MetricName::kim;
  if (by_color && mesh.colors.empty())
    throw InputError(fmt::format("metric {}: expected vertex colours, got none", to_string(options.metric)));
  if (options.metric == MetricName::qem5 && !mesh.has_uv) throw InputError("metric qem5: expected texture coordinates, got none");
  for (std::size_t v = 0; v < mesh.colors.size(); ++v) {
    const Vec4f& c = mesh.colors[v];
    if (by_color && !(std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z)))
      throw InputError(fmt::format("vertex {}: colour: expected finite numbers, got {} {} {}", v, c.x, c.y, c.z));
  }
  if (!(options.attribute_weight > 0) || std::isinf(options.attribute_weight))
    throw InputError(fmt::format("attribute weight: expected a positive number, got {}", options.attribute_weight));
  for (const VertexId v : options.locked)
    if (v.index >= mesh.vertex_count())
      throw InputError(fmt::format("locked vertex: expected below {}, got {}", mesh.vertex_count(), v.index));
}

void refuse_non_manifold(const InputRepair& repair) {
  const auto refuse = [](const Defect& defect, const char* what, const char* place) {
    if (!defect.found()) return;
    throw InputError(
        fmt::format("mesh: expected an oriented manifold, got {} {} (first: {} {})", defect.count, what, place, defect.first[0]));
  };
  refuse(repair.non_manifold_edges, "edges of more than two faces", "face");
  refuse(repair.inconsistent_edges, "edges between faces of opposite orientation", "face");
  refuse(repair.non_manifold_vertices, "vertices whose faces are not one fan", "vertex");
}

void count_kinds(const CollapseMesh& mesh, SimplifyResult& result) {
  for (std::uint32_t v = 0; v < mesh.source().vertex_count(); ++v) {
    if (!mesh.vertex_alive(v)) continue;
    if (mesh.kind(v) == VertexKind::interior) ++result.interior_vertices;
    if (mesh.kind(v) == VertexKind::curve) ++result.curve_vertices;
    if (mesh.kind(v) == VertexKind::locked) ++result.locked_vertices;
  }
}

// From faces of the input to those of the result, and how far each vertex has gone.
void measure_landings(const Mesh& source, SimplifyResult& result) {
  std::vector<FaceId> new_face(source.face_count());
  for (std::size_t f = 0; f < result.source_face.size(); ++f) new_face[result.source_face[f].index] = FaceId(f);
  double distance2 = 0;
  for (std::size_t v = 0; v < result.landings.size(); ++v) {
    Landing& landing = result.landings[v];
    if (!landing.face.valid()) continue;
    landing.face = new_face[landing.face.index];
    distance2 = std::max(distance2, squared_distance(to_double(source.positions[v]), landing_point(result.mesh, landing)));
  }
  result.distance_max = std::sqrt(distance2);
}

template <class Metric>
void run(CollapseMesh& mesh, const UnitPositions& positions, Metric& metric, const SimplifyOptions& options, SimplifyResult& result) {
  Legality legality(mesh, positions, options.legality);
  CollapseLoop<Metric> loop(mesh, metric, legality);
  const std::size_t faces_before = mesh.face_count();
  const std::size_t to_remove = faces_before > options.target_faces ? faces_before - options.target_faces : 0;
  std::optional<LandingTracker> tracker;
  if (options.record_landings) tracker.emplace(mesh);
  double squared_error = 0;
  while (mesh.face_count() > options.target_faces) {
    const auto step = loop.find();
    if (step.u == kNone) {
      result.stop = StopReason::exhausted;
      break;
    }
    result.max_cost = std::max(result.max_cost, step.cost);
    squared_error = std::max(squared_error, metric.squared_distance(step.u, step.v, step.cost));
    if (options.before_collapse) options.before_collapse(mesh, {step.u, step.v, step.edge, step.cost});
    if (tracker) tracker->before(step.u, step.edge);
    loop.apply(step);
    if (tracker) tracker->after();
    if (options.after_collapse) options.after_collapse(mesh);
    ++result.collapse_count;
    if (options.progress && result.collapse_count % 1000 == 0) options.progress(faces_before - mesh.face_count(), to_remove);
  }
  result.error = std::sqrt(squared_error) * positions.unit;
  result.refusals = loop.refusals();
  result.state_bytes = metric.state_bytes();
  result.state_bytes_per_vertex = (result.state_bytes + mesh.vertex_capacity() - 1) / mesh.vertex_capacity();
  if (tracker) result.landings = tracker->landings();
}

}  // namespace

const char* to_string(MetricName metric) {
  switch (metric) {
    case MetricName::qem: return "qem";
    case MetricName::qem5: return "qem5";
    case MetricName::qem6: return "qem6";
    case MetricName::hoppe: return "hoppe";
    case MetricName::kim: return "kim";
  }
  return "";
}

MetricName metric_named(const std::string& name) {
  std::string known;
  for (const MetricName metric : kMetricNames) {
    if (name == to_string(metric)) return metric;
    known += fmt::format("{}{}", known.empty() ? "" : ", ", to_string(metric));
  }
  throw InputError(fmt::format("metric: expected one of {}, got {}", known, name));
}

const char* to_string(StopReason reason) { return reason == StopReason::faces ? "faces" : "exhausted"; }

SimplifyResult simplify_mesh(const Mesh& mesh, const SimplifyOptions& options) {
  const DefaultFloatEnvironment environment;
  require_valid(mesh, options);
  CollapseMesh triangles(mesh, options.locked);
  if (options.refuse_non_manifold) refuse_non_manifold(triangles.repair());
  SimplifyResult result;
  result.repair = triangles.repair();
  count_kinds(triangles, result);
  const UnitPositions positions = unit_positions(triangles);
  switch (options.metric) {
    case MetricName::qem: {
      QemMetric metric(triangles, positions, options.qem);
      run(triangles, positions, metric, options, result);
      break;
    }
    case MetricName::qem5: {
      Qem5Metric metric(triangles, positions, options.qem, options.attribute_weight);
      run(triangles, positions, metric, options, result);
      break;
    }
    case MetricName::qem6: {
      Qem6Metric metric(triangles, positions, options.qem, options.attribute_weight);
      run(triangles, positions, metric, options, result);
      break;
    }
    case MetricName::hoppe: {
      HoppeMetric metric(triangles, positions, options.qem, options.attribute_weight);
      run(triangles, positions, metric, options, result);
      break;
    }
    case MetricName::kim: {
      KimMetric metric(triangles, positions, options.qem, options.kim);
      run(triangles, positions, metric, options, result);
      break;
    }
  }
  extract(triangles, result);
  if (options.record_landings) measure_landings(mesh, result);
  return result;
}

std::size_t faces_for_ratio(std::size_t faces, double ratio) {
  if (!(ratio >= 0 && ratio <= 1)) throw InputError(fmt::format("ratio: expected 0 to 1, got {}", ratio));
  return static_cast<std::size_t>(std::floor(ratio * static_cast<double>(faces) + 0.5));
}

}  // namespace etalon::simplify
