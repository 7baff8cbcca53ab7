#include "core/io/inputs.h"

#include <doctest/doctest.h>
#include <sys/stat.h>

#include "core/io/input_error.h"
#include "core/io/text_scan.h"
#include "tests/io/scratch.h"

namespace etalon::io {
namespace {

using test::input_error;
using test::ScratchFolder;

TEST_CASE("inputs: whole files; folders, pipes, devices, missing and empty files are refused by name") {
  const ScratchFolder folder;
  CHECK(read_file(folder.put("a", std::string_view("x\0y", 3))).text() == std::string_view("x\0y", 3));
  CHECK(input_error([&] { (void)read_file(folder.path()); }) == folder.path().string() + ": expected a file, got a folder");
  CHECK(input_error([&] { (void)read_file(folder / "none"); }) == (folder / "none").string() + ": No such file or directory");
  CHECK(input_error([&] { (void)read_file(folder.put("empty", "")); }) == (folder / "empty").string() + ": the file is empty");
  CHECK(input_error([&] { (void)read_file("/dev/zero"); }) == "/dev/zero: expected a regular file, got a device or a pipe");
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  CHECK(input_error([&] { (void)read_file(folder / "pipe"); }) ==
        (folder / "pipe").string() + ": expected a regular file, got a device or a pipe");
}

TEST_CASE("inputs: sha256 of files, the FIPS 180-4 examples") {
  const ScratchFolder folder;
  CHECK(file_sha256(folder.put("abc", "abc")) == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(file_sha256(folder.put("empty", "")) == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  CHECK(file_sha256(folder.put("million", std::string(1000000, 'a'))) ==
        "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  CHECK(input_error([&] { (void)file_sha256(folder.path()); }) == folder.path().string() + ": expected a file, got a folder");
}

TEST_CASE("messages: one printable line whatever the file holds") {
  CHECK(printable("a b") == "a b");
  CHECK(printable("a\nb\xff") == "a\\x0ab\\xff");
  CHECK(printable("abcdef", 3) == "abc…");
  CHECK(printable("abc", 3) == "abc");
  CHECK(printable("\xff\xff\xff", 11) == "\\xff\\xff…");  // the limit is of what is shown
  CHECK(first_line("one\ntwo") == "one");
  CHECK(input_error([] { fail_at_line("f.obj", 7, "what"); }) == "f.obj:7: what");
  CHECK(input_error([] { fail_at_byte("f.ply", 70, "what"); }) == "f.ply: byte 70: what");
  CHECK(input_error([] { fail_file("f.glb", "what"); }) == "f.glb: what");
}

TEST_CASE("text: words and blanks") {
  std::string_view text = " \t a  bc\r";
  CHECK(take_word(text) == "a");
  CHECK(take_word(text) == "bc");
  CHECK(take_word(text).empty());
  CHECK(trimmed(" a b \r") == "a b");
  CHECK(trimmed(" \t").empty());
}

TEST_CASE("text: floats are the nearest, refused where not finite or not all of the word") {
  CHECK(parse_float("1") == 1.0f);
  CHECK(parse_float("+.5") == 0.5f);
  CHECK(parse_float("-2e3") == -2000.0f);
  // Half way between 1 and the next float, and a digit more: rounding by way of double would fall to the even side.
  CHECK(parse_float("1.000000059604644775390625") == 1.0f);
  CHECK(parse_float("1.00000005960464477539062500000000000000000001") == 0x1.000002p0f);
  CHECK(parse_float("3.4028235e38") == 0x1.fffffep127f);
  CHECK(parse_float("1e-45") == 0x1p-149f);
  CHECK(parse_float("1e-60") == 0.0f);
  CHECK(parse_float("1e-600") == 0.0f);
  CHECK(parse_float("-1e-600") == 0.0f);
  for (const char* bad :
       {"", "+", "-", "nan", "NaN", "inf", "-inf", "infinity", "1e39", "-1e39", "1e600", "1x", "0x10", "1,5", "+-1", "++1", "."})
    CHECK_MESSAGE(!parse_float(bad).has_value(), bad);
}

TEST_CASE("text: integers") {
  CHECK(parse_integer("12") == 12);
  CHECK(parse_integer("+12") == 12);
  CHECK(parse_integer("-9223372036854775808") == INT64_MIN);
  for (const char* bad : {"", "+", "1.0", "9223372036854775808", "1e3", "a", "+-1"}) CHECK_MESSAGE(!parse_integer(bad).has_value(), bad);
}

}  // namespace
}  // namespace etalon::io
