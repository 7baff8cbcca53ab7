// What a person reads: lines of progress and result, a bar on a terminal, errors.
#pragma once

#include <chrono>
#include <string>

namespace etalon::cli {

/// Lines go to standard output, or to standard error when standard output carries data (`-o -`, `--json -`).
class Console {
 public:
  struct Options {
    bool quiet = false;           ///< no lines, no bar; errors are still printed
    bool data_on_stdout = false;  ///< lines go to standard error
  };
  explicit Console(Options options) : options_(options) {}
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  /// Prints `raw` as exactly one line, control characters escaped (a newline is added). WriteError where standard output cannot take it.
  void line(const std::string& raw);

  /// Shows `label` with a bar at done/total on standard error, if that is a terminal and more than a second has passed since construction.
  void progress(const std::string& label, int done, int total);

 private:
  void erase_bar();
  Options options_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  bool bar_shown_ = false;
};

/// "etalon: error: TEXT" on standard error, as exactly one line whatever TEXT holds.
void print_error(const std::string& text);
/// "etalon: warning: TEXT", likewise.
void print_warning(const std::string& text);

/// Writes bytes to standard output and flushes. WriteError with the system's reason.
void write_stdout(const std::string& bytes);

}  // namespace etalon::cli
