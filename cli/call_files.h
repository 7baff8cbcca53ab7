// The files of one call of the program: nothing that it reads, and nothing that it writes twice, may be overwritten.
#pragma once

#include <string>
#include <vector>

namespace etalon::cli {

/// Name every file before the first is written. Two names are the same file where their canonical paths are equal (links followed).
/// "", "-" and what exists but is not a regular file (a device, a pipe, a folder) are nobody's and pass.
class CallFiles {
 public:
  /// `what` names the role in the message: "MODEL", "-o". UsageError where the file is one of the outputs.
  void add_input(const std::string& path, const std::string& what);
  /// UsageError where the file is one of the inputs or of the other outputs.
  void add_output(const std::string& path, const std::string& what);

 private:
  struct Entry {
    std::string canonical;
    std::string what;
    bool output = false;
  };
  void add(const std::string& path, const std::string& what, bool output);
  std::vector<Entry> entries_;
};

}  // namespace etalon::cli
