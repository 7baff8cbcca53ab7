// "did you mean …": the known word nearest to a mistyped one.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace etalon::cli {

/// The word with the smallest edit distance (insert, delete, replace, exchange of neighbours), if at most 2 and less than half its length; the first of several.
[[nodiscard]] std::optional<std::string> nearest_word(const std::string& typed, const std::vector<std::string>& words);

}  // namespace etalon::cli
