// "0.01" or "0.5%": a length on the command line.
#pragma once

#include <string>

namespace etalon::cli {

/// `text`: a length in model units, or with % at its end that share of `diagonal`; at least 0, decimal. UsageError, beginning with `where`
/// ("simplify: --tolerance"), says what was expected and got.
[[nodiscard]] double parse_length(const std::string& text, double diagonal, const std::string& where);

}  // namespace etalon::cli
