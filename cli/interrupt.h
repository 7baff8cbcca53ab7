// Ctrl-C: the process ends with 130, and a file that is being put in place is put there whole first.
#pragma once

namespace etalon::cli {

/// Call first thing in main, before any thread exists: blocks SIGINT everywhere and starts the one thread that waits for it.
/// On SIGINT the process ends at once with exit code 130, unless a FinishWriting is alive: then when the last one dies.
void watch_for_interrupt();

/// Alive while files are written (temporary name, then rename): an interrupt waits for its end, so that neither half a file nor a
/// temporary one stays behind. Not for standard output, which may block on its reader.
class FinishWriting {
 public:
  FinishWriting();
  ~FinishWriting();
  FinishWriting(const FinishWriting&) = delete;
  FinishWriting& operator=(const FinishWriting&) = delete;
};

}  // namespace etalon::cli
