#include <fmt/format.h>

#include <memory>

#include "core/bake/bake.h"
#include "core/procedural/knot.h"
#include "tests/determinism/canonical_hash.h"
#include "tests/determinism/jobs.h"

namespace etalon::test {
namespace {

using namespace bake;

std::string hash_of(const BakeResult& result) {
  CanonicalHash hash;
  hash.add(result.mesh);
  hash.add(result.texture);
  for (const std::uint64_t count : {result.texels.inside, result.texels.border, result.texels.hit, result.texels.averaged}) hash.add(count);
  hash.add(result.fill_distance_max);
  hash.add(result.simplified.distance_max.value_or(-1));
  return hash.hex();
}

}  // namespace

std::vector<HashedWay> bake_ways() {
  std::vector<HashedWay> ways;
  const auto scan = std::make_shared<const Mesh>(procedural::make_knot(procedural::knot_of_faces(10'000)));
  constexpr std::pair<FillKind, const char*> kFills[] = {
      {FillKind::iterative, "iterative"}, {FillKind::exact, "exact"}, {FillKind::sampled, "sampled"}};
  for (const auto& [kind, word] : kFills)
    for (const Gutter gutter : {Gutter{}, Gutter{1}})
      ways.push_back({fmt::format("bake knot {} {}", word, gutter ? "gutter 1" : "no gutter"), [=, kind = kind] {
                        return hash_of(
                            bake_scan(*scan, {.target_faces = 300, .width = 128, .height = 128, .fill = kind, .gutter = gutter}));
                      }});
  ways.push_back({"bake knot tolerance", [=] {
                    return hash_of(bake_scan(*scan, {.tolerance = 0.01 * bounding_box(*scan).diagonal(), .width = 128, .height = 128}));
                  }});
  return ways;
}

}  // namespace etalon::test
