// The manual page and the completion of bash say what --help says.
#include <cstdlib>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/cli/run_command.h"

using namespace etalon::test;

namespace {

std::vector<std::string> found(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> result;
  for (auto match = std::sregex_iterator(text.begin(), text.end(), regex); match != std::sregex_iterator(); ++match)
    result.push_back((*match)[1]);
  return result;
}

std::vector<std::string> verbs() {
  const std::string help = run_etalon({"--help"}).out;
  const std::size_t start = help.find("Subcommands:");
  return found(help.substr(start, help.find("Examples:") - start), "\n  ([a-z]+) ");
}

std::string section_of(const std::string& page, const std::string& verb) {
  const std::size_t start = page.find("\n.SH " + verb + "\n");
  return start == std::string::npos ? std::string() : page.substr(start, page.find("\n.SH ", start + 1) - start);
}

/// What pressing the tabulator behind `words` offers, one a line.
std::string completed(const ScratchFolder& folder, const std::string& words) {
  const std::string script = folder.path() / "completion";
  const std::string out = folder.path() / "offered";
  const std::string command = "cd '" + folder.path().string() + "' && bash -c '. ./completion; COMP_WORDS=(" + words +
                              "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _etalon; printf \"%s\\n\" \"${COMPREPLY[@]}\"' >'" + out + "'";
  REQUIRE(std::system(command.c_str()) == 0);
  return "\n" + read_text(out);
}

}  // namespace

TEST_CASE("--man: every verb and every option of its --help, and nothing that roff would take for a command") {
  const CommandResult man = run_etalon({"--man"});
  CHECK(man.exit_code == 0);
  CHECK(man.err.empty());
  CHECK(man.out.rfind(".TH ETALON 1 ", 0) == 0);
  CHECK(run_etalon({"--man"}).out == man.out);
  const std::vector<std::string> all = verbs();
  CHECK(all.size() == 14);
  for (const std::string& verb : all) {
    const std::string section = section_of(man.out, verb);
    CAPTURE(verb);
    REQUIRE(!section.empty());
    const std::string help = run_etalon({verb, "--help"}).out;
    const std::vector<std::string> options = found(help, "\n  (?:-[a-z],)?--([a-z0-9-]+)");
    CHECK(options.size() >= 5);
    for (const std::string& option : options) {
      CAPTURE(option);
      CHECK(section.find("\\fB\\-\\-" + std::regex_replace(option, std::regex("-"), "\\-") + "\\fR") != std::string::npos);
    }
    CHECK(section.find("etalon " + verb + " ") != std::string::npos);  // an example
  }
  // Lines that begin with a dot are ours.
  for (const std::string& macro : found(man.out, "(?:^|\n)([.'][^ \n]*)"))
    CHECK(std::set<std::string>{".TH", ".SH", ".TP", ".PP", ".EX", ".EE", ".br"}.count(macro) == 1);
}

TEST_CASE("--completion: verbs, options, and the words that an option is one of") {
  const ScratchFolder folder;
  const CommandResult script = run_etalon({"--completion"});
  REQUIRE(script.exit_code == 0);
  folder.file("completion", script.out);
  folder.file("model.ply", "");
  const std::string first = completed(folder, "etalon \"\"");
  for (const std::string& verb : verbs()) {
    CAPTURE(verb);
    CHECK(first.find("\n" + verb + "\n") != std::string::npos);
    const std::string offered = completed(folder, "etalon " + verb + " --");
    for (const std::string& option : found(run_etalon({verb, "--help"}).out, "\n  (?:-[a-z],)?(--[a-z0-9-]+)")) {
      CAPTURE(option);
      CHECK(offered.find("\n" + option + "\n") != std::string::npos);
    }
  }
  CHECK(completed(folder, "etalon sim") == "\nsimplify\n");
  CHECK(completed(folder, "etalon simplify --metric q") == "\nqem\nqem5\nqem6\n");
  CHECK(completed(folder, "etalon study ch") == "\nchen\n");
  CHECK(completed(folder, "etalon simplify m") == "\nmodel.ply\n");
  CHECK(completed(folder, "etalon simplify -o m") == "\nmodel.ply\n");
}
