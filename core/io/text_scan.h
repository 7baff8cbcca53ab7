// Reading numbers and words out of text: no locale, no allocation, correctly rounded (std::from_chars).
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace etalon::io {

/// Spaces inside a line; '\r' is one, so that files with DOS line ends need no care.
[[nodiscard]] constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

/// Cuts the leading blanks, then the word up to the next blank, off `text`; empty where none is left.
[[nodiscard]] std::string_view take_word(std::string_view& text);

/// `text` without blanks at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// The nearest float32 to the decimal number that is all of `word`, a leading '+' allowed; tiny numbers become 0, "nan", "inf" and what
/// overflows float32 are nothing.
[[nodiscard]] std::optional<float> parse_float(std::string_view word);

/// The decimal integer that is all of `word`, a leading '+' allowed.
[[nodiscard]] std::optional<std::int64_t> parse_integer(std::string_view word);

}  // namespace etalon::io
