// What every verb takes: --json FILE, --threads N, --quiet, --version; and what follows from them.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <nlohmann/json.hpp>

#include "cli/console.h"

namespace etalon::cli {

/// One verb of the program: its parser, and what it does once parsed; the result is an exit code.
struct Verb {
  CLI::App* app = nullptr;
  std::function<int()> run;
};

struct CommonOptions {
  std::string json;  ///< empty: no document; "-": standard output
  int threads = 0;   ///< 0: all cores
  bool quiet = false;
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
};

/// Refuses an empty argument: a variable of the shell that is not set, more often than not.
[[nodiscard]] CLI::Validator not_empty();
/// A number from low to high; not a NaN, which CLI::Range lets through.
[[nodiscard]] CLI::Validator number_between(double low, double high);

/// "1 face", "2 faces"; thousands in groups.
[[nodiscard]] std::string counted(std::uint64_t count, const std::string& noun);

/// Adds the options to a verb, and `example` (one command a line) under its help.
void add_common_options(CLI::App& verb, CommonOptions& options, const std::string& example);

/// Sets the thread count; call before any work.
void apply(const CommonOptions& options);

/// `output`: what -o names; lines must keep off standard output where data goes there. UsageError where both -o and --json are "-".
[[nodiscard]] Console::Options console_options(const CommonOptions& options, const std::string& output = "");

/// Writes the document where --json says; nothing without --json. WriteError.
void write_document(const CommonOptions& options, const nlohmann::ordered_json& document);

/// Fails early with the WriteError that writing to `path` would end in: its folder is missing or not writable. "-" and "" are fine.
void require_writable_file(const std::string& path);
/// Likewise for a folder that may still have to be made, with its parents.
void require_writable_folder(const std::string& path);

}  // namespace etalon::cli
