#include "validation/report/html_text.h"

#include <span>

#include <doctest/doctest.h>

#include "validation/report/html_case.h"
#include "validation/report/html_report.h"

using namespace etalon;
using namespace etalon::validation;

namespace {

std::string encoded(const std::string& text) { return base64(std::as_bytes(std::span(text.data(), text.size()))); }

}  // namespace

TEST_CASE("base64: the vectors of RFC 4648") {
  CHECK(encoded("") == "");
  CHECK(encoded("f") == "Zg==");
  CHECK(encoded("fo") == "Zm8=");
  CHECK(encoded("foo") == "Zm9v");
  CHECK(encoded("foobar") == "Zm9vYmFy");
  CHECK(encoded("\xff\xfe\xfd") == "//79");
}

TEST_CASE("escaping") {
  CHECK(escaped("<a href=\"x\">&</a>") == "&lt;a href=&quot;x&quot;&gt;&amp;&lt;/a&gt;");
  CHECK(escaped(std::string("a\0b", 3)) ==
        "a\xEF\xBF\xBD"
        "b");
}

TEST_CASE("a picture becomes a PNG data URI") {
  CHECK(png_data_uri(Image(2, 2, kRgb8)).rfind("data:image/png;base64,iVBORw0KGgo", 0) == 0);
}

TEST_CASE("shares never round a part to all or to nothing") {
  CHECK(share(0, 10) == "0 %");
  CHECK(share(10, 10) == "100 %");
  CHECK(share(1, 3) == "33.3333 %");
  CHECK(share(1, 1000000000) == "&lt; 0.0001 %");
  CHECK(share(999999999, 1000000000) == "&gt; 99.9999 %");
}

TEST_CASE("file URLs") {
  CHECK(file_url("/tmp/a b/ü.html") == "file:///tmp/a%20b/%C3%BC.html");
  CHECK(file_url("/a/../b#c") == "file:///b%23c");
}
