// The reader of the checker: comments, literals and #include lines.
#include "tests/architecture/source_text.h"

#include <doctest/doctest.h>

using namespace etalon::test;

TEST_CASE("source text: #include lines, with their spelling and line numbers") {
  const auto found = includes_of("// head\n#include \"core/a.h\"\n\n  #  include <tbb/tbb.h>  // why\n#define X\n");
  REQUIRE(found.size() == 2);
  CHECK(found[0].line == 2);
  CHECK(found[0].target == "core/a.h");
  CHECK(found[0].quoted);
  CHECK(found[1].line == 4);
  CHECK(found[1].target == "tbb/tbb.h");
  CHECK_FALSE(found[1].quoted);
}

TEST_CASE("source text: an #include in a comment is none") {
  CHECK(includes_of("// #include <random>\n/* \n#include <random>\n*/\n").empty());
}

TEST_CASE("source text: comments and literals become spaces, line breaks stay") {
  CHECK(code_only("a // b\nc") == "a     \nc");
  CHECK(code_only("a /* b\n */ c") == "a     \n    c");
  CHECK(code_only("f(\"sin(x)\", 'c')") == "f(        ,    )");
  CHECK(code_only("\"a\\\"b\" c") == "       c");
  CHECK(code_only("R\"glsl(sin(x) \" // )glsl\" y").find("sin") == std::string::npos);
  CHECK(code_only("R\"glsl(sin(x) \" // )glsl\" y").ends_with(" y"));
}

TEST_CASE("source text: a digit separator opens no literal") { CHECK(code_only("1'000'000 + x") == "1'000'000 + x"); }

TEST_CASE("source text: folders") {
  CHECK(folder_of("core/mesh/mesh.h") == "core/mesh");
  CHECK(folder_of("README.md").empty());
  CHECK(is_under("core/io/png.cpp", "core/io"));
  CHECK(is_under("core/io", "core/io"));
  CHECK_FALSE(is_under("core/iology/a.h", "core/io"));
}
