#include "cli/selftest_command.h"

#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "cli/exit_code.h"
#include "cli/gl_options.h"
#include "cli/usage_error.h"
#include "core/base/error.h"
#include "validation/report/json_report.h"
#include "validation/selftest/selftest.h"

namespace etalon::cli {
namespace {

using namespace etalon::validation;
using Json = nlohmann::ordered_json;

struct Options {
  bool small = false;
  std::string simd = "all";
  std::uint64_t seed = 1;
  CommonOptions common;
};

std::string joined(const std::vector<raster::SimdLevel>& levels) {
  std::string text;
  for (const raster::SimdLevel level : levels) text += (text.empty() ? "" : " ") + raster::to_string(level);
  return text;
}

std::vector<raster::SimdLevel> chosen_levels(const std::string& text) {
  std::vector<raster::SimdLevel> available = raster::available_simd_levels();
  if (text == "all") return available;
  const std::optional<raster::SimdLevel> level = raster::parse_simd_level(text);
  if (!level) throw UsageError(fmt::format("selftest: --simd: expected all or one of {}, got '{}'", joined(available), text));
  if (std::find(available.begin(), available.end(), *level) == available.end())
    throw UnavailableError(fmt::format("selftest: --simd {}: not available on this machine, which has {}", text, joined(available)));
  return {*level};
}

// What OpenGL there is, in one line; there need not be any.
struct GlFinding {
  std::string device;
  std::string text;
};

GlFinding find_gl(int threads) {
  const OpenedDevice opened = open_device(GlOptions{}, threads);
  if (!opened.renderer) return {"", "not available (" + opened.unavailable + "): nothing here depends on it"};
  const std::string name = opened.renderer->name();
  RasterState wanted;
  wanted.subtexel_bits = 16;
  const RasterState state = opened.renderer->supported_state(wanted);
  return {name, fmt::format("{}: {} sub-texel bits, fill rule {}, half rounding {}", name, state.subtexel_bits, to_string(state.fill_rule),
                            to_string(state.half_rounding))};
}

void print_arithmetic(const SelftestResult& result, Console& console) {
  std::size_t failed = 0;
  for (const FloatCheck& check : result.arithmetic) failed += check.passed() ? 0 : 1;
  console.line(fmt::format("arithmetic  {} in {}: {}", counted(result.arithmetic.size(), "check"), counted(result.threads, "thread"),
                           failed == 0 ? "IEEE 754, as written" : counted(failed, "failure")));
  for (const FloatCheck& check : result.arithmetic)
    if (!check.passed()) console.line(fmt::format("  {}: expected {}, got {}", check.name, check.expected, check.got));
}

std::string row(const Drawing& drawing) {
  return fmt::format("  {:<10}  {:<8}  {:>2} {:<7}", to_string(drawing.evaluation), level_name(drawing), drawing.threads,
                     drawing.threads == 1 ? "thread" : "threads");
}

void print_hash(const HashRun& run, Console& console) {
  console.line(
      fmt::format("{}  {:6.2f} s  {:.16}…  {}", row(run.drawing), run.seconds, run.sha256, run.difference.empty() ? "same" : "DIFFERS"));
  if (!run.difference.empty()) console.line("  " + run.difference);
}

void print_judge(const JudgeRun& run, Console& console) {
  console.line(fmt::format("{}  {:>9} texels  {:>9} values  {}", row(run.drawing), grouped(run.texels), grouped(run.values),
                           run.mismatches == 0 ? "all equal" : counted(run.mismatches, "DIFFERENT value")));
  if (run.mismatches > 0) console.line("  " + run.first_mismatch);
}

Json to_json(const Drawing& drawing) {
  Json object = {{"evaluation", to_string(drawing.evaluation)}};
  object["simd"] = drawing.evaluation == raster::Evaluation::vectorised ? Json(level_name(drawing)) : Json(nullptr);
  object["threads"] = drawing.threads;
  return object;
}

// Levels, threads and OpenGL are this machine's, so they stand in `run`.
Json document_of(const Options& options, const SelftestResult& result, const std::string& device) {
  Json document = document_head("selftest", {});
  document["small"] = options.small;
  document["seed"] = options.seed;
  document["passed"] = result.passed();
  document["golden"] = result.golden.all;
  document["families"] = Json::array();
  for (const SceneHashes::Family& family : result.golden.families)
    document["families"].push_back({{"name", family.name}, {"sha256", family.sha256}});
  RunInfo run_info = current_run(options.common.start);
  run_info.device = device;
  Json run = validation::to_json(run_info);
  run["arithmetic"] = Json::array();
  for (const FloatCheck& check : result.arithmetic)
    run["arithmetic"].push_back({{"check", check.name}, {"expected", check.expected}, {"got", check.got}});
  run["hashes"] = Json::array();
  for (const HashRun& hash : result.hashes) {
    Json entry = to_json(hash.drawing);
    entry.update({{"sha256", hash.sha256}, {"difference", hash.difference}, {"seconds", hash.seconds}});
    run["hashes"].push_back(std::move(entry));
  }
  run["judge"] = Json::array();
  for (const JudgeRun& judge : result.judged) {
    Json entry = to_json(judge.drawing);
    entry.update(
        {{"texels", judge.texels}, {"values", judge.values}, {"mismatches", judge.mismatches}, {"first_mismatch", judge.first_mismatch}});
    run["judge"].push_back(std::move(entry));
  }
  document["run"] = std::move(run);
  return document;
}

int run(const Options& options) {
  apply(options.common);
  Console console(console_options(options.common));
  require_writable_file(options.common.json);
  SelftestOptions selftest;
  selftest.small = options.small;
  selftest.levels = chosen_levels(options.simd);
  selftest.seed = options.seed;
  if (options.small) selftest.threads = {2, 1};
  if (options.common.threads > 0) selftest.threads = {options.common.threads};
  selftest.progress = [&](const std::string& label, int done, int total) { console.progress(label, done, total); };
  selftest.arithmetic_done = [&](const SelftestResult& result) {
    print_arithmetic(result, console);
    console.line(fmt::format("hash        {} in {} families, drawn again and again", counted(result.scenes, "scene"),
                             result.golden.families.size()));
  };
  selftest.hash_done = [&](const HashRun& hash) { print_hash(hash, console); };
  selftest.judge_starts = [&] { console.line("judge       scenes by chance, every value against big integers"); };
  selftest.judge_done = [&](const JudgeRun& judge) { print_judge(judge, console); };
  const SelftestResult result = run_selftest(selftest);
  const GlFinding gl = find_gl(options.common.threads);
  console.line("OpenGL      " + gl.text);
  console.line("expected    " + result.golden.all);
  console.line(result.passed() ? "selftest passed: this build draws the contract's bytes on this machine"
                               : "selftest FAILED: this build does not draw the contract's bytes on this machine");
  write_document(options.common, document_of(options, result, gl.device));
  if (options.common.quiet && !result.passed()) print_error(first_failure(result));
  return result.passed() ? kExitDone : kExitCheckFailed;
}

}  // namespace

std::string first_failure(const SelftestResult& result) {
  for (const FloatCheck& check : result.arithmetic)
    if (!check.passed()) return fmt::format("selftest: {}: expected {}, got {}", check.name, check.expected, check.got);
  for (const HashRun& run : result.hashes)
    if (run.sha256 != result.golden.all)
      return fmt::format("selftest: {} {}, {}: expected {}, got {}: {}", to_string(run.drawing.evaluation), level_name(run.drawing),
                         counted(static_cast<std::uint64_t>(run.drawing.threads), "thread"), result.golden.all, run.sha256, run.difference);
  for (const JudgeRun& run : result.judged)
    if (run.mismatches > 0)
      return fmt::format("selftest: {} {}: {} other than the judge's, the first {}", to_string(run.drawing.evaluation),
                         level_name(run.drawing), counted(run.mismatches, "value"), run.first_mismatch);
  return "";
}

Verb add_selftest(CLI::App& root) {
  const auto options = std::make_shared<Options>();
  CLI::App* app = root.add_subcommand("selftest", "Check that this build draws the contract's bytes on this machine");
  app->add_flag("--small", options->small, "A second or two: the vector kernels only, fewer thread counts, a tenth of the judge's scenes");
  app->add_option("--simd", options->simd,
                  "Vector instructions to draw with: all (default), or one of baseline ssse3 sse4 avx2 avx512 neon")
      ->type_name("LEVEL")
      ->check(not_empty());
  app->add_option("--seed", options->seed, "Of the scenes that the judge sees (default 1); other seeds, other scenes")
      ->type_name("N")
      ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1'000'000'000}));
  add_common_options(*app, options->common, "  etalon selftest\n  etalon selftest --small --simd avx2");
  return {app, [options] { return run(*options); }};
}

}  // namespace etalon::cli
