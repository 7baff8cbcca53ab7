#include "core/io/atomic_file.h"

#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/io/scratch.h"
#include "tests/support/skip.h"

namespace etalon::io {
namespace {

using test::content_of;
using test::ScratchFolder;
using test::write_error;

TEST_CASE("atomic file: a new file, a replaced file, no other file left") {
  const ScratchFolder folder;
  write_file(folder / "a", "first");
  CHECK(content_of(folder / "a") == "first");
  write_file(folder / "a", "second");
  CHECK(content_of(folder / "a") == "second");
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("atomic file: without commit the old file stays and the temporary goes") {
  const ScratchFolder folder;
  folder.put("a", "old");
  {
    AtomicFile file(folder / "a");
    file.write("half a ne");
    CHECK(folder.entry_count() == 2);
    CHECK(content_of(folder / "a") == "old");
  }
  CHECK(content_of(folder / "a") == "old");
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("atomic file: moved-from files own nothing") {
  const ScratchFolder folder;
  AtomicFile first(folder / "a");
  AtomicFile second(std::move(first));
  second.write("x");
  second.commit();
  CHECK(content_of(folder / "a") == "x");
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("atomic file: a full device is a WriteError with the reason") {
  CHECK(write_error([] { write_file("/dev/full", "x"); }) == "/dev/full: cannot write: No space left on device");
  CHECK(write_error([] { write_file("/dev/null", "x"); }) == "no error");
}

TEST_CASE("atomic file: a size limit in the middle of a file leaves the old one and no temporary") {
  const ScratchFolder folder;
  folder.put("a", "old");
  rlimit before{};
  REQUIRE(::getrlimit(RLIMIT_FSIZE, &before) == 0);
  rlimit small = before;
  small.rlim_cur = 1000;
  REQUIRE(::setrlimit(RLIMIT_FSIZE, &small) == 0);
  // Beyond the limit the kernel sends SIGXFSZ, which would end this program.
  const std::string message = write_error([&] { write_file(folder / "a", std::string(5000, 'x')); });
  const std::string several = write_error([&] { write_files({{folder / "b", "fits"}, {folder / "c", std::string(5000, 'x')}}); });
  REQUIRE(::setrlimit(RLIMIT_FSIZE, &before) == 0);
  CHECK(message == (folder / "a").string() + ": cannot write: File too large");
  CHECK(several == (folder / "c").string() + ": cannot write: File too large");
  CHECK(content_of(folder / "a") == "old");
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("atomic file: a pipe without reader is a WriteError, not the end of the process") {
  int ends[2];
  REQUIRE(::pipe(ends) == 0);
  const std::string path = "/dev/fd/" + std::to_string(ends[1]);
  ::close(ends[0]);
  CHECK(write_error([&] { write_file(path, "x"); }).find("cannot write: ") != std::string::npos);
  ::close(ends[1]);
}

TEST_CASE("atomic file: folders, missing folders and empty names") {
  const ScratchFolder folder;
  CHECK(write_error([&] { write_file(folder.path(), "x"); }) == folder.path().string() + ": cannot write: Is a directory");
  CHECK(write_error([&] { write_file(folder / "none/a", "x"); }) ==
        (folder / "none/a").string() + ": cannot write: No such file or directory");
  CHECK(write_error([] { write_file("", "x"); }) == ": cannot write: Is a directory");
  CHECK(folder.entry_count() == 0);
}

/// While alive, a program of root acts as user 65534 ("nobody"), whom permissions bind.
class WithoutRoot {
 public:
  explicit WithoutRoot(const std::filesystem::path& folder) {
    if (!is_root_) return;
    ok_ = ::chown(folder.c_str(), kNobody, kNobody) == 0 && ::setegid(kNobody) == 0 && ::seteuid(kNobody) == 0;
  }
  ~WithoutRoot() {
    if (is_root_ && (::seteuid(0) != 0 || ::setegid(0) != 0)) std::abort();
  }
  WithoutRoot(const WithoutRoot&) = delete;
  WithoutRoot& operator=(const WithoutRoot&) = delete;
  [[nodiscard]] bool ok() const { return ok_; }

 private:
  static constexpr uid_t kNobody = 65534;
  const bool is_root_ = ::geteuid() == 0;
  bool ok_ = true;
};

TEST_CASE("atomic file: a read-only folder and a read-only file refuse") {
  const ScratchFolder folder;
  const WithoutRoot guard(folder.path());
  if (!guard.ok()) return test::report_skip("read-only folder", "root may write everywhere and cannot act as another user here");
  folder.put("a", "old");
  ::chmod((folder / "a").c_str(), 0444);
  CHECK(write_error([&] { write_file(folder / "a", "x"); }) == (folder / "a").string() + ": cannot write: Permission denied");
  ::chmod(folder.path().c_str(), 0555);
  CHECK(write_error([&] { write_file(folder / "b", "x"); }) == (folder / "b").string() + ": cannot write: Permission denied");
  ::chmod(folder.path().c_str(), 0755);
  CHECK(content_of(folder / "a") == "old");
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("atomic file: permissions of the replaced file stay, links are followed") {
  const ScratchFolder folder;
  folder.put("a", "old");
  ::chmod((folder / "a").c_str(), 0640);
  std::filesystem::create_symlink("a", folder / "link");
  write_file(folder / "link", "new");
  CHECK(std::filesystem::is_symlink(folder / "link"));
  CHECK(content_of(folder / "a") == "new");
  struct stat status {};
  REQUIRE(::stat((folder / "a").c_str(), &status) == 0);
  CHECK((status.st_mode & 0777) == 0640);
}

TEST_CASE("atomic file: the longest file name works") {
  const ScratchFolder folder;
  const std::string name(255, 'n');
  write_file(folder / name, "x");
  CHECK(content_of(folder / name) == "x");
}

TEST_CASE("atomic file: of several files none appears unless all were written") {
  const ScratchFolder folder;
  folder.put("a", "old");
  CHECK(write_error([&] {
          write_files({{folder / "a", "new"}, {folder / "none/b", "new"}});
        }).find("none/b: cannot write") != std::string::npos);
  CHECK(content_of(folder / "a") == "old");
  CHECK(folder.entry_count() == 1);
  write_files({{folder / "a", "new"}, {folder / "b", "also"}});
  CHECK(content_of(folder / "a") == "new");
  CHECK(content_of(folder / "b") == "also");
}

}  // namespace
}  // namespace etalon::io
