#include "cli/common_options.h"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fmt/format.h>
#include <unistd.h>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "cli/interrupt.h"
#include "cli/usage_error.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/io/atomic_file.h"
#include "validation/report/json_report.h"
#include "validation/report/run_info.h"

namespace etalon::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& path, const std::string& reason) { throw WriteError(fmt::format("{}: {}", path, reason)); }

void require_writable_existing(const fs::path& folder, const std::string& shown) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) refuse(shown, fmt::format("{} is not a folder", folder.string()));
  if (access(folder.c_str(), W_OK | X_OK) != 0) refuse(shown, std::strerror(errno));
}

}  // namespace

CLI::Validator not_empty() {
  return CLI::Validator([](std::string& text) { return text.empty() ? std::string("expected a value, got an empty one") : std::string(); },
                        "");
}

CLI::Validator number_between(double low, double high) {
  const auto check = [low, high](std::string& text) {
    double value = 0;
    const bool is_number = CLI::detail::lexical_cast(text, value);
    return is_number && value >= low && value <= high ? std::string()
                                                      : fmt::format("expected a number from {:g} to {:g}, got {}", low, high, text);
  };
  return CLI::Validator(check, "");
}

std::string counted(std::uint64_t count, const std::string& noun) {
  return fmt::format("{} {}{}", validation::grouped(count), noun, count == 1 ? "" : "s");
}

void add_common_options(CLI::App& verb, CommonOptions& options, const std::string& example) {
  verb.add_option("--json", options.json, "Write the result as a JSON document ('-': standard output)")
      ->type_name("FILE")
      ->check(not_empty());
  verb.add_option("--threads", options.threads, "Threads to use (default: all cores); no output byte depends on it")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  verb.add_flag("--quiet", options.quiet, "Print errors only");
  verb.set_version_flag("--version", "etalon " + validation::etalon_version());
  verb.footer("Example:\n" + example);
}

void apply(const CommonOptions& options) { set_thread_count(options.threads); }

Console::Options console_options(const CommonOptions& options, const std::string& output) {
  if (options.json == "-" && output == "-") throw UsageError("-o and --json cannot both be standard output");
  return {.quiet = options.quiet, .data_on_stdout = options.json == "-" || output == "-"};
}

void write_document(const CommonOptions& options, const nlohmann::ordered_json& document) {
  if (options.json.empty()) return;
  const std::string text = validation::to_text(document);
  if (options.json == "-") {
    write_stdout(text);
    return;
  }
  const FinishWriting finish;
  io::write_file(options.json, text);
}

void require_writable_file(const std::string& path) {
  if (path.empty() || path == "-") return;
  std::error_code error;
  if (fs::is_directory(path, error)) refuse(path, "is a folder");
  const fs::path folder = fs::path(path).parent_path();
  if (fs::exists(path, error) && !fs::is_regular_file(path, error)) return;  // a device or a pipe: written through
  if (!folder.empty() && !fs::exists(folder, error)) refuse(path, fmt::format("there is no folder {}", folder.string()));
  require_writable_existing(folder.empty() ? fs::path(".") : folder, path);
}

void require_writable_folder(const std::string& path) {
  std::error_code error;
  fs::path folder = fs::absolute(path, error);
  while (!fs::exists(folder, error) && folder.has_relative_path()) folder = folder.parent_path();
  require_writable_existing(folder, path);
}

}  // namespace etalon::cli
