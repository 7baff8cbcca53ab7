// Adapting a map (a texture or an indexing map) from level to level by drawing cells [Chen & Chuang 2006, sec. 3.3, 3.4].
#pragma once

#include <functional>
#include <span>

#include "core/adapt/adapt_sequence.h"
#include "core/adapt/map_format.h"
#include "core/draw/renderer.h"
#include "core/draw/state.h"

namespace etalon::adapt {

struct AdaptOptions {
  Filter filter = Filter::linear;  ///< of the lookups in the map before
  /// Called after some packs with packs done and in all; an exception stops the work and leaves `map` as it was.
  std::function<void(std::size_t done, std::size_t total)> progress;
};

struct AdaptCounts {
  std::size_t adaptations = 0, packs = 0;
  std::uint64_t texels = 0;  ///< written; 0 where the renderer does not count
};

/// The cells of `splits` (disjoint regions, see pack_splits), a group each, as one pass over a map of that size: corners on the sub-texel grid of
/// `state`, their coordinates in the map before. Where snapping lets two cells of a split have a texel, the lower one is drawn last.
[[nodiscard]] MapPass cell_pass(const AdaptSequence& sequence, std::span<const std::uint32_t> splits, AdaptDirection direction, int width,
                                int height, const RasterState& state);

/// Takes the map from level `from` to level `to`, down or up. A texel changes where a cell covers its centre; one that no cell covers keeps its
/// value. UnavailableError where the renderer does not support the map's format.
AdaptCounts adapt_map(Renderer& renderer, const AdaptSequence& sequence, std::size_t from, std::size_t to, Image& map,
                      const AdaptOptions& options = {});

}  // namespace etalon::adapt
