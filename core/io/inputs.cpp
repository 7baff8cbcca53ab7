#include "core/io/inputs.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "core/base/error.h"
#include "core/base/memory_limit.h"
#include "core/base/sha256.h"
#include "core/io/input_error.h"

namespace etalon::io {
namespace {

/// An open descriptor of a regular file.
class Descriptor {
 public:
  explicit Descriptor(const std::filesystem::path& path) : name_(path.string()) {
    // O_NONBLOCK: opening a pipe without a writer would wait for ever; regular files ignore it.
    fd_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (fd_ < 0) fail_file(name_, std::strerror(errno));
    struct stat status {};
    if (::fstat(fd_, &status) != 0) refuse(std::strerror(errno));
    if (S_ISDIR(status.st_mode)) refuse("expected a file, got a folder");
    if (!S_ISREG(status.st_mode)) refuse("expected a regular file, got a device or a pipe");
    size_bytes_ = static_cast<std::size_t>(status.st_size);
  }
  ~Descriptor() { ::close(fd_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  [[nodiscard]] std::size_t size_bytes() const { return size_bytes_; }

  /// Reads up to out.size() bytes, fewer only at the end of the file.
  std::size_t read(std::span<std::byte> out) {
    std::size_t done = 0;
    while (done < out.size()) {
      const ssize_t n = ::read(fd_, out.data() + done, out.size() - done);
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) fail_file(name_, std::strerror(errno));
      if (n == 0) break;
      done += static_cast<std::size_t>(n);
    }
    return done;
  }

 private:
  // The destructor does not run where the constructor throws.
  [[noreturn]] void refuse(const char* what) {
    ::close(fd_);
    fail_file(name_, what);
  }
  std::string name_;
  int fd_ = -1;
  std::size_t size_bytes_ = 0;
};

}  // namespace

FileBytes read_file(const std::filesystem::path& path) {
  Descriptor file(path);
  if (file.size_bytes() == 0) fail_file(path.string(), "the file is empty");
  require_memory(path.string(), file.size_bytes());
  FileBytes result(file.size_bytes());
  const std::size_t got = file.read(result.bytes());
  if (got != file.size_bytes()) fail_at_byte(path.string(), got, "the file shrank while it was read");
  return result;
}

std::string file_sha256(const std::filesystem::path& path) {
  Descriptor file(path);
  Sha256 hash;
  std::array<std::byte, 1 << 16> block;
  while (const std::size_t n = file.read(block)) hash.update(std::span<const std::byte>(block).first(n));
  return hash.hex();
}

}  // namespace etalon::io
