// Runs the built `etalon` program as a user would.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace etalon::test {

struct CommandResult {
  int exit_code = -1;  ///< 128 + signal where one ended it
  std::string out;     ///< standard output
  std::string err;     ///< standard error
  [[nodiscard]] std::vector<std::string> error_lines() const;
};

struct CommandOptions {
  std::filesystem::path folder;          ///< working directory
  std::vector<std::string> environment;  ///< "NAME=value", added
  std::string stdout_path;               ///< instead of a pipe: a file or device
  long file_size_limit_bytes = -1;       ///< RLIMIT_FSIZE: a full disk, as far as a program can tell
  bool as_nobody = false;                ///< where the test runs as root: give that up
  int interrupt_after_ms = -1;           ///< SIGINT this long after the start
};

[[nodiscard]] CommandResult run_etalon(const std::vector<std::string>& arguments, const CommandOptions& options = {});

/// An empty folder of its own, removed with all that is in it.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Writes a text file and returns its path.
  std::string file(const std::string& name, const std::string& content) const;
  /// Names of everything inside, sorted.
  [[nodiscard]] std::vector<std::string> listing() const;

 private:
  std::filesystem::path path_;
};

/// Checks that the command ends with this exit code and one line "etalon: error: …" that mentions `mentions`, and leaves the folder as it was.
void check_refused(const std::vector<std::string>& arguments, int exit_code, const ScratchFolder& folder, const std::string& mentions,
                   CommandOptions options = {});

[[nodiscard]] std::string read_text(const std::filesystem::path& path);

/// A square of two triangles with texture coordinates, without a material.
[[nodiscard]] std::string square_obj();

}  // namespace etalon::test
