// What the documentation names is there: files, links and their anchors, tests by their names, and the works that the sources cite.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/architecture/source_text.h"

namespace {

namespace fs = std::filesystem;
using etalon::test::read_tree;
using etalon::test::SourceFile;

const fs::path kRoot = ETALON_SOURCE_DIR;

std::string read(const fs::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// README.md, CONTRIBUTING.md and every page of docs/, from the root.
std::vector<std::string> pages() {
  std::vector<std::string> result = {"README.md", "CONTRIBUTING.md"};
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "docs"))
    if (entry.path().extension() == ".md") result.push_back(entry.path().lexically_relative(kRoot).generic_string());
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<std::smatch> matches(const std::string& text, const std::regex& pattern) {
  return {std::sregex_iterator(text.begin(), text.end(), pattern), {}};
}

/// GitHub's: lower case, blanks to '-', no other signs; bytes beyond ASCII stay.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading) {
    if (c == ' ') anchor += '-';
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' || static_cast<unsigned char>(c) >= 0x80)
      anchor += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return anchor;
}

bool has_anchor(const std::string& page, const std::string& anchor) {
  static const std::regex kHeading("(^|\n)#+ ([^\n]+)"), kId("id=\"([^\"]+)\"");
  for (const std::smatch& m : matches(page, kHeading))
    if (anchor_of(m[2]) == anchor) return true;
  for (const std::smatch& m : matches(page, kId))
    if (m[1] == anchor) return true;
  return false;
}

/// Text outside of fenced blocks.
std::string prose(const std::string& text) { return std::regex_replace(text, std::regex("(^|\n)```[^`]*\n```"), "\n"); }

/// Authors and year of a citation, without the place in the work: "Hoppe 1999" of "Hoppe 1999, sec. 4".
std::vector<std::string> citations_of(const std::string& text) {
  // A citation may go on in the next line of a comment.
  static const std::regex kLineEnd("\n *(//+<?)? *"), kBrackets(R"(\[([A-Z][^\[\]`]{2,160})\])");
  static const std::regex kWork(
      R"(^(([A-Z][A-Za-z]+(, [A-Z][A-Za-z]+)*( & [A-Z][A-Za-z]+| et al\.)?) (1[89]|20)[0-9]{2}|IEC [0-9:-]+|ISO [0-9-]+))");
  std::vector<std::string> works;
  const std::string unwrapped = std::regex_replace(text, kLineEnd, " ");
  for (const std::smatch& m : matches(unwrapped, kBrackets)) {
    const std::string inside = m[1];
    for (std::size_t at = 0; at < inside.size();) {
      const std::size_t end = std::min(inside.find("; ", at), inside.size());
      const std::string part = inside.substr(at, end - at);
      std::smatch work;
      if (std::regex_search(part, work, kWork)) works.push_back(work[1]);
      at = end + 2;
    }
  }
  return works;
}

}  // namespace

TEST_CASE("docs: every relative link leads to a file, and its anchor to a heading") {
  static const std::regex kLink(R"(\]\(([^)\s]+)\))");
  std::size_t count = 0;
  for (const std::string& page : pages()) {
    const std::string text = prose(read(kRoot / page));
    for (const std::smatch& m : matches(text, kLink)) {
      const std::string link = m[1];
      if (link.find("://") != std::string::npos || link.rfind("mailto:", 0) == 0) continue;
      const std::size_t hash = link.find('#');
      const fs::path target = hash == 0 ? kRoot / page : (kRoot / page).parent_path() / link.substr(0, hash);
      ++count;
      INFO(page << ": " << link);
      // Pictures and pages that a study writes lie beside its own page, not in the tree.
      if (page.find("-study.md") != std::string::npos && hash == std::string::npos && link.find('/') == std::string::npos) continue;
      CHECK(fs::exists(target));
      if (hash != std::string::npos && target.extension() == ".md") CHECK(has_anchor(read(target), link.substr(hash + 1)));
    }
  }
  CHECK(count > 60);
}

TEST_CASE("docs: every file or folder of the tree that running text names is there") {
  static const std::regex kCode("`((core|raster|gpu|validation|cli|tests|data|docs|cmake)/[A-Za-z0-9_./-]+)`");
  std::size_t count = 0;
  for (const std::string& page : pages()) {
    const std::string text = read(kRoot / page);
    for (const std::smatch& m : matches(text, kCode)) {
      INFO(page << ": " << m[1].str());
      ++count;
      CHECK(fs::exists(kRoot / m[1].str()));
    }
  }
  CHECK(count > 100);
}

TEST_CASE("docs: every test that a page names by its name is there") {
  static const std::regex kTest("`(tests/[A-Za-z0-9_/]+\\.cpp)` \"([^\"]+)\"");
  std::size_t count = 0;
  for (const std::string& page : pages()) {
    const std::string text = read(kRoot / page);
    for (const std::smatch& m : matches(text, kTest)) {
      INFO(page << ": " << m[1].str() << ": " << m[2].str());
      ++count;
      CHECK(read(kRoot / m[1].str()).find("TEST_CASE(\"" + m[2].str() + "\"") != std::string::npos);
    }
  }
  CHECK(count > 30);
}

TEST_CASE("docs: every work that sources and pages cite is in the bibliography") {
  const std::string bibliography = read(kRoot / "docs/bibliography.md");
  std::set<std::string> cited;
  for (const SourceFile& file : read_tree(ETALON_SOURCE_DIR))
    for (const std::string& work : citations_of(file.text)) cited.insert(work);
  for (const std::string& page : pages())
    for (const std::string& work : citations_of(read(kRoot / page))) cited.insert(work);
  CHECK(cited.size() > 25);
  for (const std::string& work : cited) {
    INFO(work);
    CHECK(bibliography.find("[" + work + "]") != std::string::npos);
  }
  CHECK(citations_of("// [Hoppe 1999, sec. 4; "
                     "Nobody & Else 1901]") == std::vector<std::string>{"Hoppe 1999", "Nobody & Else 1901"});
  CHECK(citations_of("/// [Nobody\n/// 1901, \"title\"]") == std::vector<std::string>{"Nobody 1901"});
}
