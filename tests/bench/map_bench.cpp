#include "tests/bench/map_bench.h"

#include <algorithm>

#include "raster/cpu_renderer.h"

namespace etalon::bench {

double differing_share(const Image& a, const Image& b) {
  return static_cast<double>(differing_texels(a, b)) / static_cast<double>(a.texel_count());
}

MapBench::MapBench(const MapWork& work, gpu::Context* context) : context_(context) {
  const MapState state{work.filter, {}};
  raster::CpuRenderer renderer;
  ours_ = renderer.make_map(work.map, state);  // our maps do not need the renderer again
  ours_->apply(work.packed);
  for (const MapPass& pass : work.packed) work_.vertices += pass.vertices.size(), work_.triangles += pass.triangles.size();
  work_.covered_texels = work_.lookups = ours_->texels_written();
  work_.lookup_bytes = static_cast<std::uint64_t>(bytes_per_texel(work.map.format()));
  work_.table_texels = work.map.texel_count();
  const std::uint64_t at_once = std::min<std::uint64_t>(work_.lookups, work_.table_texels);
  gather_ = std::make_unique<GatherLimit>(at_once, work_.table_texels, work_.lookup_bytes, GatherOrder::affine);
  gather_runs_ = (work_.lookups + at_once / 2) / at_once;
  if (context == nullptr) return;
  rival_ = std::make_unique<gpu::GlMap>(*context, gpu::GlPipeline(*context).limits(), work.map, state);
  apply_rival(work.packed);
  differing_share_ = bench::differing_share(ours_->read_back(), rival_->read_back());
}

void MapBench::apply_ours(const std::vector<MapPass>& passes) { ours_->apply(passes); }

void MapBench::apply_rival(const std::vector<MapPass>& passes) {
  rival_->apply(passes);
  context_->gl().finish();
}

void MapBench::run_limit() {
  for (std::uint64_t n = 0; n < gather_runs_; ++n) gather_->run();
}

}  // namespace etalon::bench
