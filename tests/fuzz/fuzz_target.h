// What every fuzz target asks for: any bytes are refused by an InputError in one line that names the file, or are read. Anything else ends the program,
// so that libFuzzer keeps the bytes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/io/inputs.h"

namespace etalon::test {

/// Whether `read` reads; false where it refuses in the right form, the message beginning with `name`.
template <class Read>
bool is_read(const std::string& name, const Read& read) {
  try {
    read();
    return true;
  } catch (const InputError& error) {
    const std::string_view message = error.what();
    const bool is_good = message.starts_with(name) && message.find('\n') == std::string_view::npos && message.size() < name.size() + 1000;
    if (!is_good) {
      std::fprintf(stderr, "a refusal of another form: %s\n", error.what());
      std::abort();
    }
    return false;
  }
}

/// Ends the program where what was read is not what the reader promises.
inline void require(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "not as promised: %s\n", what);
  std::abort();
}

inline std::span<const std::byte> bytes_of(const std::uint8_t* data, std::size_t size) { return std::as_bytes(std::span(data, size)); }

/// The bytes as they are, and once more with their checksums put right, so that damage gets past them.
template <class Read, class Repair>
int read_and_read_repaired(const std::uint8_t* data, std::size_t size, const Read& read, const Repair& repair) {
  const std::span<const std::byte> bytes = bytes_of(data, size);
  read(bytes);
  std::vector<std::byte> repaired(bytes.begin(), bytes.end());
  repair(repaired);
  read(repaired);
  return 0;
}

inline io::FileBytes file_bytes(std::span<const std::byte> bytes) {
  io::FileBytes file(bytes.size());
  std::copy(bytes.begin(), bytes.end(), file.bytes().begin());
  return file;
}

/// For readers that open what they are given: a file in the working folder, which is the run's own.
inline void put_file(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace etalon::test
