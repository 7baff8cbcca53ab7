#include "cli/length_option.h"

#include <cmath>
#include <exception>

#include <fmt/format.h>

#include "cli/usage_error.h"

namespace etalon::cli {

double parse_length(const std::string& text, double diagonal, const std::string& where) {
  std::size_t read = 0;
  double length = -1;
  try {
    length = std::stod(text, &read);
  } catch (const std::exception&) {
    read = 0;
  }
  const bool percent = read + 1 == text.size() && text.back() == '%';
  if (read == 0 || (read != text.size() && !percent) || !(length >= 0) || std::isinf(length))
    throw UsageError(fmt::format("{}: expected a length of at least 0, as 0.01 or 0.5% of the diagonal, got {}", where, text));
  return percent ? length / 100 * diagonal : length;
}

}  // namespace etalon::cli
