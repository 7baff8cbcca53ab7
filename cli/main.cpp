// The etalon command: parse, run the verb, turn what went wrong into one line and an exit code.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "cli/adapt_command.h"
#include "cli/bake_command.h"
#include "cli/console.h"
#include "cli/diff_command.h"
#include "cli/diff_files.h"
#include "cli/exit_code.h"
#include "cli/info_command.h"
#include "cli/interrupt.h"
#include "cli/joint_command.h"
#include "cli/make_command.h"
#include "cli/manual.h"
#include "cli/metro_command.h"
#include "cli/probe_command.h"
#include "cli/progressive_command.h"
#include "cli/render_command.h"
#include "cli/selftest_command.h"
#include "cli/simplify_command.h"
#include "cli/study_command.h"
#include "cli/suggestion.h"
#include "cli/usage_error.h"
#include "cli/verify_command.h"
#include "core/base/error.h"
#include "core/base/memory_limit.h"
#include "validation/report/run_info.h"

namespace {

using namespace etalon;
using namespace etalon::cli;

// CLI11 would call an unknown verb a stray argument; say what was meant instead.
void require_known_verb(int argc, char** argv, const std::vector<Verb>& verbs) {
  if (argc < 2)
    throw UsageError(
        "expected a verb: verify, render, info, make, simplify, progressive, adapt, bake, joint, metro, diff, probe, study or selftest "
        "(see "
        "etalon "
        "--help)");
  const std::string typed = argv[1];
  if (typed.empty() || typed.front() == '-') return;
  std::vector<std::string> names;
  for (const Verb& verb : verbs) names.push_back(verb.app->get_name());
  if (std::find(names.begin(), names.end(), typed) != names.end()) return;
  const auto nearest = nearest_word(typed, names);
  throw UsageError(
      fmt::format("unknown verb '{}'{} (see etalon --help)", typed, nearest ? fmt::format(", did you mean '{}'?", *nearest) : ""));
}

std::string prefix_of(const std::vector<Verb>& verbs) {
  for (const Verb& verb : verbs) {
    if (verb.app->parsed()) return verb.app->get_name() + ": ";
  }
  return "";
}

int run(int argc, char** argv) {
  CLI::App root("étalon: an exact CPU rasterizer, the same scenes on OpenGL, and an explanation of every texel that differs.", "etalon");
  root.set_version_flag("--version", "etalon " + validation::etalon_version());
  root.require_subcommand(1);
  root.footer(
      "Examples:\n  etalon verify\n  etalon verify spot.obj --report spot-report\n  etalon render head.glb -o head.png\n"
      "Exit codes: 0 done, 1 warning, 2 check failed, 3 sizes differ, 4 bad input or write error, 64 usage, 130 interrupted.\n"
      "etalon --man prints the manual page, etalon --completion a script for bash.");
  const std::vector<Verb> verbs{add_verify(root),      add_render(root), add_info(root),  add_make(root),    add_simplify(root),
                                add_progressive(root), add_adapt(root),  add_bake(root),  add_joint(root),   add_metro(root),
                                add_diff(root),        add_probe(root),  add_study(root), add_selftest(root)};
  if (argc == 2 && argv[1] == std::string("--man")) return write_stdout(man_page(root, validation::etalon_version())), kExitDone;
  if (argc == 2 && argv[1] == std::string("--completion")) return write_stdout(bash_completion(root)), kExitDone;
  require_known_verb(argc, argv, verbs);
  try {
    std::vector<std::string> arguments = with_two_dashes({argv + 1, argv + argc});
    std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
    root.parse(arguments);
  } catch (const CLI::Success& request) {  // --help, --version
    std::ostringstream text;
    root.exit(request, text, text);
    write_stdout(text.str());
    return kExitDone;
  } catch (const CLI::ParseError& error) {
    throw UsageError(prefix_of(verbs) + error.what());
  }
  for (const Verb& verb : verbs) {
    if (verb.app->parsed()) return verb.run();
  }
  throw UsageError("expected a verb (see etalon --help)");
}

}  // namespace

int main(int argc, char** argv) {
  watch_for_interrupt();
  try {
    return run(argc, argv);
  } catch (const UsageError& error) {
    print_error(error.what());
    return kExitUsage;
  } catch (const UnavailableError& error) {
    print_error(error.what());
    return kExitWarning;
  } catch (const std::bad_alloc&) {
    const std::optional<MemoryLimit> limit = memory_limit();
    print_error(limit ? fmt::format("out of memory: {} are used of {}: {}", memory_text(limit->used_bytes), memory_text(limit->limit_bytes),
                                    limit->name)
                      : "out of memory");
    return kExitBadInput;
  } catch (const std::exception& error) {
    print_error(error.what());
    return kExitBadInput;
  }
}
