#include "cli/suggestion.h"

#include <doctest/doctest.h>

using etalon::cli::nearest_word;

TEST_CASE("the nearest verb") {
  const std::vector<std::string> verbs{"verify", "render", "info", "make"};
  CHECK(nearest_word("verfy", verbs) == "verify");
  CHECK(nearest_word("evrify", verbs) == "verify");
  CHECK(nearest_word("rendre", verbs) == "render");
  CHECK(nearest_word("inf", verbs) == "info");
  CHECK(nearest_word("mke", verbs) == "make");
  CHECK(!nearest_word("simplify", verbs).has_value());
  CHECK(!nearest_word("x", verbs).has_value());
  CHECK(!nearest_word(std::string(100000, 'v'), verbs).has_value());
}
