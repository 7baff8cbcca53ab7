#include <fmt/format.h>

#include <memory>

#include "core/adapt/adapt_map.h"
#include "core/adapt/analytic_map.h"
#include "core/mesh/weld.h"
#include "core/procedural/swirl.h"
#include "core/progressive/epm_format.h"
#include "core/progressive/progressive_mesh.h"
#include "raster/cpu_renderer.h"
#include "tests/determinism/canonical_hash.h"
#include "tests/determinism/jobs.h"

namespace etalon::test {
namespace {

using namespace adapt;
constexpr int kMap = 128;

// The swirl with all its levels and their cells; made once, with however many threads it is first asked for.
struct Levels {
  procedural::Model model = procedural::make_swirl({.faces = 1922, .texture_size = kMap});
  progressive::ProgressiveData data;
  progressive::ProgressiveMesh mesh;
  AdaptSequence sequence;

  explicit Levels(simplify::CollapseKind collapse)
      : data(progressive::make_progressive(welded_by_position(model.mesh),
                                           {.metric = simplify::MetricName::qem5, .collapse = collapse, .target_faces = 100})
                 .data),
        mesh(data),
        sequence(mesh) {}
};

// Down to the base and up again; both.
std::string taken_down_and_up(const Levels& levels, Image map, Filter filter) {
  CanonicalHash hash;
  raster::CpuRenderer renderer;
  const std::size_t finest = levels.sequence.size();
  (void)adapt_map(renderer, levels.sequence, finest, 0, map, {.filter = filter});
  hash.add(map);
  (void)adapt_map(renderer, levels.sequence, 0, finest, map, {.filter = filter});
  hash.add(map);
  return hash.hex();
}

}  // namespace

std::vector<HashedWay> adapt_ways() {
  std::vector<HashedWay> ways;
  for (const auto collapse : {simplify::CollapseKind::half, simplify::CollapseKind::full}) {
    const auto levels = std::make_shared<Levels>(collapse);
    const auto name = [&](const std::string& what) { return fmt::format("adapt swirl {} {}", to_string(collapse), what); };
    ways.push_back({name("epm"), [=] {
                      CanonicalHash hash;
                      hash.add(progressive::encode_epm(levels->data));
                      return hash.hex();
                    }});
    for (const ChannelType type : {ChannelType::float32, ChannelType::half, ChannelType::unorm16, ChannelType::unorm8})
      for (const Filter filter : {Filter::nearest, Filter::linear}) {
        const Image map = identity_map(kMap, kMap, type);
        ways.push_back({name(fmt::format("map {} {}", to_string(map.format()), filter == Filter::nearest ? "nearest" : "linear")),
                        [=] { return taken_down_and_up(*levels, map, filter); }});
      }
    ways.push_back({name("texture linear"), [=] { return taken_down_and_up(*levels, levels->model.texture, Filter::linear); }});
    ways.push_back({name("analytic"), [=] {
                      CanonicalHash hash;
                      hash.add(analytic_map(levels->sequence, 0, kMap, kMap));
                      return hash.hex();
                    }});
  }
  return ways;
}

}  // namespace etalon::test
