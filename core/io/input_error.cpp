#include "core/io/input_error.h"

#include <fmt/format.h>

#include "core/base/error.h"

namespace etalon::io {

std::string printable(std::string_view text, std::size_t limit) {
  std::string result;
  for (const char c : text) {
    const std::string shown = c >= 0x20 && c < 0x7F ? std::string(1, c) : fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    if (result.size() + shown.size() > limit) return result + "…";
    result += shown;
  }
  return result;
}

std::string first_line(std::string_view message) { return printable(message.substr(0, message.find_first_of("\r\n")), 300); }

void fail_file(const std::string& file, const std::string& what) { throw InputError(fmt::format("{}: {}", file, what)); }

void fail_at_line(const std::string& file, std::size_t line, const std::string& what) {
  throw InputError(fmt::format("{}:{}: {}", file, line, what));
}

void fail_at_byte(const std::string& file, std::size_t offset, const std::string& what) {
  throw InputError(fmt::format("{}: byte {}: {}", file, offset, what));
}

}  // namespace etalon::io
