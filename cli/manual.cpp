#include "cli/manual.h"

#include <algorithm>
#include <functional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace etalon::cli {
namespace {

std::vector<const CLI::App*> verbs_of(const CLI::App& root) {
  return root.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<const CLI::Option*> options_of(const CLI::App& verb) {
  return verb.get_options([](const CLI::Option*) { return true; });
}

/// Text for roff: no character is a command, a hyphen is one that can be copied.
std::string roff(std::string_view text) {
  std::string result;
  bool at_line_start = true;
  for (const char c : text) {
    if (at_line_start && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else
      result += c;
    at_line_start = c == '\n';
  }
  return result;
}

/// "N" of "N:INT in [1 - 16]", "half|full" of "half|full:{half,full}".
std::string type_of(const CLI::Option& option) {
  const std::string name = option.get_type_name();
  return name.substr(0, name.find(':'));
}

/// "INT in [1 - 16]", where the option says so; lists of words stand in the type already.
std::string range_of(const CLI::Option& option) {
  const std::string name = option.get_type_name();
  const std::size_t colon = name.find(':');
  if (colon == std::string::npos) return {};
  const std::string range = name.substr(colon + 1);
  return range.find(" in [") == std::string::npos ? std::string() : range;
}

std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

/// The words that a value is one of: those parts of "chen|kim|all" or "FILE|front" that are no placeholders in capitals.
std::vector<std::string> words_of(const CLI::Option& option) {
  std::vector<std::string> words;
  const std::string type = type_of(option) + "|";
  for (std::size_t at = 0, end = 0; (end = type.find('|', at)) != std::string::npos; at = end + 1) {
    const std::string word = type.substr(at, end - at);
    if (!word.empty() &&
        std::all_of(word.begin(), word.end(), [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '/'; }))
      words.push_back(word);
  }
  return words.size() > 1 ? words : std::vector<std::string>();
}

std::string joined(const std::vector<std::string>& words, const char* between) { return fmt::format("{}", fmt::join(words, between)); }

std::string usage_of(const CLI::App& verb) {
  std::string usage;
  for (const CLI::Option* option : options_of(verb)) {
    if (!option->get_positional()) continue;
    const std::string name = roff(type_of(*option).empty() ? option->get_name() : type_of(*option));
    const std::string item = fmt::format("\\fI{}\\fR{}", name, option->get_items_expected_max() > 1 ? " ..." : "");
    usage += option->get_required() ? " " + item : " [" + item + "]";
  }
  return usage + " [\\fIOPTION\\fR ...]";
}

std::string option_paragraph(const CLI::Option& option) {
  std::string head;
  if (option.get_positional()) {
    head = "\\fI" + roff(type_of(option)) + "\\fR";
  } else {
    for (const std::string& name : names_of(option)) head += (head.empty() ? "\\fB" : ", \\fB") + roff(name) + "\\fR";
    if (takes_value(option)) head += " \\fI" + roff(type_of(option)) + "\\fR";
  }
  const std::string range = range_of(option);
  return fmt::format(".TP\n{}\n{}{}{}\n", head, roff(option.get_description()), range.empty() ? "" : roff(" (" + range + ")"),
                     option.get_required() ? " (required)" : "");
}

/// "Example:\n  etalon …" as the lines behind a heading.
std::string examples_of(const CLI::App& verb) {
  const std::string footer = verb.get_footer();
  const std::size_t first = footer.find('\n');
  if (footer.empty() || first == std::string::npos) return {};
  return fmt::format(".PP\n.EX\n{}\n.EE\n", roff(footer.substr(first + 1)));
}

}  // namespace

std::string man_page(const CLI::App& root, const std::string& version) {
  std::string page = fmt::format(
      ".TH ETALON 1 \"\" \"etalon {}\" \"User Commands\"\n.SH NAME\netalon \\- {}\n.SH SYNOPSIS\n\\fBetalon\\fR \\fIVERB\\fR "
      "[\\fIOPTION\\fR ...]\n.br\n\\fBetalon\\fR \\fIVERB\\fR \\fB\\-\\-help\\fR\n.SH DESCRIPTION\n{}\n",
      version, "a ground-truth rasterizer for textured meshes", roff(root.get_description()));
  for (const CLI::App* verb : verbs_of(root)) {
    page += fmt::format(".SH {}\n\\fBetalon {}\\fR{}\n.PP\n{}\n", roff(verb->get_name()), roff(verb->get_name()), usage_of(*verb),
                        roff(verb->get_description()));
    for (const CLI::Option* option : options_of(*verb)) page += option_paragraph(*option);
    page += examples_of(*verb);
  }
  return page +
         ".SH EXIT STATUS\n.TP\n0\ndone, or agreed\n.TP\n1\nwarning: something could not be compared, or ties are not proven\n.TP\n2\nthe "
         "check "
         "failed\n.TP\n3\nsizes differ\n.TP\n4\nbad input, or a file that cannot be read or written\n.TP\n64\nthe command line is "
         "wrong\n.TP\n130\ninterrupted\n";
}

std::string bash_completion(const CLI::App& root) {
  std::string verbs, values, words;
  for (const CLI::App* verb : verbs_of(root)) {
    verbs += (verbs.empty() ? "" : " ") + verb->get_name();
    std::vector<std::string> options, first;
    for (const CLI::Option* option : options_of(*verb)) {
      const std::vector<std::string> names = names_of(*option), choices = words_of(*option);
      options.insert(options.end(), names.begin(), names.end());
      if (option->get_positional()) {
        first.insert(first.end(), choices.begin(), choices.end());
      } else if (takes_value(*option)) {
        for (const std::string& name : names)
          values += fmt::format("    {}:{}) words='{}' wants=value ;;\n", verb->get_name(), name, joined(choices, " "));
      }
    }
    words += fmt::format("    {}) options='{}' words='{}' ;;\n", verb->get_name(), joined(options, " "), joined(first, " "));
  }
  return fmt::format(
      R"(# bash completion of etalon; source it, or put it into /etc/bash_completion.d. Made by: etalon --completion
_etalon() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}} verb=${{COMP_WORDS[1]}} options= words= wants=
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    mapfile -t COMPREPLY < <(compgen -W '{0} --help --version' -- "$current")
    return
  fi
  case "$verb:$previous" in
{1}  esac
  if [ -z "$wants" ]; then
    case "$verb" in
{2}    esac
  fi
  case "$current" in
    -*) mapfile -t COMPREPLY < <(compgen -W "$options" -- "$current") ;;
    *) mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current"; compgen -f -- "$current") ;;
  esac
}}
complete -o filenames -F _etalon etalon
)",
      verbs, values, words);
}

}  // namespace etalon::cli
