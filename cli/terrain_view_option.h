// --view of the verbs that look at a terrain: the same choice for `joint` and `study horbelt`.
#pragma once

#include <string>

#include "cli/size_option.h"
#include "validation/joint/terrain_views.h"

namespace etalon::cli {

/// The view that `text` names (as parse_view(): a view file, front, fit, N/24), in a frame of `size` as --size gives it; where that is empty, of the
/// view file's own, else of `fallback`. Built-in names frame the field's full mesh. `name` is the file's stem in [a-z0-9_-] without a "-view" at its
/// end ("5-24" for 5/24), `title` the file's name. Errors: parse_view's and parse_size's.
[[nodiscard]] validation::NamedTerrainView chosen_terrain_view(const std::string& text, const std::string& size, FrameSize fallback,
                                                               const terrain::HeightField& field);

/// Letters in lower case, digits, '_' and '-' of `name`, anything else a '-': for names of files and rows.
[[nodiscard]] std::string plain_name(std::string name);

}  // namespace etalon::cli
