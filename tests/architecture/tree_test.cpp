// The rules on this very tree.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/architecture/include_rules.h"
#include "tests/architecture/source_text.h"
#include "tests/architecture/text_rules.h"

using namespace etalon::test;

namespace {

const std::vector<Exemption> kExemptions = {};

const std::vector<SourceFile>& tree() {
  static const std::vector<SourceFile> kTree = read_tree(ETALON_SOURCE_DIR);
  return kTree;
}

void report(const std::vector<Violation>& violations) {
  for (const Violation& violation : violations) FAIL_CHECK(violation.text());
}

std::string read(const std::filesystem::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Whether the CMakeLists.txt of the file's folder or of one above it names the file by its path from there.
bool is_built(const std::string& path) {
  namespace fs = std::filesystem;
  for (fs::path folder = fs::path(path).parent_path();; folder = folder.parent_path()) {
    const std::string list = read(fs::path(ETALON_SOURCE_DIR) / folder / "CMakeLists.txt");
    if (list.find(fs::path(path).lexically_relative(folder.empty() ? "." : folder).generic_string()) != std::string::npos) return true;
    if (folder.empty()) return false;
  }
}

}  // namespace

TEST_CASE("tree: it is the right one") {
  CHECK(tree().size() > 30);
  std::size_t includes = 0;
  for (const SourceFile& file : tree()) includes += includes_of(file.text).size();
  CHECK(includes > 100);
}

TEST_CASE("tree: the layers hold") { report(check_includes(tree())); }

TEST_CASE("tree: the judge shares no code with the judged") { report(check_reference_reach(tree())); }

TEST_CASE("tree: the text rules hold") { report(check_texts(tree(), kExemptions)); }

TEST_CASE("tree: every .cpp is built by some CMakeLists.txt") {
  for (const SourceFile& file : tree())
    if (file.path.ends_with(".cpp") && !is_built(file.path)) FAIL_CHECK(file.path << ": no CMakeLists.txt names it");
}
