// Adapting a map (a texture or an indexing map) from level to level by drawing cells [Chen & Chuang 2006, sec. 3.3, 3.4].
#pragma once

#include <functional>
#include <span>

#include "core/adapt/adapt_sequence.h"
#include "core/adapt/gutter.h"
#include "core/adapt/map_format.h"
#include "core/draw/renderer.h"
#include "core/draw/state.h"

namespace etalon::adapt {

struct AdaptOptions {
  Filter filter = Filter::linear;  ///< of the lookups in the map before
  /// Where set, texels beside charts are kept as linear lookups need them. It must be at level `from` and have the map's size (ETALON_CHECK);
  /// it goes to level `to`, even where the map does not get there.
  Gutter* gutter = nullptr;
  /// Called after some packs with packs done and in all; an exception stops the work and leaves `map` as it was.
  std::function<void(std::size_t done, std::size_t total)> progress;
};

struct AdaptCounts {
  std::size_t adaptations = 0, packs = 0;
  std::uint64_t texels = 0;  ///< written; 0 where the renderer does not count
  /// With a gutter: its texels written; texels in no cell inside a ring, and in several, summed over the splits (GutterPlan).
  std::size_t gutter = 0, uncovered = 0, doubled = 0;
};

/// How far apart pack_splits() must keep regions. A lookup reads one texel beyond the cells. With a gutter a split writes kGutterTexels beyond
/// them, reads one more, and its plan looks at the charts kGutterTexels beyond what it writes: two regions that are grown by 3 and still apart keep
/// the one from reading, or planning with, what the other changes, since 2·3 >= max(2 + 3, 2·2).
[[nodiscard]] constexpr int pack_reach(bool with_gutter) {
  static_assert(kGutterTexels == 2);
  return with_gutter ? 3 : 1;
}

/// The cells of `splits` (disjoint regions, see pack_splits), a group each, as one pass over a map of that size: corners on the sub-texel grid of
/// `state`, their coordinates in the map before. Where snapping lets two cells of a split have a texel, the lower one is drawn last. Texels of
/// `gutter` come after the cells of their split, each as a triangle of its own with one coordinate.
[[nodiscard]] MapPass cell_pass(const AdaptSequence& sequence, std::span<const std::uint32_t> splits, AdaptDirection direction, int width,
                                int height, const RasterState& state, const GutterPlan* gutter = nullptr);

/// Takes the map from level `from` to level `to`, down or up. A texel changes where a cell covers its centre; one that no cell covers keeps its
/// value, or takes what the gutter's plan says. UnavailableError where the renderer does not support the map's format.
AdaptCounts adapt_map(Renderer& renderer, const AdaptSequence& sequence, std::size_t from, std::size_t to, Image& map,
                      const AdaptOptions& options = {});

}  // namespace etalon::adapt
