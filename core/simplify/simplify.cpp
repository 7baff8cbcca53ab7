#include "core/simplify/simplify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/float_environment.h"
#include "core/base/parallel.h"
#include "core/mesh/triangle_tree.h"
#include "core/simplify/aps_metric.h"
#include "core/simplify/collapse_loop.h"
#include "core/simplify/extract.h"
#include "core/simplify/full_edge_loop.h"
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
  const bool by_uv = options.metric == MetricName::qem5 || options.metric == MetricName::aps;
  if (by_uv && !mesh.has_uv) throw InputError(fmt::format("metric {}: expected texture coordinates, got none", to_string(options.metric)));
  for (std::size_t v = 0; v < mesh.colors.size(); ++v) {
    const Vec4f& c = mesh.colors[v];
    if (by_color && !(std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z)))
      throw InputError(fmt::format("vertex {}: colour: expected finite numbers, got {} {} {}", v, c.x, c.y, c.z));
  }
  if (options.tolerance && !(*options.tolerance >= 0))
    throw InputError(fmt::format("tolerance: expected a distance of at least 0, got {}", *options.tolerance));
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

// Wedges that differ in nothing would part when one of them moves.
void require_one_wedge_a_corner(const CollapseMesh& mesh) {
  if (!mesh.textured()) return;
  for (std::uint32_t f = 0; f < mesh.face_capacity(); ++f)
    for (std::uint32_t h = 4 * f; h < 4 * f + 3 && mesh.face_alive(f); ++h)
      if (!mesh.on_curve(h) && mesh.wedge(h) != mesh.wedge(CollapseMesh::next(mesh.opposite(h))))
        throw InputError(fmt::format("vertex {}: expected one wedge on each side of its curve, got two of equal uv: weld first",
                                     mesh.origin(mesh.start(h))));
}

// How far the vertices are from the result, whatever their landings say.
double audit(const Mesh& source, const SimplifyResult& result) {
  const TriangleTree tree(result.mesh);
  std::vector<double> distance2(source.vertex_count(), 0);
  parallel_for(source.vertex_count(), [&](std::size_t v) {
    const Landing& landing = result.landings[v];
    if (landing.face.valid()) distance2[v] = tree.nearest(to_double(source.positions[v]), landing.face).distance2;
  });
  return std::sqrt(*std::max_element(distance2.begin(), distance2.end()));
}

/// What both kinds of collapse share: observers, landings, the tolerance, when to stop.
class Course {
 public:
  Course(CollapseMesh& mesh, const UnitPositions& positions, const SimplifyOptions& options, SimplifyResult& result)
      : mesh_(mesh), positions_(positions), options_(options), result_(result) {
    if (options.record_landings || options.tolerance) tracker_.emplace(mesh);
  }

  template <class Loop, class Metric>
  void run(Loop& loop, const Metric& metric) {
    const std::size_t faces_before = mesh_.face_count();
    const std::size_t to_remove = faces_before > options_.target_faces ? faces_before - options_.target_faces : 0;
    double squared_error = 0;
    while (mesh_.face_count() > options_.target_faces) {
      const auto step = loop.find([&](const auto& found) { return judge(found); });
      if (step.u == kNone) {
        const bool refused = loop.refusals()[static_cast<std::size_t>(Refusal::tolerance)] > 0;
        result_.stop = refused ? StopReason::tolerance : StopReason::exhausted;
        break;
      }
      result_.max_cost = std::max(result_.max_cost, step.cost);
      squared_error = std::max(squared_error, metric.squared_distance(step.u, step.v, step.cost));
      if (options_.before_collapse) options_.before_collapse(mesh_, {step.u, step.v, step.edge, step.cost, moves(step)});
      if (tracker_ && !options_.tolerance) plan(step);
      if (tracker_) tracker_->before();
      loop.apply(step);
      if (tracker_) tracker_->after();
      if (options_.after_collapse) options_.after_collapse(mesh_);
      ++result_.collapse_count;
      if (options_.progress && result_.collapse_count % 1000 == 0) options_.progress(faces_before - mesh_.face_count(), to_remove);
    }
    result_.error = std::sqrt(squared_error) * positions_.unit;
    result_.refusals = loop.refusals();
    result_.state_bytes = metric.state_bytes();
    result_.state_bytes_per_vertex = (result_.state_bytes + mesh_.vertex_capacity() - 1) / mesh_.vertex_capacity();
    if (tracker_) result_.landings = tracker_->landings();
  }

 private:
  template <class Step>
  static bool moves(const Step& step) {
    if constexpr (requires { step.moves; })
      return step.moves;
    else
      return false;
  }

  template <class Step>
  void plan(const Step& step) {
    if constexpr (requires { step.moves; }) {
      if (step.moves) {
        const Vec3f at = model_place(positions_, step.moved.at);
        return tracker_->plan(step.u, step.edge, &at);
      }
    }
    tracker_->plan(step.u, step.edge);
  }

  template <class Step>
  Refusal judge(const Step& step) {
    if (!options_.tolerance) return Refusal::none;
    plan(step);
    return tracker_->planned_within(*options_.tolerance) ? Refusal::none : Refusal::tolerance;
  }

  CollapseMesh& mesh_;
  const UnitPositions& positions_;
  const SimplifyOptions& options_;
  SimplifyResult& result_;
  std::optional<LandingTracker> tracker_;
};

template <class Metric, class... MetricOptions>
void run(CollapseMesh& mesh, UnitPositions& positions, const SimplifyOptions& options, SimplifyResult& result,
         const MetricOptions&... how) {
  Metric metric(mesh, positions, options.qem, how...);
  Legality legality(mesh, positions, options.legality);
  Course course(mesh, positions, options, result);
  if (options.collapse == CollapseKind::half) {
    CollapseLoop<Metric> loop(mesh, metric, legality);
    course.run(loop, metric);
    return;
  }
  if constexpr (requires { &Metric::place; }) {
    mesh.allow_moves();
    FullEdgeLoop<Metric> loop(mesh, positions, metric, legality);
    course.run(loop, metric);
  } else {
    throw InputError(fmt::format("metric {}: expected half-edge collapses, got full-edge: it says nothing of places between vertices",
                                 to_string(options.metric)));
  }
}

}  // namespace

const char* to_string(MetricName metric) {
  switch (metric) {
    case MetricName::qem: return "qem";
    case MetricName::qem5: return "qem5";
    case MetricName::qem6: return "qem6";
    case MetricName::hoppe: return "hoppe";
    case MetricName::kim: return "kim";
    case MetricName::aps: return "aps";
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

const char* to_string(CollapseKind kind) { return kind == CollapseKind::half ? "half" : "full"; }

const char* to_string(StopReason reason) {
  switch (reason) {
    case StopReason::faces: return "faces";
    case StopReason::tolerance: return "tolerance";
    case StopReason::exhausted: return "exhausted";
  }
  return "";
}

SimplifyResult simplify_mesh(const Mesh& mesh, const SimplifyOptions& options) {
  const DefaultFloatEnvironment environment;
  require_valid(mesh, options);
  CollapseMesh triangles(mesh, options.locked);
  if (options.refuse_non_manifold) refuse_non_manifold(triangles.repair());
  SimplifyResult result;
  result.repair = triangles.repair();
  count_kinds(triangles, result);
  UnitPositions positions = unit_positions(triangles);
  if (options.collapse == CollapseKind::full || options.metric == MetricName::qem5) require_one_wedge_a_corner(triangles);
  switch (options.metric) {
    case MetricName::qem: run<QemMetric>(triangles, positions, options, result); break;
    case MetricName::qem5: run<Qem5Metric>(triangles, positions, options, result, options.attribute_weight); break;
    case MetricName::qem6: run<Qem6Metric>(triangles, positions, options, result, options.attribute_weight); break;
    case MetricName::hoppe: run<HoppeMetric>(triangles, positions, options, result, options.attribute_weight); break;
    case MetricName::kim: run<KimMetric>(triangles, positions, options, result, options.kim); break;
    case MetricName::aps: run<ApsMetric>(triangles, positions, options, result); break;
  }
  extract(triangles, result);
  if (!result.landings.empty()) measure_landings(mesh, result);
  if (options.tolerance) {
    result.distance_audited = audit(mesh, result);
    ETALON_CHECK(*result.distance_audited <= *options.tolerance,
                 fmt::format("a vertex is {} from the result, the tolerance is {}", *result.distance_audited, *options.tolerance));
  }
  return result;
}

std::size_t faces_for_ratio(std::size_t faces, double ratio) {
  if (!(ratio >= 0 && ratio <= 1)) throw InputError(fmt::format("ratio: expected 0 to 1, got {}", ratio));
  return static_cast<std::size_t>(std::floor(ratio * static_cast<double>(faces) + 0.5));
}

}  // namespace etalon::simplify
