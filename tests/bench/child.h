// Measurements in a process of their own: what one library leaves in memory does not help or hinder the next, and the peak is its own.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/mesh/mesh.h"

namespace etalon::bench {

/// A directory of this process under the system's temporary one, removed at the end.
class ScratchDirectory {
 public:
  ScratchDirectory();
  ~ScratchDirectory();
  ScratchDirectory(const ScratchDirectory&) = delete;
  ScratchDirectory& operator=(const ScratchDirectory&) = delete;
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// Positions, colours and faces as they lie in memory: for a child on the same machine. A face's corners become wedges of their vertices.
void write_raw_mesh(const std::filesystem::path& path, const Mesh& mesh);
/// InputError where the file ends early.
[[nodiscard]] Mesh read_raw_mesh(const std::filesystem::path& path);

/// What a program and its descendants needed.
struct ChildCost {
  int exit_code = -1;      ///< -1: could not be started
  double cpu_seconds = 0;  ///< user and system
  std::string output;      ///< standard output
};
/// Runs a program and waits for it; standard error goes to `error_log`.
[[nodiscard]] ChildCost run_program(const std::vector<std::string>& command, const std::filesystem::path& error_log);

}  // namespace etalon::bench
