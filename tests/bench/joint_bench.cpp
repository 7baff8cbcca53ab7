#include "tests/bench/joint_bench.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <sstream>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/io/image_file.h"
#include "core/joint/exhaustive_search.h"
#include "core/joint/marginal_analysis.h"
#include "core/procedural/alps.h"
#include "core/terrain/removal_order.h"
#include "raster/cpu_renderer.h"
#include "tests/bench/child.h"
#include "tests/bench/simplify_way.h"
#include "tests/bench/texture_bench.h"
#include "tests/support/skip.h"
#include "validation/joint/terrain_views.h"
#include "validation/report/run_info.h"

namespace etalon::bench {
namespace {

constexpr const char *kDavosdorf = "joint-davosdorf", *kAlps = "joint-alps", *kQuadtree = "terrain-quadtree";
constexpr int kSides[] = {257, 513, 1025, 2049, 4097};
constexpr int kLongSide = 2049;  ///< from here on --long
constexpr std::size_t kCompareStep = 97;

double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::optional<JointTerrain> davosdorf() {
  const auto dem = test::data_file("davosdorf/davosdorf.tif"), image = test::data_file("davosdorf/davosdorf_color.tif");
  if (!dem || !image) return std::nullopt;
  terrain::DemOptions how;
  how.window = terrain::DemWindow{32, 0, 495};
  how.grid_bits = 8;
  return JointTerrain{terrain::make_height_field(io::read_image(*dem), how).field,
                      resampled(columns(io::read_image(*image), 32, 495), 512, 512)};
}

std::optional<JointTerrain> alps() {
  procedural::Alps alps = procedural::make_alps();
  terrain::DemOptions how;
  how.dem_spacing = alps.spacing;
  return JointTerrain{terrain::make_height_field(alps.dem, how).field, std::move(alps.texture)};
}

double differing_share(const Image& ours, const Image& theirs) {
  std::size_t differing = 0;
  for (std::size_t n = 0; n < ours.texel_count(); ++n) {
    const auto* const a = ours.channels<std::uint8_t>(0, 0) + 4 * n;
    const auto* const b = theirs.channels<std::uint8_t>(0, 0) + 4 * n;
    bool same = true;
    for (int c = 0; c < 3; ++c) same = same && std::abs(a[c] - b[c]) <= kSameByte;
    differing += same ? 0 : 1;
  }
  return static_cast<double>(differing) / static_cast<double>(ours.texel_count());
}

void compare_with_full_renderings(validation::TerrainProblem& terrain, const joint::AllPairs& all, JointBenchResult& result) {
  raster::CpuRenderer exact;
  const Image& reference = terrain.errors().reference();
  for (std::size_t n = 0; n < result.pairs(); n += kCompareStep) {
    const joint::Pair pair{n / result.textures, n % result.textures};
    const auto texture = std::make_shared<const Image>(validation::opaque_rgba(terrain.textures()[pair.texture]));
    const Image full = validation::draw_in_two_passes(exact, terrain.mesh(pair.mesh), texture, terrain.frame());
    std::uint64_t sse = 0;
    for (std::size_t k = 0; k < full.bytes().size(); ++k) {
      const int d = std::to_integer<int>(full.bytes()[k]) - std::to_integer<int>(reference.bytes()[k]);
      if (k % 4 != 3) sse += static_cast<std::uint64_t>(d * d);
    }
    ++result.compared;
    result.equal += full == terrain.errors().picture(pair.mesh, pair.texture) && sse == all.error(pair) ? 1 : 0;
  }
}

void measure_rival(PairRival& rival, validation::TerrainProblem& terrain, JointBenchResult& result) {
  Image picture(terrain.frame().width, terrain.frame().height, kRgba8);
  result.rival_pairs = 0;
  const double cpu = process_cpu_seconds();
  const double seconds = seconds_of([&] {
    for (std::size_t n = 0; n < result.pairs(); n += kRivalStep, ++result.rival_pairs)
      rival.draw_and_read_back({n / result.textures, n % result.textures}, picture);
  });
  result.rival_pair.push_back(seconds / static_cast<double>(result.rival_pairs));
  result.rival_pair_cpu.push_back((process_cpu_seconds() - cpu) / static_cast<double>(result.rival_pairs));
  const joint::Pair finest{result.meshes - 1, result.textures - 1};
  rival.draw_and_read_back(finest, picture);
  result.differing = differing_share(terrain.errors().picture(finest.mesh, finest.texture), picture);
}

}  // namespace

std::vector<JointScene> joint_scenes() {
  return {{.name = kDavosdorf, .title = "Davos Dorf, 257² heights, 512² texels", .make = davosdorf},
          {.name = kAlps, .title = "`make terrain`, 257² heights, 1024² texels", .make = alps}};
}

JointBenchResult measure_joint(const JointScene& scene, const JointTerrain& terrain, const MakePairRival& make_rival, int rounds,
                               const joint::LevelOptions& levels, int width, int height) {
  JointBenchResult result{.name = scene.name, .title = scene.title};
  raster::CpuRenderer exact;
  const terrain::TerrainView view = validation::terrain_views(exact, terrain.field, width, height).front().view;
  std::unique_ptr<validation::TerrainProblem> made;
  result.level_seconds =
      seconds_of([&] { made = std::make_unique<validation::TerrainProblem>(exact, terrain.field, terrain.image, view, levels); });
  validation::TerrainProblem& levels_made = *made;
  const joint::Problem problem = levels_made.problem();
  result.meshes = problem.mesh_bits.size(), result.textures = problem.texture_bits.size();
  std::unique_ptr<PairRival> rival;
  if (make_rival)
    rival = make_rival(levels_made);
  else
    result.skipped = "no device";
  joint::AllPairs all;
  for (int round = 0; round < rounds; ++round) {
    levels_made.errors().forget_drawings();
    result.marginal.push_back(seconds_of([&] { result.evaluations = joint::marginal_analysis(problem).evaluations; }));
    levels_made.errors().forget_drawings();
    const double cpu = process_cpu_seconds();
    result.exhaustive.push_back(seconds_of([&] { all = joint::evaluate_all(problem); }));
    result.exhaustive_cpu.push_back(process_cpu_seconds() - cpu);
    if (rival) measure_rival(*rival, levels_made, result);
  }
  compare_with_full_renderings(levels_made, all, result);
  return result;
}

int quadtree_child(const std::vector<std::string>& arguments) {
  if (arguments.size() != 1) throw InputError("--quadtree-child: expected the points on a side");
  set_thread_count(1);
  terrain::HeightField field;
  {
    procedural::Alps alps = procedural::make_alps({.size = std::stoi(arguments[0]), .texture_size = 64, .progress = {}});
    terrain::DemOptions how;
    how.dem_spacing = alps.spacing;
    field = terrain::make_height_field(alps.dem, how).field;
  }
  std::size_t points = 0;
  const double start = process_cpu_seconds();
  points = terrain::removal_order(field).points.size();
  const double seconds = process_cpu_seconds() - start;
  const auto peak = validation::current_run(std::chrono::steady_clock::now()).peak_bytes;
  fmt::print("{:.6f} {} {}\n", seconds, peak, points);
  return 0;
}

QuadtreeCost measure_quadtree(const std::string& program, int side) {
  const ScratchDirectory scratch;
  const ChildCost cost = run_program({program, kQuadtreeChild, std::to_string(side)}, scratch / "errors");
  QuadtreeCost result{.side = side};
  std::istringstream words(cost.output);
  std::size_t points = 0;
  if (cost.exit_code != 0 || !(words >> result.order_seconds >> result.peak_bytes >> points))
    throw UnavailableError(fmt::format("quadtree of {0}x{0}: ended with exit code {1}", side, cost.exit_code));
  return result;
}

std::vector<std::pair<std::string, std::string>> joint_scene_titles() {
  std::vector<std::pair<std::string, std::string>> titles;
  for (const JointScene& scene : joint_scenes()) titles.emplace_back(scene.name, "both searches of a view beside llvmpipe: " + scene.title);
  titles.emplace_back(kQuadtree, "quadtree of 257² to 1025² heights; to 4097² with --long");
  return titles;
}

JointScenes measure_joint_scenes(const BenchOptions& options, const std::string& program, const MakePairRival& make_rival) {
  JointScenes scenes;
  for (const JointScene& scene : joint_scenes()) {
    if (!wants(options, scene.name)) continue;
    if (const std::optional<JointTerrain> terrain = scene.make())
      scenes.joint.push_back(measure_joint(scene, *terrain, make_rival, std::min(options.repetitions, kFewestRounds)));
    else
      scenes.absent.push_back(scene.name);
  }
  if (wants(options, kQuadtree))
    for (const int side : kSides)
      if (side < kLongSide || options.long_scenes) scenes.quadtrees.push_back(measure_quadtree(program, side));
  return scenes;
}

}  // namespace etalon::bench
