// How far two surfaces are apart, in both directions, in space and in colour [Cignoni, Rocchini & Scopigno 1998].
// Does not decide whether that is near enough.
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "core/mesh/triangle_tree.h"
#include "validation/metrics/surface_samples.h"

namespace etalon::validation {

/// From the samples of one surface to the nearest points of the other.
struct DirectedDistance {
  std::uint64_t samples = 0, vertex_samples = 0, edge_samples = 0, face_samples = 0;
  double mean = 0, rms = 0, max = 0;                          ///< model units
  Vec3d max_at{0, 0, 0};                                      ///< the first sample that is farthest
  std::optional<double> colour_mean, colour_rms, colour_max;  ///< Euclidean in [0, 1]³ RGB; where both surfaces have colours
};

struct SurfaceDistance {
  DirectedDistance forward;   ///< from a to b
  DirectedDistance backward;  ///< from b to a
  double diagonal = 0;        ///< of a's bounding box
  /// The larger of the two directions.
  [[nodiscard]] double mean() const { return forward.mean > backward.mean ? forward.mean : backward.mean; }
  [[nodiscard]] double rms() const { return forward.rms > backward.rms ? forward.rms : backward.rms; }
  [[nodiscard]] double max() const { return forward.max > backward.max ? forward.max : backward.max; }
  [[nodiscard]] std::optional<double> colour_rms() const {
    if (!forward.colour_rms || !backward.colour_rms) return std::nullopt;
    return *forward.colour_rms > *backward.colour_rms ? forward.colour_rms : backward.colour_rms;
  }
};

struct MetroOptions {
  std::uint64_t samples = 1'000'000;                                  ///< of each direction, about (surface_samples.h); 1 to 2^40
  std::function<void(std::size_t done, std::size_t total)> progress;  ///< blocks of both directions; an exception stops the work
};

/// Distances are those of nearest_on_triangle(); among faces at equal distance the lowest gives the colour. Sums are taken in double within each block
/// of samples and then over the blocks in order, so every figure is the same bytes for any number of threads, and equal to asking every
/// face for every sample. InputError as TriangleTree, and for samples out of range.
[[nodiscard]] SurfaceDistance measure_surfaces(const Mesh& a, const Mesh& b, const MetroOptions& options = {});

/// Fills in what each point found on the other surface; called from several threads.
using NearestQuery = std::function<void(std::span<const Vec3d> points, std::span<SurfacePoint> found)>;
/// One direction, the search given by the caller: how tests put a slow judge in the tree's place.
[[nodiscard]] DirectedDistance measure_direction(const Mesh& from, const Mesh& to, const NearestQuery& nearest, std::uint64_t samples,
                                                 const std::function<void(std::size_t done, std::size_t total)>& progress = {});

}  // namespace etalon::validation
