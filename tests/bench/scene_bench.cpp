#include "tests/bench/scene_bench.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include <benchmark/benchmark.h>

#include "tests/bench/fan_scene.h"

namespace etalon::bench {
namespace {

constexpr std::uint32_t kFansPerBind = 256;

struct Goal {
  const char* scene;
  const char* rival;
  double ratio;
};

// At two threads each, with AVX2.
constexpr Goal kGoals[] = {
    {"small_triangles", kRivalDraw, 2},
    {"head_nearest", kRivalDraw, 2},
    {"head_linear", kRivalDraw, 1},
    {"real_head_nearest", kRivalDraw, 2},
    {"real_head_linear", kRivalDraw, 1},
    {"screen", kRivalDraw, 1},
    {"screen_half_texel", kRivalDraw, 1},
    {"screen_rotated", kRivalDraw, 1},
    {kFans, kRivalOneFan, 10},
    {kFans, kRivalManyFans, 4},
    {"adapt_linear_1024", kRivalOneByOne, 4},
    {"adapt_linear_1024", kRivalPacked, 1.5},
    {"adapt_linear_256", kRivalOneByOne, 10},
    {"adapt_linear_256", kRivalPacked, 3},
    {"knot", kRivalDraw, 2},
    {"terrain", kRivalDraw, 2},
};

double goal_of(const std::string& scene, const std::string& rival) {
  for (const Goal& goal : kGoals)
    if (scene == goal.scene && rival == goal.rival) return goal.ratio;
  return 0;
}

// Into the images of the round before, as the rival draws into its framebuffer.
void render_at(raster::SimdLevel level, const BenchScene& scene, std::vector<Image>& images) {
  raster::set_simd_level(level);
  raster::CpuRenderer renderer;
  renderer.render_into(scene.list, scene.frame, images);
  benchmark::DoNotOptimize(images.data());
}

/// What the device's maps hold: the source where no fan is; ours has the clear there.
Image drawn_over_source(const BenchScene& scene) {
  Frame with_ids = scene.frame;
  with_ids.targets.push_back({TargetContent::triangle_id, kR32ui});
  raster::CpuRenderer renderer;
  std::vector<Image> images = renderer.render(scene.list, with_ids);
  const Image& source = *scene.list.images.front();
  for (int y = 0; y < source.height(); ++y)
    for (int x = 0; x < source.width(); ++x)
      if (*images[1].channels<std::uint32_t>(x, y) == kNoTriangle)
        std::memcpy(images[0].texel(x, y), source.texel(x, y), static_cast<std::size_t>(bytes_per_texel(source.format())));
  return std::move(images[0]);
}

}  // namespace

raster::SimdLevel reference_level() {
  const auto levels = raster::available_simd_levels();
  return std::ranges::find(levels, raster::SimdLevel::avx2) != levels.end() ? raster::SimdLevel::avx2 : levels.back();
}

std::string ours_at(raster::SimdLevel level) { return "ours, " + to_string(level); }

SceneBench::SceneBench(const SceneEntry& entry, BenchScene scene, const SceneBenchOptions& options) : scene_(std::move(scene)) {
  result_.name = entry.name;
  result_.title = entry.title;
  if (scene_.map_work) {
    add_map_work(options);
    return;
  }
  if (options.only_ours) {
    add(kOurs, [this] { render_at(reference_level(), scene_, images_); });
    return;
  }
  result_.work = work_of(scene_);
  // Rival and ours stand side by side in a round.
  if (options.context != nullptr && entry.name == kFans) add_fan_rival(*options.context);
  if (options.context != nullptr && entry.name != kFans) add_rival(*options.context);
  add_ours(options.levels);
  add_limits();
}

void SceneBench::add_ours(const std::vector<raster::SimdLevel>& levels) {
  add(kOurs, [this] { render_at(reference_level(), scene_, images_); });
  for (const raster::SimdLevel level : levels) add(ours_at(level), [this, level] { render_at(level, scene_, images_); });
  add(kValidation, [this] { validate(scene_.list, scene_.frame); });
  raster::set_simd_level(reference_level());
  raster::CpuRenderer renderer;
  benchmark::DoNotOptimize(renderer.render(scene_.list, scene_.frame));
  result_.counters = renderer.counters();
}

void SceneBench::add_rival_way(const std::string& name, const Image& ours, const Image& theirs, std::function<void()> run) {
  result_.rivals.push_back({name, goal_of(result_.name, name), differing_share(ours, theirs)});
  add(name, std::move(run));
}

void SceneBench::add_rival(gpu::Context& context) {
  rival_ = std::make_unique<GlRival>(context, scene_);
  raster::CpuRenderer renderer;
  const Image ours = renderer.render(scene_.list, scene_.frame).front();
  rival_->draw_and_read_back();
  add_rival_way(kRivalDraw, ours, rival_->image(), [this] { rival_->draw(); });
  add_rival_way(kRivalReadBack, ours, rival_->image(), [this] { rival_->draw_and_read_back(); });
}

void SceneBench::add_fan_rival(gpu::Context& context) {
  fan_rival_ = std::make_unique<FanRival>(context, scene_);
  const Image ours = drawn_over_source(scene_);
  for (const auto& [name, fans] : {std::pair{kRivalOneFan, 1u}, {kRivalManyFans, kFansPerBind}}) {
    fan_rival_->reset();
    fan_rival_->draw_back_and_forth(fans);
    add_rival_way(name, ours, fan_rival_->back_and_forth_map(), [this, n = fans] { fan_rival_->draw_back_and_forth(n); });
  }
  fan_rival_->draw_at_once();
  add_rival_way(kRivalAllFans, ours, fan_rival_->map_at_once(), [this] { fan_rival_->draw_at_once(); });
}

void SceneBench::add_map_work(const SceneBenchOptions& options) {
  map_bench_ = std::make_unique<MapBench>(*scene_.map_work, options.context);
  const auto ours = [this](const char* name, raster::SimdLevel level, const std::vector<MapPass>& passes) {
    add(name, [this, level, &passes] {
      raster::set_simd_level(level);
      map_bench_->apply_ours(passes);
    });
  };
  const MapWork& work = *scene_.map_work;
  if (options.context != nullptr) {
    for (const auto& [name, passes] : {std::pair{kRivalOneByOne, &work.one_by_one}, {kRivalPacked, &work.packed}}) {
      result_.rivals.push_back({name, goal_of(result_.name, name), map_bench_->differing_share()});
      add(name, [this, passes = passes] { map_bench_->apply_rival(*passes); });
    }
  }
  ours(kOurs, reference_level(), work.packed);
  if (options.only_ours) return;
  ours(kOursOneByOne, reference_level(), work.one_by_one);
  for (const raster::SimdLevel level : options.levels) ours(ours_at(level).c_str(), level, work.packed);
  result_.work = map_bench_->work();
  add(kGather, [this] { map_bench_->run_limit(); });
  result_.gather_method = map_bench_->gather_method();
}

void SceneBench::add_limits() {
  const SceneWork& work = result_.work;
  const std::uint64_t texture_bytes = std::min(work.table_texels, work.lookups) * work.lookup_bytes;
  copy_ = std::make_unique<CopyLimit>((work.input_bytes + texture_bytes + work.frame_bytes) / 2);
  add(kCopy, [this] { copy_->run(); });
  if (work.lookups == 0) return;
  for (const auto& [name, order] : {std::pair{kGather, GatherOrder::affine}, {kRandomGather, GatherOrder::random}}) {
    gathers_.push_back(std::make_unique<GatherLimit>(work.lookups, work.table_texels, work.lookup_bytes, order));
    add(name, [gather = gathers_.back().get()] { gather->run(); });
  }
  result_.gather_method = gathers_.front()->method();
}

void SceneBench::measure_round() {
  (void)others_.share();
  bench::measure_round(result_.ways);
  result_.others.push_back(others_.share());
}

void SceneBench::drop_rounds() {
  result_.others.clear();
  choose_runs(result_.ways);
}

}  // namespace etalon::bench
