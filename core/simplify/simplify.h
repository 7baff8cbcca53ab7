// Fewer triangles: edge collapses in strict order of cost, on real meshes.
// Does not: weld vertices that share a place (core/mesh/weld.h does), or resample images.
#pragma once

#include <array>
#include <functional>
#include <optional>

#include "core/mesh/landing.h"
#include "core/simplify/kim_metric.h"
#include "core/simplify/legality.h"

namespace etalon::simplify {

enum class MetricName : std::uint8_t {
  qem,    ///< position (qem_metric.h)
  qem5,   ///< position and texture coordinate (qem5_metric.h)
  qem6,   ///< position and vertex colour (qem6_metric.h)
  hoppe,  ///< position and vertex colour by gradients (hoppe_metric.h)
  kim,    ///< position and vertex colour (kim_metric.h)
  aps,    ///< texture deviation (aps_metric.h)
};
inline constexpr std::array kMetricNames{MetricName::qem,   MetricName::qem5, MetricName::qem6,
                                         MetricName::hoppe, MetricName::kim,  MetricName::aps};
[[nodiscard]] const char* to_string(MetricName metric);
/// InputError for a name that is none.
[[nodiscard]] MetricName metric_named(const std::string& name);

enum class CollapseKind : std::uint8_t {
  half,  ///< a vertex goes into a neighbour, which stays as it is (figure 1b)
  full,  ///< both ends go to where the metric is least (figure 1a): not for kim and aps
};
[[nodiscard]] const char* to_string(CollapseKind kind);

/// One collapse as it happens, before the mesh changes.
struct CollapseEvent {
  std::uint32_t u = kNone, v = kNone;  ///< engine vertices: u goes into v
  CollapseMesh::Edge edge;             ///< edge_from(u, …)
  double cost = 0;                     ///< in the metric's own unit
  bool moves = false;                  ///< whether v moves as well
};

struct SimplifyOptions {
  MetricName metric = MetricName::qem;
  CollapseKind collapse = CollapseKind::half;
  std::size_t target_faces = 0;  ///< stop at the first count that is not above it: one below where an inner edge passes it
  /// No vertex of the input may come to lie farther than this from the result (model units, ≥ 0): guaranteed, and audited at the end
  /// against all faces
  /// of the result. Implies record_landings.
  std::optional<double> tolerance;
  std::vector<VertexId> locked;      ///< vertices that stay where they are; others may still collapse into them
  bool refuse_non_manifold = false;  ///< InputError for an input that is no oriented manifold, instead of locking those places
  bool record_landings = false;      ///< fill SimplifyResult::landings; at 10 % about twice the time
  /// For qem5, qem6, hoppe: how long a difference of 1 in colour or texture coordinate is, the longest side of the model's box being 1.
  double attribute_weight = 1;
  QemOptions qem;
  KimOptions kim;
  LegalityOptions legality;
  /// Called before each collapse with the mesh as it still is; for observers that build on the sequence.
  std::function<void(const CollapseMesh&, const CollapseEvent&)> before_collapse;
  /// Called after each collapse.
  std::function<void(const CollapseMesh&)> after_collapse;
  /// Called about every 1,000 collapses with faces removed so far and in all; an exception stops the work.
  std::function<void(std::size_t done, std::size_t total)> progress;
};

enum class StopReason : std::uint8_t {
  faces,      ///< the target is reached
  tolerance,  ///< no legal collapse is left, and some were refused for the tolerance
  exhausted,  ///< no legal collapse is left
};
[[nodiscard]] const char* to_string(StopReason reason);

struct SimplifyResult {
  /// Survivors in the order of the input: vertices, wedges, faces; corners of a face keep their order.
  Mesh mesh;
  std::vector<VertexId>
      source_vertex;                  ///< #V of mesh: its vertex of the input; with full-edge collapses the one that it was before it moved
  std::vector<WedgeId> source_wedge;  ///< #W of mesh: its wedge of the input
  std::vector<FaceId> source_face;    ///< #F of mesh: its face of the input
  StopReason stop = StopReason::faces;
  std::size_t collapse_count = 0;
  double max_cost = 0;  ///< largest cost paid, in the metric's own unit
  /// Largest cost paid as a length in model units: for `qem` and `kim` the weighted root mean square distance of a target to all planes it
  /// then stands for, for the others
  /// with attributes that of position and attributes together, for `aps` the bound of the texture deviation.
  double error = 0;
  std::array<std::uint64_t, kRefusalCount> refusals{};                         ///< candidates refused when they were the least, by Refusal
  std::size_t interior_vertices = 0, curve_vertices = 0, locked_vertices = 0;  ///< of the input, by kind (VertexKind)
  InputRepair repair;
  std::size_t state_bytes = 0;             ///< of the metric, measured
  std::size_t state_bytes_per_vertex = 0;  ///< state_bytes over the vertices of the engine, rounded up
  std::vector<Landing> landings;           ///< #V of the input, on `mesh`; empty unless recorded
  /// Largest distance of a vertex of the input to its landing: no vertex is farther from `mesh` than that. Nothing unless landings are
  /// recorded.
  std::optional<double> distance_max;
  /// With a tolerance: the largest distance of a vertex of the input to the nearest point of all of `mesh`; at most distance_max, up to
  /// rounding.
  std::optional<double> distance_audited;
};

/// Collapses until the target or until nothing legal is left. The same bytes for every machine, compiler and thread count: double
/// arithmetic in a
/// written order, ties by lowest vertex, then lowest target.
/// InputError where the mesh has no faces, an index is out of range, a position or uv is not finite, a locked vertex does not exist, an
/// attribute of the
/// metric is missing, a corner of a chart has two wedges (full-edge collapses and qem5: weld first), or, with refuse_non_manifold, with
/// count and
/// place of what is not manifold.
[[nodiscard]] SimplifyResult simplify_mesh(const Mesh& mesh, const SimplifyOptions& options);

/// The face count that keeps `ratio` of `faces`: ratio·faces rounded to the nearest integer, halves up. ratio: 0 to 1 (InputError).
[[nodiscard]] std::size_t faces_for_ratio(std::size_t faces, double ratio);

}  // namespace etalon::simplify
