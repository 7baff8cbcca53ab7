// Files that are replaced as a whole or not at all: written under a temporary name in the same folder, flushed to the disk, then renamed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace etalon::io {

/// One file being written. Until commit() the old file at `path` is untouched; without commit() the destructor removes the temporary one.
/// Follows a symbolic link to the file it names. Keeps the permission bits of a file that it replaces. A device or a pipe
/// (/dev/stdout) cannot be replaced: there the bytes go straight through. Every failure (full disk, size limit, read-only folder or file,
/// a folder at `path`) is a WriteError "FILE: reason" and leaves neither a temporary nor a changed old file behind.
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();
  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  AtomicFile& operator=(AtomicFile&&) = delete;

  void write(std::span<const std::byte> bytes);
  void write(std::string_view text) { write(std::as_bytes(std::span(text.data(), text.size()))); }

  /// Flushes to the disk; afterwards only a rename separates the new file from its place. commit() calls it where it was not called.
  void flush();
  /// Puts the new file in the place of the old one.
  void commit();

 private:
  [[noreturn]] void fail(int error_number);
  void discard() noexcept;

  std::filesystem::path shown_;      // as the caller wrote it: for messages
  std::filesystem::path target_;     // links followed
  std::filesystem::path temporary_;  // empty: written straight through
  int fd_ = -1;
};

/// Writes one file atomically.
void write_file(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_file(const std::filesystem::path& path, std::string_view text);

/// Writes several files that belong together: all are complete on the disk before the first takes its place, in the order given.
void write_files(const std::vector<std::pair<std::filesystem::path, std::string>>& files);

}  // namespace etalon::io
