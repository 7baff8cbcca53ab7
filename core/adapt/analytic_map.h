// The exact limit of adaptation: indexing maps whose every texel is followed through the chain of cells, without resampling between.
#pragma once

#include <functional>

#include "core/adapt/adapt_sequence.h"
#include "core/adapt/gutter.h"
#include "core/adapt/map_format.h"

namespace etalon::adapt {

/// The indexing map of a level, at once: each texel's centre followed from `level` to the finest level (AdaptSequence::follow) and stored in
/// `type`, rounded to nearest even once from the double. A texel in no chart of the level holds what the cells of finer levels that reach over
/// it give, or its own centre. In parallel over rows; the same bytes for every thread count. `progress` hears of rows done and in all, from
/// the calling thread; an exception of it stops the work. InputError for a type that identity_map() does not know.
[[nodiscard]] Image analytic_map(const AdaptSequence& sequence, std::size_t level, int width, int height,
                                 ChannelType type = ChannelType::float32, const std::function<void(int done, int total)>& progress = {});

/// The same in charts of the level; beside them, where the chain is not defined and linear lookups read all the same, what `adapted` holds: the
/// identity map that adapt_map() took to `level` with a gutter. Of `adapted`'s size and format. `gutter`: at `level`, of that size
/// (ETALON_CHECK).
[[nodiscard]] Image analytic_with_gutter(const AdaptSequence& sequence, std::size_t level, const Image& adapted, const Gutter& gutter,
                                         const std::function<void(int done, int total)>& progress = {});

}  // namespace etalon::adapt
