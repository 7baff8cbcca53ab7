#include "tests/architecture/source_text.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

namespace etalon::test {
namespace {

namespace fs = std::filesystem;

constexpr std::array kTopFolders = {"core", "raster", "gpu", "validation", "cli", "tests", "docs"};

enum class Keep { code, code_and_literals };

bool is_word(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_'; }

// Length of the literal that starts at text[i] (a quote, or the R of a raw string), or 0 where none does.
std::size_t literal_length(std::string_view text, std::size_t i) {
  const auto to_end = [&](std::size_t end) { return std::min(end, text.size()) - i; };
  if (text[i] == 'R' && i + 1 < text.size() && text[i + 1] == '"' && (i == 0 || !is_word(text[i - 1]))) {
    const std::size_t open = text.find('(', i);
    if (open == std::string_view::npos) return to_end(text.size());
    const std::string close = ")" + std::string(text.substr(i + 2, open - i - 2)) + "\"";
    const std::size_t end = text.find(close, open);
    return end == std::string_view::npos ? to_end(text.size()) : to_end(end + close.size());
  }
  const char quote = text[i];
  // 1'000: a digit separator is no quote.
  if (quote != '"' && (quote != '\'' || (i > 0 && is_word(text[i - 1])))) return 0;
  std::size_t end = i + 1;
  while (end < text.size() && text[end] != quote && text[end] != '\n') end += text[end] == '\\' ? 2 : 1;
  return to_end(end + 1);
}

std::string strip(std::string_view text, Keep keep) {
  std::string result(text);
  const auto blank = [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      if (result[k] != '\n') result[k] = ' ';
  };
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i + 1;
    if (text.substr(i, 2) == "//") {
      end = std::min(text.find('\n', i), text.size());
      blank(i, end);
    } else if (text.substr(i, 2) == "/*") {
      const std::size_t close = text.find("*/", i + 2);
      end = close == std::string_view::npos ? text.size() : close + 2;
      blank(i, end);
    } else if (const std::size_t length = literal_length(text, i); length > 0) {
      end = i + length;
      if (keep == Keep::code) blank(i, end);
    }
    i = end;
  }
  return result;
}

std::string read_file(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

std::string Violation::text() const { return path + (line > 0 ? ":" + std::to_string(line) : "") + ": " + rule + ": " + detail; }

std::string code_only(std::string_view text) { return strip(text, Keep::code); }

std::vector<Include> includes_of(std::string_view text) {
  std::vector<Include> result;
  std::istringstream lines(strip(text, Keep::code_and_literals));
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::size_t at = line.find_first_not_of(" \t");
    if (at == std::string::npos || line[at] != '#') continue;
    at = line.find_first_not_of(" \t", at + 1);
    if (at == std::string::npos || line.compare(at, 7, "include") != 0) continue;
    at = line.find_first_of("\"<", at + 7);
    if (at == std::string::npos) continue;
    const bool quoted = line[at] == '"';
    const std::size_t end = line.find(quoted ? '"' : '>', at + 1);
    if (end != std::string::npos) result.push_back({number, line.substr(at + 1, end - at - 1), quoted});
  }
  return result;
}

std::string folder_of(std::string_view path) {
  const std::size_t slash = path.rfind('/');
  return std::string(slash == std::string_view::npos ? "" : path.substr(0, slash));
}

bool is_under(std::string_view path, std::string_view folder) {
  return path == folder || (path.size() > folder.size() && path.starts_with(folder) && path[folder.size()] == '/');
}

std::vector<SourceFile> read_tree(const std::string& root) {
  std::vector<SourceFile> files;
  for (const char* top : kTopFolders) {
    if (!fs::exists(fs::path(root) / top)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(root) / top)) {
      const std::string extension = entry.path().extension().string();
      if (!entry.is_regular_file() || (extension != ".h" && extension != ".cpp" && extension != ".inc")) continue;
      files.push_back({fs::relative(entry.path(), root).generic_string(), read_file(entry.path())});
    }
  }
  std::ranges::sort(files, {}, &SourceFile::path);
  return files;
}

}  // namespace etalon::test
