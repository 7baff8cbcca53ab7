// Skips are reported, never silent: ./check counts these lines.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

namespace etalon::test {

/// Says that the running test case could not run here and why; the case must return right after.
inline void report_skip(const std::string& test_case, const std::string& reason) {
  std::printf("[etalon] skipped: %s: %s\n", test_case.c_str(), reason.c_str());
  std::fflush(stdout);
}

/// The real input $ETALON_DATA/relative, or nothing where it is absent (the caller reports a skip).
inline std::optional<std::filesystem::path> data_file(const std::string& relative) {
  const char* root = std::getenv("ETALON_DATA");
  if (root == nullptr) return std::nullopt;
  const std::filesystem::path path = std::filesystem::path(root) / relative;
  if (!std::filesystem::exists(path)) return std::nullopt;
  return path;
}

}  // namespace etalon::test
