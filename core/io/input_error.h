// One form for every complaint about a file: "FILE:LINE: …" for text, "FILE: byte OFFSET: …" for binary; always a single line.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace etalon::io {

/// `text` for a message: at most `limit` characters, then "…"; whatever is not printable ASCII becomes "\xNN", four of them. Never a line break.
[[nodiscard]] std::string printable(std::string_view text, std::size_t limit = 40);

/// The first line of a library's message, printable.
[[nodiscard]] std::string first_line(std::string_view message);

[[noreturn]] void fail_file(const std::string& file, const std::string& what);
/// `line` counts from 1.
[[noreturn]] void fail_at_line(const std::string& file, std::size_t line, const std::string& what);
[[noreturn]] void fail_at_byte(const std::string& file, std::size_t offset, const std::string& what);

}  // namespace etalon::io
