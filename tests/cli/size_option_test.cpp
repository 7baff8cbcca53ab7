#include "cli/size_option.h"

#include <string>

#include <doctest/doctest.h>

#include "cli/usage_error.h"

using namespace etalon::cli;

TEST_CASE("sizes") {
  CHECK(parse_size("640x480") == FrameSize{640, 480});
  CHECK(parse_size("1X2") == FrameSize{1, 2});
  CHECK(parse_size("512") == FrameSize{512, 512});
  CHECK(parse_size("12288") == FrameSize{12288, 12288});
  for (const char* wrong :
       {"", "0", "-1", "12289", "1x", "x1", "1x0", "1x2x3", "12.5", " 5", "5 ", "+5", "99999999999999999999", "640*480", "0x10", "1x-3"}) {
    CAPTURE(std::string(wrong));
    CHECK_THROWS_AS((void)parse_size(wrong), UsageError);
  }
}
