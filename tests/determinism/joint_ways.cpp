#include <span>

#include "core/joint/exhaustive_search.h"
#include "core/joint/joint_stream.h"
#include "core/joint/marginal_analysis.h"
#include "core/procedural/alps.h"
#include "core/terrain/levels.h"
#include "raster/cpu_renderer.h"
#include "tests/determinism/canonical_hash.h"
#include "tests/determinism/jobs.h"
#include "validation/joint/terrain_problem.h"
#include "validation/joint/terrain_views.h"

namespace etalon::test {
namespace {

using terrain::PruningRule;

struct Terrain {
  terrain::HeightField field;
  Image image;
  terrain::TerrainView view;
};

Terrain small_alps() {
  procedural::Alps alps = procedural::make_alps({.size = 65, .texture_size = 128, .progress = {}});
  terrain::DemOptions how;
  how.dem_spacing = alps.spacing;
  Terrain result{terrain::make_height_field(alps.dem, how).field, std::move(alps.texture), {}};
  result.view = validation::terrain_overview(result.field, 160, 120).view;
  return result;
}

void add_bytes(CanonicalHash& hash, std::span<const std::byte> bytes) {
  for (const std::byte byte : bytes) hash.add(std::to_integer<std::uint8_t>(byte));
}

std::string terrain_hash(PruningRule rule, bool is_screen) {
  const Terrain alps = small_alps();
  const std::vector<double> weights = is_screen ? terrain::screen_weights(alps.field, alps.view) : std::vector<double>();
  const terrain::RemovalOrder order = terrain::removal_order(alps.field, {.rule = rule, .weights = weights, .progress = {}});
  const int bits = alps.field.bits;
  const terrain::Levels levels = terrain::make_levels(bits, order, terrain::geometric_counts(bits, 0.005, 0.5, 9));
  const auto view = is_screen ? std::optional(alps.view) : std::nullopt;
  CanonicalHash hash;
  for (const std::int32_t height : alps.field.heights) hash.add(static_cast<std::uint32_t>(height));
  hash.add(order.points);
  for (const std::int64_t cost : order.costs) hash.add(static_cast<std::uint64_t>(cost));
  hash.add(order.quantum);
  hash.add(terrain::encode_terrain(alps.field, levels, view).bytes);
  hash.add(terrain::level_mesh(alps.field, levels, levels.count() - 1));
  return hash.hex();
}

std::string texture_hash(wavelet::Kernel kernel) {
  const std::vector<std::byte> stream = wavelet::encode_texture(small_alps().image, {.kernel = kernel}).bytes;
  CanonicalHash hash;
  add_bytes(hash, stream);
  for (const std::size_t divisor : {40, 5, 1}) hash.add(wavelet::decode_texture(std::span(stream).first(stream.size() / divisor)).image);
  return hash.hex();
}

// Errors on the screen of all pairs; the file of each rule's path, either direction.
std::string pairs_hash() {
  const Terrain alps = small_alps();
  raster::CpuRenderer exact;
  validation::TerrainProblem terrain(exact, alps.field, alps.image, alps.view, {.meshes = 8, .textures = 11, .from = 0.01, .to = 0.4});
  const joint::Problem problem = terrain.problem();
  CanonicalHash hash;
  hash.add(joint::evaluate_all(problem).errors);
  for (const joint::StepRule rule : {joint::StepRule::slope, joint::StepRule::printed, joint::StepRule::budget})
    for (const joint::Direction direction : {joint::Direction::prune, joint::Direction::grow})
      add_bytes(hash, joint::encode_joint(terrain.levels(), joint::marginal_analysis(problem, {.rule = rule, .direction = direction})));
  return hash.hex();
}

}  // namespace

std::vector<HashedWay> joint_ways() {
  return {{"joint terrain merging domains surface", [] { return terrain_hash(PruningRule::merging_domains, false); }},
          {"joint terrain merging domains screen", [] { return terrain_hash(PruningRule::merging_domains, true); }},
          {"joint terrain saturated surface", [] { return terrain_hash(PruningRule::saturated, false); }},
          {"joint terrain saturated screen", [] { return terrain_hash(PruningRule::saturated, true); }},
          {"joint texture 5/3", [] { return texture_hash(wavelet::Kernel::reversible_5_3); }},
          {"joint texture 9/7", [] { return texture_hash(wavelet::Kernel::irreversible_9_7); }},
          {"joint pairs", pairs_hash}};
}

}  // namespace etalon::test
