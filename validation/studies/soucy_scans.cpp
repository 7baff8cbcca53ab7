#include "validation/studies/soucy_scans.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/error.h"
#include "validation/studies/surface_shading.h"
#include "validation/verify/pictures.h"

namespace etalon::validation {
namespace {

/// The pattern's colour at every vertex's sample.
Mesh colored_by(const SoucyScan& scan, const Image& pattern) {
  Mesh mesh = scan.mesh;
  mesh.colors.clear();
  const auto sample = [](float at, double spacing, int count) {
    return std::clamp(static_cast<int>(std::floor(at / spacing)), 0, count - 1);
  };
  for (const Vec3f& p : mesh.positions) {
    const auto* c =
        pattern.channels<std::uint8_t>(sample(p.x, scan.grid.spacing, scan.grid.width), sample(p.y, scan.grid.spacing, scan.grid.height));
    mesh.colors.push_back({static_cast<float>(c[0]) / 255, static_cast<float>(c[1]) / 255, static_cast<float>(c[2]) / 255, 1});
  }
  return mesh;
}

/// |texture − pattern| where both cover, times `gain`, light on dark; blue elsewhere.
Image difference_picture(const DrawnView& original, const DrawnView& baked, const Image& pattern, int gain) {
  constexpr std::array<std::uint8_t, 3> kUncovered{52, 72, 120};
  Image image(pattern.width(), pattern.height(), kRgb8);
  for (int y = 0; y < pattern.height(); ++y)
    for (int x = 0; x < pattern.width(); ++x) {
      const bool both = *original.id.channels<std::uint32_t>(x + 1, y + 1) != kNoTriangle &&
                        *baked.id.channels<std::uint32_t>(x + 1, y + 1) != kNoTriangle;
      const auto *p = baked.color.channels<std::uint8_t>(x + 1, y + 1), *q = pattern.channels<std::uint8_t>(x, y);
      for (std::size_t c = 0; c < 3; ++c)
        image.channels<std::uint8_t>(x, y)[c] =
            both ? static_cast<std::uint8_t>(std::min(255, gain * std::abs(p[c] - q[c]))) : kUncovered[c];
    }
  return image;
}

/// Without the texels around the samples.
Image samples_of(const Image& picture, const SampleGrid& grid) {
  Image image(grid.width, grid.height, kRgb8);
  for (int y = 0; y < grid.height; ++y)
    for (int x = 0; x < grid.width; ++x) std::copy_n(picture.channels<std::uint8_t>(x + 1, y + 1), 3, image.channels<std::uint8_t>(x, y));
  return image;
}

std::uint64_t off_pattern_count(const DrawnView& original, const Image& pattern) {
  std::uint64_t off = 0;
  for (int y = 0; y < pattern.height(); ++y)
    for (int x = 0; x < pattern.width(); ++x)
      off += *original.id.channels<std::uint32_t>(x + 1, y + 1) != kNoTriangle &&
             !std::equal(pattern.channels<std::uint8_t>(x, y), pattern.channels<std::uint8_t>(x, y) + 3,
                         original.color.channels<std::uint8_t>(x + 1, y + 1));
  return off;
}

}  // namespace

int scan_steps(const SoucyScan& scan, const SoucyStudyOptions& options) {
  return static_cast<int>(scan.tolerances.size() * kSoucyPatterns.size() * options.map_sizes.size());
}

SoucyScanResult study_scan(const SoucyScan& scan, const SoucyTools& tools) {
  SoucyScanResult result;
  result.name = scan.name, result.unit = scan.unit, result.grid = scan.grid;
  for (const VerifyInput& input : scan.inputs)
    if (result.attribution.empty()) result.attribution = input.attribution;
  result.vertices = scan.mesh.vertex_count(), result.faces = scan.mesh.face_count();
  const auto seen = [&](const Mesh& mesh, const std::shared_ptr<const Image>& texture) {
    return tools.drawing.draw(scan.name, [&](const RasterState& state) { return orthographic_scene(mesh, texture, scan.grid, state); });
  };
  const Mesh lit = flat_shaded(scan.mesh, {-0.5, 0.6, 0.7});
  result.shaded = samples_of(on_paper(seen(lit, nullptr)), scan.grid);

  std::vector<Image> patterns;
  std::vector<Mesh> meshes;
  std::vector<DrawnView> originals;
  for (const SoucyPattern which : kSoucyPatterns) {
    patterns.push_back(soucy_pattern(which, scan.grid.width, scan.grid.height));
    meshes.push_back(colored_by(scan, patterns.back()));
    originals.push_back(seen(meshes.back(), nullptr));
    result.off_pattern += off_pattern_count(originals.back(), patterns.back());
  }
  for (const double tolerance : scan.tolerances) {
    for (std::size_t p = 0; p < kSoucyPatterns.size(); ++p)
      for (const int size : tools.options.map_sizes) {
        tools.step(fmt::format("{}: {} {}, {}, {}²", scan.name, tolerance, scan.unit, to_string(kSoucyPatterns[p]), size));
        bake::BakeOptions how{.tolerance = tolerance, .width = size, .height = size};
        const bake::BakeResult baked = bake::bake_scan(meshes[p], how);
        if (result.levels.empty() || result.levels.back().tolerance != tolerance)
          result.levels.push_back({.tolerance = tolerance,
                                   .vertices = baked.simplified.mesh.vertex_count(),
                                   .faces = baked.mesh.face_count(),
                                   .distance_max = baked.simplified.distance_audited.value_or(*baked.simplified.distance_max)});
        const DrawnView drawn = seen(baked.mesh, std::make_shared<const Image>(baked.texture));
        result.mappings.push_back({.level = result.levels.size() - 1,
                                   .pattern = kSoucyPatterns[p],
                                   .map_size = size,
                                   .texels = baked.texels,
                                   .iterations = baked.iterations,
                                   .seam_residual = baked.seam_residual,
                                   .reductions = baked.atlas.reductions,
                                   .wrong_means = wrong_mean_count(meshes[p], baked),
                                   .error = measure_pattern_error(originals[p], drawn, patterns[p], kSoucyPatterns[p]),
                                   .picture = samples_of(on_paper(drawn), scan.grid),
                                   .error_picture = difference_picture(originals[p], drawn, patterns[p], error_gain(kSoucyPatterns[p]))});
      }
  }
  return result;
}

}  // namespace etalon::validation
