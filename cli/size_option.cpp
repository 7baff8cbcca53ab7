#include "cli/size_option.h"

#include <charconv>
#include <string_view>

#include <fmt/format.h>

#include "cli/usage_error.h"

namespace etalon::cli {
namespace {

[[noreturn]] void refuse(const std::string& text, int largest) {
  throw UsageError(fmt::format("--size: expected WxH or one number, each from 1 to {}, got '{}'", largest, text));
}

int parse_side(std::string_view digits, const std::string& whole, int largest) {
  int value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool all_read = error == std::errc() && end == digits.data() + digits.size();
  if (!all_read || digits.empty() || digits.front() == '-' || value < 1 || value > largest) refuse(whole, largest);
  return value;
}

}  // namespace

FrameSize parse_size(const std::string& text, int largest) {
  const std::string_view view = text;
  const std::size_t cross = view.find_first_of("xX");
  if (cross == std::string_view::npos) {
    const int side = parse_side(view, text, largest);
    return {side, side};
  }
  return {parse_side(view.substr(0, cross), text, largest), parse_side(view.substr(cross + 1), text, largest)};
}

}  // namespace etalon::cli
