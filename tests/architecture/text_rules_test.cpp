// Planted violations of the text rules: each is seen, and what only looks like one is not.
#include "tests/architecture/text_rules.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

using namespace etalon::test;

namespace {

std::vector<std::string> rules_broken(const std::string& path, const std::string& text) {
  std::vector<std::string> rules;
  for (const Violation& violation : check_text({path, text})) rules.push_back(violation.rule);
  return rules;
}

bool breaks(const std::string& text, const std::string& rule) {
  return rules_broken("core/mesh/a.cpp", text + "\n") == std::vector<std::string>{rule};
}

bool clean(const std::string& text) { return rules_broken("core/mesh/a.cpp", text + "\n").empty(); }

}  // namespace

TEST_CASE("text rules: libm's transcendental functions") {
  CHECK(breaks("double y = std::sin(x);", "libm"));
  CHECK(breaks("double y = sin (x);", "libm"));
  CHECK(breaks("double y = ::pow(x, 2);", "libm"));
  CHECK(breaks("float y = 2 * std::atan2f(x, y);", "libm"));
  CHECK(breaks("return log10(x);", "libm"));
  CHECK(clean("double y = std::sqrt(x) + std::abs(x) + std::floor(x);"));
  CHECK(clean("double y = camera.tan_half_fov_y * catalog(x) + log_of(x) + table.exp(x);"));
  CHECK(breaks("bool b = y > sin(x);", "libm"));
  CHECK(breaks("  exp(x);", "libm"));
  CHECK(clean("std::string log(static_cast<std::size_t>(length), ' '); object->log(text);"));
  CHECK(clean("// sin(x) is not called\nconst char* shader = \"sin(x)\";"));
  CHECK(rules_broken("tests/mesh/a_test.cpp", "double y = std::sin(x);\n").empty());
}

TEST_CASE("text rules: randomness that is not ours, in tests too") {
  CHECK(breaks("#include <random>", "random"));
  CHECK(breaks("int i = rand();", "random"));
  CHECK(breaks("std::shuffle(v.begin(), v.end(), g);", "random"));
  CHECK(rules_broken("tests/mesh/a_test.cpp", "#include <random>\n") == std::vector<std::string>{"random"});
  CHECK(clean("etalon::Rng rng(1); operand(2);"));
}

TEST_CASE("text rules: unordered containers") {
  CHECK(breaks("std::unordered_map<int, int> m;", "unordered"));
  CHECK(breaks("#include <unordered_set>", "unordered"));
  CHECK(clean("std::map<int, int> m; bool unordered_edges = false;"));
}

TEST_CASE("text rules: leave to change floating-point values") {
  CHECK(breaks("#pragma STDC FP_CONTRACT ON", "fast math"));
  CHECK(breaks("#pragma GCC optimize(\"O3\")", "fast math"));
}

TEST_CASE("text rules: marks of unfinished work, in comments above all") {
  CHECK(breaks(std::string("// TO") + "DO: later", "unfinished"));
  CHECK(breaks(std::string("int x;  // FIX") + "ME", "unfinished"));
  CHECK(clean("// what todo lists are for"));
}

TEST_CASE("text rules: headers") {
  CHECK(rules_broken("core/mesh/a.h", "// A header.\n") == std::vector<std::string>{"pragma once"});
  CHECK(rules_broken("core/mesh/a.h", "// #pragma once\n") == std::vector<std::string>{"pragma once"});
  CHECK(rules_broken("core/mesh/a.h", "// A header.\n#pragma once\n").empty());
}

TEST_CASE("text rules: size") {
  const auto lines = [](int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += "\n";
    return text;
  };
  CHECK(rules_broken("core/mesh/a.cpp", lines(600)).empty());
  CHECK(rules_broken("core/mesh/a.cpp", lines(601)) == std::vector<std::string>{"size"});
  CHECK(rules_broken("core/mesh/srgb_table.inc", lines(601)).empty());
}

TEST_CASE("text rules: file names") {
  CHECK(rules_broken("core/mesh/MeshTools.cpp", "") == std::vector<std::string>{"file name"});
  CHECK(rules_broken("core/mesh/mesh-tools.cpp", "") == std::vector<std::string>{"file name"});
}

TEST_CASE("text rules: an exemption covers its rule in its file, needs a reason, and must be needed") {
  const std::vector<SourceFile> files = {{"core/mesh/a.cpp", "double y = std::log10(x);\n"}};
  CHECK(check_texts(files, {}).size() == 1);
  CHECK(check_texts(files, {{"core/mesh/a.cpp", "libm", "printed only"}}).empty());
  CHECK(check_texts(files, {{"core/mesh/a.cpp", "random", "wrong rule"}}).size() == 2);
  CHECK(check_texts(files, {{"core/mesh/b.cpp", "libm", "wrong file"}}).size() == 2);
  CHECK(check_texts(files, {{"core/mesh/a.cpp", "libm", ""}}).size() == 2);
}
