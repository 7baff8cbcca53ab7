// The simplification results as a document, as tables, and as a picture of how time grows.
#pragma once

#include "tests/bench/simplify_bench.h"

namespace etalon::bench {

/// [{name, title, faces_in, target_faces, ways: [{name, title, skipped | faces, seconds {median, lower, upper}, peak_bytes, rms_of_diagonal, mean_of_diagonal,
/// colour_rms}], figures: [figure_json()]}].
[[nodiscard]] nlohmann::ordered_json simplify_document(const std::vector<SimplifySceneResult>& results);

/// Two tables a scene: the ways, the figures; one table of the scenes named simplify-growth-…. `scenes` is of simplify_document().
[[nodiscard]] std::string simplify_tables(const nlohmann::ordered_json& scenes);

/// CPU time against faces of the scenes named simplify-growth-…, both logarithmic, with n·log n through the first point of each way, as SVG. Empty
/// where there are fewer than two such scenes.
[[nodiscard]] std::string growth_picture(const nlohmann::ordered_json& scenes);

}  // namespace etalon::bench
