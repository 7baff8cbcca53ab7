#include "core/io/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "core/base/error.h"

namespace etalon::io {
namespace {

namespace fs = std::filesystem;

/// While alive, a write beyond RLIMIT_FSIZE or into a closed pipe is an error code for this thread instead of the end of the process
/// (SIGXFSZ and SIGPIPE are sent to the thread that writes).
class WriteSignalsHeld {
 public:
  WriteSignalsHeld() {
    sigemptyset(&held_);
    sigaddset(&held_, SIGXFSZ);
    sigaddset(&held_, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &held_, &before_);
  }
  ~WriteSignalsHeld() {
    const int saved_errno = errno;
    sigset_t mine = held_;
    for (const int s : {SIGXFSZ, SIGPIPE})
      if (sigismember(&before_, s) == 1) sigdelset(&mine, s);
    const timespec no_wait{0, 0};
    while (sigtimedwait(&mine, nullptr, &no_wait) > 0) {
    }
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    errno = saved_errno;
  }
  WriteSignalsHeld(const WriteSignalsHeld&) = delete;
  WriteSignalsHeld& operator=(const WriteSignalsHeld&) = delete;

 private:
  sigset_t held_{};
  sigset_t before_{};
};

fs::path links_followed(const fs::path& path) {
  fs::path target = path;
  std::error_code error;
  for (int hops = 0; hops < 40 && fs::is_symlink(target, error); ++hops) {
    const fs::path next = fs::read_symlink(target, error);
    if (error) break;
    target = next.is_absolute() ? next : target.parent_path() / next;
  }
  return target;
}

fs::path folder_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

std::atomic<unsigned> g_temporary_count{0};

}  // namespace

AtomicFile::AtomicFile(const fs::path& path) : shown_(path), target_(links_followed(path)) {
  struct stat status {};
  const bool exists = ::stat(target_.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) fail(EISDIR);
  if (exists && !S_ISREG(status.st_mode)) {
    fd_ = ::open(target_.c_str(), O_WRONLY | O_CLOEXEC);
    if (fd_ < 0) fail(errno);
    return;
  }
  if (!target_.has_filename()) fail(EISDIR);
  // rename() would replace a file that its owner has write-protected.
  if (exists && ::faccessat(AT_FDCWD, target_.c_str(), W_OK, AT_EACCESS) != 0) fail(errno);
  for (int attempt = 0; attempt < 100; ++attempt) {
    // A long name must not become too long by our additions: only its head is repeated.
    const std::string name = fmt::format(".{}.{}-{}.tmp", target_.filename().string().substr(0, 32), ::getpid(), g_temporary_count++);
    const fs::path candidate = folder_of(target_) / name;
    fd_ = ::open(candidate.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (fd_ >= 0) {
      temporary_ = candidate;
      break;
    }
    if (errno != EEXIST) fail(errno);
  }
  if (fd_ < 0) fail(EEXIST);
  if (exists && ::fchmod(fd_, status.st_mode & 07777) != 0) fail(errno);
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : shown_(std::move(other.shown_)), target_(std::move(other.target_)), temporary_(std::move(other.temporary_)), fd_(other.fd_) {
  other.temporary_.clear();
  other.fd_ = -1;
}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::write(std::span<const std::byte> bytes) {
  ETALON_CHECK(fd_ >= 0, "write to a closed file");
  const WriteSignalsHeld held;
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd_, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(errno);
    if (n == 0) fail(ENOSPC);
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
}

void AtomicFile::flush() {
  if (fd_ < 0) return;
  // A pipe or a terminal has nothing to flush and says EINVAL.
  if (!temporary_.empty() && ::fsync(fd_) != 0) fail(errno);
  const int fd = std::exchange(fd_, -1);
  if (::close(fd) != 0) fail(errno);
}

void AtomicFile::commit() {
  flush();
  if (temporary_.empty()) return;
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  temporary_.clear();
  // The rename itself outlives a power cut only once the folder is flushed; file systems that cannot do so are no reason to fail.
  const int folder = ::open(folder_of(target_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder >= 0) {
    ::fsync(folder);
    ::close(folder);
  }
}

void AtomicFile::fail(int error_number) {
  discard();
  throw WriteError(fmt::format("{}: cannot write: {}", shown_.string(), std::strerror(error_number)));
}

void AtomicFile::discard() noexcept {
  if (fd_ >= 0) ::close(fd_);
  fd_ = -1;
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  temporary_.clear();
}

void write_file(const fs::path& path, std::span<const std::byte> bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

void write_file(const fs::path& path, std::string_view text) { write_file(path, std::as_bytes(std::span(text.data(), text.size()))); }

void write_files(const std::vector<std::pair<fs::path, std::string>>& files) {
  std::vector<AtomicFile> open_files;
  for (const auto& [path, content] : files) {
    open_files.emplace_back(path);
    open_files.back().write(content);
    open_files.back().flush();
  }
  for (AtomicFile& file : open_files) file.commit();
}

}  // namespace etalon::io
