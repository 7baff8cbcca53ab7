#include "cli/call_files.h"

#include <filesystem>

#include <fmt/format.h>

#include "cli/usage_error.h"

namespace etalon::cli {
namespace {

namespace fs = std::filesystem;

bool is_special(const std::string& path) {
  if (path.empty() || path == "-") return true;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return fs::exists(status) && !fs::is_regular_file(status);
}

std::string canonical(const std::string& path) {
  std::error_code error;
  const fs::path absolute = fs::absolute(path, error);
  const fs::path resolved = fs::weakly_canonical(absolute, error);
  return error ? absolute.lexically_normal().string() : resolved.string();
}

}  // namespace

void CallFiles::add_input(const std::string& path, const std::string& what) { add(path, what, false); }
void CallFiles::add_output(const std::string& path, const std::string& what) { add(path, what, true); }

void CallFiles::add(const std::string& path, const std::string& what, bool output) {
  if (is_special(path)) return;
  Entry entry{canonical(path), what, output};
  for (const Entry& other : entries_) {
    if (other.canonical != entry.canonical || !(output || other.output)) continue;
    const Entry& written = output ? entry : other;
    const Entry& kept = output ? other : entry;
    throw UsageError(fmt::format("{}: {} would overwrite {}: give it another name", path, written.what, kept.what));
  }
  entries_.push_back(std::move(entry));
}

}  // namespace etalon::cli
