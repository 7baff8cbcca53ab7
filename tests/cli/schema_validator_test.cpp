#include "tests/cli/schema_validator.h"

#include <doctest/doctest.h>

using etalon::test::schema_violations;
using nlohmann::json;

TEST_CASE("the validator refuses what each keyword forbids") {
  const json schema =
      json::parse(R"({"type":"object","properties":{"n":{"type":"integer","minimum":0},"k":{"enum":["a","b"]},"c":{"const":1},
    "s":{"type":["string","null"],"pattern":"^x"},"l":{"type":"array","items":{"$ref":"#/$defs/n"}},"p":{"prefixItems":[{"type":"integer"},{"type":"string"}]}},
    "required":["n"],"additionalProperties":false,"$defs":{"n":{"type":"number"}}})");
  const auto count = [&](const char* text) { return schema_violations(schema, json::parse(text)).size(); };
  CHECK(count(R"({"n":0,"k":"a","c":1,"s":"xy","l":[1,2.5],"p":[1,"a"]})") == 0);
  CHECK(count(R"({"n":1,"s":null})") == 0);
  CHECK(count(R"({})") == 1);
  CHECK(count(R"({"n":-1})") == 1);
  CHECK(count(R"({"n":1.5})") == 1);
  CHECK(count(R"({"n":1,"k":"c"})") == 1);
  CHECK(count(R"({"n":1,"c":2})") == 1);
  CHECK(count(R"({"n":1,"s":"y"})") == 1);
  CHECK(count(R"({"n":1,"l":["a"]})") == 1);
  CHECK(count(R"({"n":1,"p":[1]})") == 1);
  CHECK(count(R"({"n":1,"p":["a","a"]})") == 1);
  CHECK(count(R"({"n":1,"other":1})") == 1);
  CHECK(count("[]") == 1);
  CHECK_THROWS((void)schema_violations(json::parse(R"({"oneOf":[]})"), json(1)));
}
