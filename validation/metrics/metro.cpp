#include "validation/metrics/metro.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/float_environment.h"
#include "core/base/parallel.h"

namespace etalon::validation {

namespace {

/// Blocks between two calls of progress.
constexpr std::size_t kBatch = 64;

struct Sums {
  std::uint64_t count = 0;
  double sum = 0, squares = 0, max2 = -1;
  Vec3d max_at{0, 0, 0};
  double colour_sum = 0, colour_squares = 0, colour_max = 0;

  void add(const Sums& later) {
    count += later.count;
    sum += later.sum;
    squares += later.squares;
    if (later.max2 > max2) {
      max2 = later.max2;
      max_at = later.max_at;
    }
    colour_sum += later.colour_sum;
    colour_squares += later.colour_squares;
    colour_max = std::max(colour_max, later.colour_max);
  }
};

double colour_distance2(const Vec3d& color, const Mesh& to, const SurfacePoint& found) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const auto at = [&](int corner) { return static_cast<double>(to.colors[to.vertex(found.face, corner).index][k]); };
    const double d = found.weights.x * at(0) + found.weights.y * at(1) + found.weights.z * at(2) - color[k];
    sum += d * d;
  }
  return sum;
}

Sums measure_block(const SampleBlock& block, const Mesh& to, const NearestQuery& nearest, bool colours) {
  std::vector<SurfacePoint> found(block.points.size());
  nearest(block.points, found);
  Sums sums;
  sums.count = found.size();
  for (std::size_t i = 0; i < found.size(); ++i) {
    sums.sum += std::sqrt(found[i].distance2);
    sums.squares += found[i].distance2;
    if (found[i].distance2 > sums.max2) {
      sums.max2 = found[i].distance2;
      sums.max_at = block.points[i];
    }
    if (colours) {
      const double d2 = colour_distance2(block.colors[i], to, found[i]), d = std::sqrt(d2);
      sums.colour_sum += d;
      sums.colour_squares += d2;
      sums.colour_max = std::max(sums.colour_max, d);
    }
  }
  return sums;
}

}  // namespace

DirectedDistance measure_direction(const Mesh& from, const Mesh& to, const NearestQuery& nearest, std::uint64_t target,
                                   const std::function<void(std::size_t, std::size_t)>& progress) {
  const DefaultFloatEnvironment environment;
  const SurfaceSamples samples(from, target);
  const bool colours = !from.colors.empty() && !to.colors.empty();
  std::vector<Sums> blocks(samples.block_count());
  for (std::size_t first = 0; first < blocks.size(); first += kBatch) {
    if (progress) progress(first, blocks.size());
    parallel_for(std::min(kBatch, blocks.size() - first),
                 [&](std::size_t i) { blocks[first + i] = measure_block(samples.block(first + i), to, nearest, colours); });
  }
  Sums all;
  for (const Sums& block : blocks) all.add(block);

  DirectedDistance result{.samples = all.count,
                          .vertex_samples = samples.vertex_count(),
                          .edge_samples = samples.edge_count(),
                          .face_samples = samples.face_count()};
  const auto count = static_cast<double>(all.count);
  result.mean = all.sum / count;
  result.rms = std::sqrt(all.squares / count);
  result.max = std::sqrt(all.max2);
  result.max_at = all.max_at;
  if (colours) {
    result.colour_mean = all.colour_sum / count;
    result.colour_rms = std::sqrt(all.colour_squares / count);
    result.colour_max = all.colour_max;
  }
  return result;
}

SurfaceDistance measure_surfaces(const Mesh& a, const Mesh& b, const MetroOptions& options) {
  if (options.samples < 1 || options.samples > (std::uint64_t{1} << 40))
    throw InputError(fmt::format("samples: expected 1 to 2^40, got {}", options.samples));
  SurfaceDistance result;
  result.diagonal = bounding_box(a).diagonal();
  const auto direction = [&](const Mesh& from, const Mesh& to, std::size_t half) {
    const TriangleTree tree(to);
    const auto progress = [&](std::size_t done, std::size_t total) {
      if (options.progress) options.progress(half * total + done, 2 * total);
    };
    return measure_direction(
        from, to, [&](std::span<const Vec3d> points, std::span<SurfacePoint> found) { tree.nearest(points, found); }, options.samples,
        progress);
  };
  result.forward = direction(a, b, 0);
  result.backward = direction(b, a, 1);
  return result;
}

}  // namespace etalon::validation
