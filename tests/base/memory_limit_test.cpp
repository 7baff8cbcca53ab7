#include "core/base/memory_limit.h"

#include <sys/resource.h>

#include <doctest/doctest.h>

#include "core/base/error.h"

using namespace etalon;

namespace {

/// The limit of address space for one scope; soft, so that it can be taken back.
class AddressSpaceLimit {
 public:
  explicit AddressSpaceLimit(std::uint64_t bytes) {
    getrlimit(RLIMIT_AS, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    REQUIRE(setrlimit(RLIMIT_AS, &limit) == 0);
  }
  ~AddressSpaceLimit() { setrlimit(RLIMIT_AS, &before_); }
  AddressSpaceLimit(const AddressSpaceLimit&) = delete;
  AddressSpaceLimit& operator=(const AddressSpaceLimit&) = delete;

 private:
  rlimit before_{};
};

}  // namespace

TEST_CASE("memory_text: three digits, units of 1000") {
  CHECK(memory_text(0) == "0.00 KB");
  CHECK(memory_text(1'500) == "1.50 KB");
  CHECK(memory_text(812'400'000) == "812 MB");
  CHECK(memory_text(999'600'000) == "1.00 GB");
  CHECK(memory_text(1'073'741'824) == "1.07 GB");
  CHECK(memory_text(51'230'000'000'000) == "51.2 TB");
}

TEST_CASE("require_memory: what is more than a limit leaves is refused with the need, what is less is not") {
  // Above what any sanitizer reserves, below what a group could allow: 2^46 of 2^47 addresses.
  const AddressSpaceLimit scope(std::uint64_t{1} << 46);
  const auto limit = memory_limit();
  REQUIRE(limit);
  CHECK(limit->left_bytes() <= limit->limit_bytes);
  CHECK_NOTHROW(require_memory("small", 4096));
  std::string text;
  try {
    require_memory("m.obj: 7 triangles", std::uint64_t{1} << 47);
  } catch (const InputError& error) {
    text = error.what();
  }
  CHECK(text.find("m.obj: 7 triangles: expected at least 141 TB of memory for it, got ") == 0);
}
