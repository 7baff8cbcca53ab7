// How much memory this process may have. Only declared limits count (setrlimit, control groups): what others use at the moment decides
// nothing, so the same call is refused or done every time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace etalon {

/// The tightest limit on this process.
struct MemoryLimit {
  std::uint64_t limit_bytes = 0;
  std::uint64_t used_bytes = 0;  ///< of what the limit counts
  std::string name;              ///< as "the limit of address space (ulimit -v)"
  [[nodiscard]] std::uint64_t left_bytes() const { return used_bytes < limit_bytes ? limit_bytes - used_bytes : 0; }
};

/// Of RLIMIT_AS, RLIMIT_DATA and the control groups of this process (version 2) the one that leaves the least; none where nothing limits it.
[[nodiscard]] std::optional<MemoryLimit> memory_limit();

/// "1.36 GB", in units of 1000 with three digits.
[[nodiscard]] std::string memory_text(std::uint64_t bytes);

/// Does nothing where `need_bytes` more may be had. Else InputError: "SUBJECT: expected 1.36 GB of memory, got 812 MB left of …".
void require_memory(const std::string& subject, std::uint64_t need_bytes);

}  // namespace etalon
