// The three kinds of error: an always-on check names its condition, its operands and its place.
#include "core/base/error.h"

#include <doctest/doctest.h>

#include <string>

TEST_CASE("ETALON_CHECK: a true condition does nothing, and its detail is not evaluated") {
  int evaluated = 0;
  const auto detail = [&] {
    ++evaluated;
    return std::string("never");
  };
  ETALON_CHECK(1 + 1 == 2, detail());
  CHECK(evaluated == 0);
}

TEST_CASE("ETALON_CHECK: a false one throws, with file, condition and operands") {
  const int faces = 3;
  std::string text;
  try {
    ETALON_CHECK(faces == 4, "faces = " + std::to_string(faces));
  } catch (const etalon::InternalError& error) {
    text = error.what();
  }
  CHECK(text.find("error_test.cpp:") != std::string::npos);
  CHECK(text.find("faces == 4") != std::string::npos);
  CHECK(text.find("(faces = 3)") != std::string::npos);
}

TEST_CASE("errors: each kind is an etalon::Error and no other kind") {
  CHECK_THROWS_AS(throw etalon::InputError("x"), etalon::Error);
  CHECK_THROWS_AS(throw etalon::WriteError("x"), etalon::Error);
  CHECK_THROWS_AS(throw etalon::UnavailableError("x"), etalon::Error);
  CHECK_THROWS_AS(throw etalon::InternalError("x"), etalon::Error);
  const etalon::InputError input("x");
  CHECK(dynamic_cast<const etalon::WriteError*>(static_cast<const etalon::Error*>(&input)) == nullptr);
}
