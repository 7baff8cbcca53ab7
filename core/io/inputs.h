// Whole files from outside, read once into memory, so that every parser sees one stable block whose end it knows.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace etalon::io {

/// The bytes of a file; moves, does not copy.
class FileBytes {
 public:
  FileBytes() = default;
  /// Room for `size_bytes` bytes, uninitialised.
  explicit FileBytes(std::size_t size_bytes) : data_(std::make_unique_for_overwrite<std::byte[]>(size_bytes)), size_bytes_(size_bytes) {}
  [[nodiscard]] std::span<std::byte> bytes() { return {data_.get(), size_bytes_}; }
  [[nodiscard]] std::span<const std::byte> bytes() const { return {data_.get(), size_bytes_}; }
  [[nodiscard]] std::string_view text() const { return {reinterpret_cast<const char*>(data_.get()), size_bytes_}; }

 private:
  std::unique_ptr<std::byte[]> data_;
  std::size_t size_bytes_ = 0;
};

/// All bytes of the regular file `path`. InputError for a missing, unreadable or empty file, a folder, a device or a pipe.
[[nodiscard]] FileBytes read_file(const std::filesystem::path& path);

/// SHA-256 of the file's bytes as 64 lowercase hex digits (an empty file has one too); InputError as read_file.
[[nodiscard]] std::string file_sha256(const std::filesystem::path& path);

}  // namespace etalon::io
