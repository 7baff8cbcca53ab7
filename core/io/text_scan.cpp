#include "core/io/text_scan.h"

#include <charconv>
#include <cmath>
#include <cstddef>

namespace etalon::io {
namespace {

std::string_view without_plus(std::string_view word) {
  // "+-1" must stay an error.
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  return word;
}

}  // namespace

std::string_view take_word(std::string_view& text) {
  std::size_t begin = 0;
  while (begin < text.size() && is_blank(text[begin])) ++begin;
  std::size_t end = begin;
  while (end < text.size() && !is_blank(text[end])) ++end;
  const std::string_view word = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return word;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::optional<float> parse_float(std::string_view word) {
  word = without_plus(word);
  const char* const end = word.data() + word.size();
  float value = 0;
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (stop != end || word.empty()) return std::nullopt;
  if (error == std::errc::result_out_of_range) {
    // Too large or too small for a float; from_chars does not say which, a negative exponent or a leading 0 does.
    double wide = 0;
    if (std::from_chars(word.data(), end, wide).ec == std::errc{}) return std::fabs(wide) < 1 ? std::optional(0.0f) : std::nullopt;
    return word.find("e-") != word.npos || word.find("E-") != word.npos ? std::optional(0.0f) : std::nullopt;
  }
  if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<std::int64_t> parse_integer(std::string_view word) {
  word = without_plus(word);
  const char* const end = word.data() + word.size();
  std::int64_t value = 0;
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (stop != end || error != std::errc{} || word.empty()) return std::nullopt;
  return value;
}

}  // namespace etalon::io
