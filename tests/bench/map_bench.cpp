#include "tests/bench/map_bench.h"

#include <algorithm>
#include <cstring>

#include "raster/cpu_renderer.h"

namespace etalon::bench {

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
  const Image a = ours_->read_back(), b = rival_->read_back();
  const auto texel_bytes = static_cast<std::size_t>(bytes_per_texel(a.format()));
  std::size_t different = 0;
  for (std::size_t n = 0; n < a.texel_count(); ++n)
    different += std::memcmp(a.bytes().data() + n * texel_bytes, b.bytes().data() + n * texel_bytes, texel_bytes) != 0 ? 1 : 0;
  differing_share_ = static_cast<double>(different) / static_cast<double>(a.texel_count());
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
