#include "core/joint/joint_levels.h"

#include <algorithm>
#include <span>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/joint/geometric.h"
#include "core/joint/joint_stream.h"
#include "core/joint/texel_view.h"

namespace etalon::joint {
namespace {

std::vector<std::uint32_t> distinct_counts(const terrain::HeightField& field, const LevelOptions& options) {
  std::vector<std::uint32_t> counts = terrain::geometric_counts(field.bits, options.from, options.to, options.meshes);
  counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
  return counts;
}

void make_meshes(const terrain::HeightField& field, const terrain::TerrainView& view, const LevelOptions& options, JointLevels& result) {
  const std::vector<double> weights = terrain::screen_weights(field, view);
  const terrain::RemovalOrder order = terrain::removal_order(field, {.rule = options.pruning, .weights = weights, .progress = {}});
  result.field = terrain::with_unit(field, options.height_unit_m);
  result.levels = terrain::make_levels(field.bits, order, distinct_counts(field, options));
  result.mesh_stream = terrain::encode_terrain(result.field, result.levels, view);
}

// A pyramid of distances sends its coefficients completely: quantised to steps of 8, which is 40 dB, as the rest is worth no bits beside a mesh's errors.
constexpr int kPyramidStepExponent = 3;

void make_textures(const Image& image, const LevelOptions& options, JointLevels& result) {
  const bool by_distance = options.pyramid == TexturePyramid::distance;
  if (by_distance && (options.textures < 2 || options.textures > kMostDistances))
    throw InputError(fmt::format("textures by distance: expected 2 to {} levels, got {}", kMostDistances, options.textures));
  if (by_distance) result.pyramid_steps = static_cast<int>(options.textures) - 1;
  const int levels = wavelet::default_levels(image.width(), image.height());
  const auto mesh_stream = std::as_bytes(std::span(result.mesh_stream.bytes));
  result.delays =
      delays_of(terrain::read_header(mesh_stream, terrain::kMaxGridBits), image.width(), image.height(), levels, result.pyramid_steps);
  wavelet::EncodeOptions encode{.kernel = options.kernel, .levels = levels, .delays = result.delays};
  if (by_distance) {
    encode.step_exponent = kPyramidStepExponent;
    for (int n = 0; n <= result.pyramid_steps; ++n) encode.complete_delays.push_back(n * wavelet::kPyramidStepPlanes);
  } else {
    encode.significant_shares = geometric_progression(options.from, options.to, options.textures);
    encode.stops_at_last_share = true;
  }
  wavelet::EncodedTexture encoded = wavelet::encode_texture(image, encode);
  for (std::size_t n = 0; n < encoded.points.size(); ++n) {
    const wavelet::StreamPoint& point = encoded.points[n];
    if (by_distance && point.significant == 0) continue;
    if (result.texture_ends_bytes.empty() || point.bytes > result.texture_ends_bytes.back()) {
      result.texture_ends_bytes.push_back(point.bytes), result.significant.push_back(point.significant);
      if (by_distance) result.texture_steps.push_back(0);
    }
    if (by_distance) result.texture_steps.back() = static_cast<int>(n);
  }
  if (result.texture_ends_bytes.empty())
    throw InputError(
        "texture: expected a coefficient other than 0, got a view that sees nothing of the image, or an image of one grey, 128");
  result.texture_stream = std::move(encoded.bytes);
  result.texture_stream.resize(result.texture_ends_bytes.back());
  result.significant_total = encoded.significant_total;
}

std::vector<std::uint64_t> bits_of(const std::vector<std::size_t>& ends_bytes, std::size_t head_bytes) {
  std::vector<std::uint64_t> bits;
  for (std::size_t n = 0; n < ends_bytes.size(); ++n) bits.push_back(8 * (head_bytes + ends_bytes[n] + (n + 1) * kSegmentHeadBytes));
  return bits;
}

}  // namespace

wavelet::Delays delays_of(const terrain::StreamHeader& mesh, int texture_width, int texture_height, int levels, int pyramid_steps) {
  if (!mesh.view) return {};
  const terrain::HeightField& grid = mesh.grid;
  const TerrainExtent extent{grid.bits, grid.spacing, grid.uv_start, grid.uv_step, mesh.lowest * grid.unit, mesh.highest * grid.unit};
  const wavelet::TexelView seen = texel_view(extent, *mesh.view, texture_width, texture_height);
  if (pyramid_steps == 0) return wavelet::view_delays(seen, {.levels = levels});
  return wavelet::distance_pyramid(seen,
                                   {.levels = levels, .steps = pyramid_steps, .per_octave_num = 3 * pyramid_steps, .per_octave_den = 10})
      .delays;
}

JointLevels make_joint_levels(const terrain::HeightField& field, const Image& image, const terrain::TerrainView& view,
                              const LevelOptions& options) {
  terrain::validate(field);
  JointLevels result;
  make_meshes(field, view, options, result);
  make_textures(image, options, result);
  result.mesh_bits = bits_of(result.mesh_stream.level_ends_bytes, kJointHeaderBytes);
  result.texture_bits = bits_of(result.texture_ends_bytes, 0);
  return result;
}

std::vector<Image> texture_levels(const JointLevels& levels) {
  std::vector<Image> images(levels.texture_ends_bytes.size());
  wavelet::decode_prefixes(levels.texture_stream, levels.texture_ends_bytes, levels.delays,
                           [&](std::size_t j, wavelet::DecodedTexture decoded) { images[j] = std::move(decoded.image); });
  return images;
}

double distance_of(const JointLevels& levels, std::size_t j) {
  if (levels.pyramid_steps == 0) return 1;
  return wavelet::power_of_two(10 * (levels.pyramid_steps - levels.texture_steps[j]), 3 * levels.pyramid_steps);
}

Problem problem_of(const JointLevels& levels, std::function<std::uint64_t(std::size_t, std::size_t)> error) {
  return {levels.mesh_bits, levels.texture_bits, std::move(error)};
}

}  // namespace etalon::joint
