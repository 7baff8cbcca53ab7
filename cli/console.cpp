#include "cli/console.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include <fmt/format.h>
#include <unistd.h>

#include "core/base/error.h"

namespace etalon::cli {
namespace {

// A file's name or content may hold anything; a message is one line.
std::string one_line(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '\n' || c == '\r' || c == '\t')
      result += ' ';
    else if (byte < 0x20 || byte == 0x7F)
      result += fmt::format("\\x{:02x}", byte);
    else
      result += c;
  }
  while (!result.empty() && result.back() == ' ') result.pop_back();
  return result;
}

void print_to_stderr(const char* kind, const std::string& text) {
  const std::string line = fmt::format("etalon: {}: {}\n", kind, one_line(text));
  std::fwrite(line.data(), 1, line.size(), stderr);
  std::fflush(stderr);
}

}  // namespace

void print_error(const std::string& text) { print_to_stderr("error", text); }
void print_warning(const std::string& text) { print_to_stderr("warning", text); }

void write_stdout(const std::string& bytes) {
  errno = 0;
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), stdout) == bytes.size();
  if (!written || std::fflush(stdout) != 0) throw WriteError(fmt::format("standard output: {}", std::strerror(errno)));
}

Console::~Console() { erase_bar(); }

void Console::line(const std::string& raw) {
  if (options_.quiet) return;
  erase_bar();
  const std::string text = one_line(raw);
  if (options_.data_on_stdout) {
    const std::string line = text + "\n";
    std::fwrite(line.data(), 1, line.size(), stderr);
  } else {
    write_stdout(text + "\n");
  }
}

void Console::progress(const std::string& label, int done, int total) {
  if (options_.quiet || isatty(STDERR_FILENO) == 0) return;
  if (std::chrono::steady_clock::now() - start_ < std::chrono::seconds(1)) return;
  constexpr int kWidth = 28;
  const int filled = total > 0 ? std::clamp(done * kWidth / total, 0, kWidth) : 0;
  std::string bar;
  for (int i = 0; i < kWidth; ++i) bar += i < filled ? "━" : "╌";
  const std::string text = fmt::format("\r\x1b[K{} {}/{} {}", bar, done, total, one_line(label));
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
  bar_shown_ = true;
}

void Console::erase_bar() {
  if (!bar_shown_) return;
  std::fputs("\r\x1b[K", stderr);
  std::fflush(stderr);
  bar_shown_ = false;
}

}  // namespace etalon::cli
