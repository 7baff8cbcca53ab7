// The interpolation error: coordinates and depths of triangles by chance, against exact values, in units of the bound of docs/bounds.md.
#include <algorithm>
#include <cmath>

#include "core/base/rng.h"
#include "validation/bounded_triangle.h"
#include "validation/probe/device_probe.h"

namespace etalon::validation {
namespace {

constexpr int kFrame = 256, kGuard = 128, kTriangles = 48;

// Sizes from a few texels to the frame, uv near the image and away from it, depths anywhere.
DrawList scene(bool perspective, int bits, Rng& rng) {
  DrawList list;
  const auto one = std::int32_t{1} << bits;
  for (int t = 0; t < kTriangles; ++t) {
    const auto reach = std::int64_t{4} << rng.below(6);
    const std::int64_t x = rng.between(0, kFrame), y = rng.between(0, kFrame);
    const float scale = static_cast<float>(1 << rng.below(4));
    const auto first = static_cast<std::uint32_t>(list.vertices.size());
    for (int k = 0; k < 3; ++k) {
      const auto near = [&](std::int64_t c) {
        return static_cast<std::int32_t>(std::clamp<std::int64_t>(c * one + rng.between(-reach * one, reach * one), -kGuard * one,
                                                                  (kFrame + kGuard) * std::int64_t{one}));
      };
      RasterVertex v;
      v.x = near(x);
      v.y = near(y);
      v.z = rng.uniform(0, 1);
      v.w = perspective ? rng.uniform(0.5f, 5) : 1;
      v.uv.x = rng.uniform(-scale, scale);
      v.uv.y = rng.uniform(0, 1);
      list.vertices.push_back(v);
    }
    list.triangles.push_back({first, first + 1, first + 2});
  }
  list.draws = {{.triangle_count = kTriangles}};
  return list;
}

struct Measured {
  InterpolationFinding& finding;
  // The device's value over the bound of the shape with factor 1.
  void add(double value, double exact, double bound, const std::array<double, 3>& a, double& largest) {
    if (is_useless(bound, a) || !(bound > 0)) {
      ++finding.unbounded;
      return;
    }
    ++finding.samples;
    const double error = std::abs(value - exact);
    // NaN is no distance from anything.
    largest = std::isfinite(error) ? std::max(largest, error / bound) : HUGE_VAL;
  }
};

}  // namespace

double InterpolationFinding::largest() const { return std::max({affine, perspective, depth}); }

InterpolationFinding probe_interpolation(Renderer& device, const ProbeOptions& options, int subtexel_bits) {
  Rng rng(2);
  InterpolationFinding finding;
  Measured measured{finding};
  const DeviceModel shape = measured_model("shape", 1, "");
  Frame frame;
  frame.width = frame.height = kFrame;
  frame.guard = kGuard;
  frame.state = device.supported_state({.subtexel_bits = subtexel_bits});
  frame.targets = {{.content = TargetContent::coordinate, .format = kRg32f},
                   {.content = TargetContent::triangle_id, .format = kR32ui},
                   {.content = TargetContent::depth, .format = kR32f}};
  for (int n = 0; n < options.interpolation_frames; ++n) {
    if (options.progress) options.progress("interpolation", n, options.interpolation_frames);
    const bool perspective = n % 2 == 1;
    const DrawList list = scene(perspective, frame.state.subtexel_bits, rng);
    const std::vector<Image> images = device.render(list, frame);
    std::vector<BoundedTriangle> triangles;
    for (std::uint32_t t = 0; t < list.triangles.size(); ++t) triangles.emplace_back(list, t, frame, shape);
    for (int y = 0; y < kFrame; ++y) {
      for (int x = 0; x < kFrame; ++x) {
        const std::uint32_t id = *images[1].channels<std::uint32_t>(x, y);
        // A texel that the triangle does not cover is a matter of coverage, which has its own experiment.
        if (id >= triangles.size() || !triangles[id].evaluator().draws() || !triangles[id].evaluator().covers(x, y)) continue;
        BoundedTriangle& triangle = triangles[id];
        const Sample s = triangle.evaluator().sample(x, y);
        const Coordinate at = triangle.coordinate(s);
        const Bounded depth = triangle.depth(s);
        const float* uv = images[0].channels<float>(x, y);
        double& largest = perspective ? finding.perspective : finding.affine;
        measured.add(static_cast<double>(uv[0]), at.u, at.error_u, triangle.evaluator().u(), largest);
        measured.add(static_cast<double>(uv[1]), at.v, at.error_v, triangle.evaluator().v(), largest);
        measured.add(static_cast<double>(*images[2].channels<float>(x, y)), depth.value, depth.bound, triangle.evaluator().z(),
                     finding.depth);
      }
    }
  }
  return finding;
}

}  // namespace etalon::validation
