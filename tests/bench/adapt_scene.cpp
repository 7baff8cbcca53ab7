#include "tests/bench/adapt_scene.h"

#include <utility>

#include "core/adapt/adapt_map.h"
#include "core/mesh/weld.h"
#include "core/procedural/head.h"

namespace etalon::bench {

BenchScene adapt_scene(int size, Filter filter, std::size_t faces) {
  simplify::SimplifyOptions options;
  options.metric = simplify::MetricName::qem5;
  options.target_faces = faces;
  progressive::ProgressiveMesh mesh(progressive::make_progressive(welded_by_position(procedural::make_head().mesh), options).data);
  const adapt::AdaptSequence sequence(mesh);
  BenchScene scene;
  MapWork& work = scene.map_work.emplace();
  work.map = adapt::identity_map(size, size);
  work.filter = filter;
  // Down and up again: down alone, run after run, would turn the map into something that no adaptation meets.
  for (const auto& [from, to] : {std::pair{sequence.size(), std::size_t{0}}, {std::size_t{0}, sequence.size()}}) {
    const auto direction = to < from ? adapt::AdaptDirection::to_before : adapt::AdaptDirection::to_after;
    const auto pass_of = [&](std::span<const std::uint32_t> splits) {
      return adapt::cell_pass(sequence, splits, direction, size, size, {});
    };
    for (const auto& pack : adapt::pack_splits(sequence, from, to, size, size)) {
      work.packed.push_back(pass_of(pack));
      for (const std::uint32_t split : pack) work.one_by_one.push_back(pass_of({&split, 1}));
    }
  }
  return scene;
}

}  // namespace etalon::bench
