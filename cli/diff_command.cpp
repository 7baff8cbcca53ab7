#include "cli/diff_command.h"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "cli/attribution.h"
#include "cli/call_files.h"
#include "cli/diff_files.h"
#include "cli/exit_code.h"
#include "cli/interrupt.h"
#include "cli/model_input.h"
#include "cli/usage_error.h"
#include "core/io/atomic_file.h"
#include "core/io/image_file.h"
#include "raster/cpu_renderer.h"
#include "validation/diff/diff_document.h"
#include "validation/diff/diff_page.h"
#include "validation/diff/picture.h"
#include "validation/diff/waivers.h"

namespace etalon::cli {
namespace {

using namespace etalon::validation;

struct Options {
  std::string golden, candidate;
  std::optional<double> fail, warn, fail_relative, warn_relative;
  double fail_percent = 0, warn_percent = 0;
  std::optional<double> hard_fail, hard_warn;
  std::uint64_t allow_failures = 0;
  std::string output;
  bool only_if_different = false, absolute = false, all = false;
  double scale = 1;
  std::string device, draws, texel, waivers, junit, html;
  CommonOptions common;
};

PixelThresholds thresholds_of(const Options& options) {
  PixelThresholds result;
  // With a device a single unexplained texel fails, however small its difference.
  result.fail.absolute = options.fail.value_or(options.device.empty() ? 1e-6 : 0);
  result.fail.relative = options.fail_relative.value_or(0);
  result.fail.percent = options.fail_percent;
  if (options.hard_fail) result.fail.hard = *options.hard_fail;
  result.warn.absolute = options.warn.value_or(result.fail.absolute);
  result.warn.relative = options.warn_relative.value_or(result.fail.relative);
  result.warn.percent = options.warn_percent;
  if (options.hard_warn) result.warn.hard = *options.hard_warn;
  result.allow_failures = options.allow_failures;
  return result;
}

TexelPlace parse_texel(const std::string& text) {
  const auto number = [&](const char* begin, const char* end) {
    int value = -1;
    const auto [at, error] = std::from_chars(begin, end, value);
    return error == std::errc() && at == end ? value : -1;
  };
  const std::size_t comma = text.find(',');
  const char *begin = text.data(), *end = begin + text.size();
  TexelPlace place{-1, -1};
  if (comma != std::string::npos) place = {number(begin, begin + comma), number(begin + comma + 1, end)};
  if (place.x < 0 || place.y < 0) throw UsageError(fmt::format("--texel: expected X,Y from 0, row 0 lowest, got '{}'", text));
  return place;
}

// A description of a device that `etalon probe` has written, not a name.
bool is_probe(const std::string& device) {
  const std::string extension = std::filesystem::path(device).extension().string();
  return extension == ".json" || extension == ".JSON";
}

PairOptions pair_options(const Options& options) {
  PairOptions result;
  result.thresholds = thresholds_of(options);
  if (is_probe(options.device)) result.device = device_of_probe(options.device);
  try {
    if (!options.device.empty() && !result.device) result.device = device_of_name(options.device);
  } catch (const InputError& error) {
    throw UsageError(std::string("--device: ") + error.what());
  }
  result.draws_path = options.draws;
  if (!options.texel.empty()) result.texel = parse_texel(options.texel);
  if (!options.html.empty()) result.picture_px = 1024;
  return result;
}

void require_sensible(const Options& options) {
  if (options.device.empty() && !options.draws.empty()) throw UsageError("--draws needs --device: they are what classes are decided by");
  if (options.device.empty() && !options.waivers.empty()) throw UsageError("--waivers needs --device: a waiver is for one");
  if (options.output.empty() && options.only_if_different) throw UsageError("--od needs -o FILE");
  for (const auto& [name, value] : {std::pair("-o", options.output), {"--junit", options.junit}, {"--html", options.html}})
    if (value == "-") throw UsageError(fmt::format("{}: expected a file; only --json writes to standard output", name));
  std::error_code ignored;
  if (!std::filesystem::is_directory(options.golden, ignored)) return;
  for (const auto& [name, value] : {std::pair("-o", options.output), {"--draws", options.draws}, {"--texel", options.texel}})
    if (!value.empty()) throw UsageError(fmt::format("{}: of two pictures, not of two folders", name));
}

void write_difference(const Options& options, const PairResult& pair) {
  if (options.output.empty() || pair.status != PairStatus::compared) return;
  if (options.only_if_different && pair.pixels.differing == 0) return;
  std::string extension = std::filesystem::path(options.output).extension().string();
  const bool as_float = extension == ".exr" || extension == ".EXR";
  const Image golden = read_picture(options.golden).color, candidate = read_picture(options.candidate).color;
  io::write_image(options.output, difference_image(golden, candidate, options.scale, options.absolute, as_float));
}

const char* word_of(PairVerdict verdict) {
  switch (verdict) {
    case PairVerdict::pass: return "PASS";
    case PairVerdict::warning: return "WARNING";
    case PairVerdict::failure: return "FAILURE";
    case PairVerdict::sizes_differ: return "SIZES DIFFER";
    case PairVerdict::bad_input: return "NOT READ";
  }
  return "";
}

int exit_code(PairVerdict verdict) {
  switch (verdict) {
    case PairVerdict::pass: return kExitDone;
    case PairVerdict::warning: return kExitWarning;
    case PairVerdict::failure: return kExitCheckFailed;
    case PairVerdict::sizes_differ: return kExitSizesDiffer;
    case PairVerdict::bad_input: return kExitBadInput;
  }
  return kExitBadInput;
}

void print_pair(const PairResult& pair, const PixelThresholds& thresholds, bool single, Console& console) {
  if (!single && pair.verdict == PairVerdict::pass && pair.note.empty()) return;
  console.line(pair.name);
  for (const std::string& line : pair_lines(pair, thresholds)) console.line("  " + line);
  console.line(std::string("  ") + word_of(pair.verdict));
}

VerifyInput input_of(const std::string& path, const std::string& sha256, const std::string& role) {
  return {.name = std::filesystem::path(path).filename().string(),
          .sha256 = sha256,
          .path = path,
          .role = role,
          .attribution = attribution_of(sha256)};
}

int run(const Options& options) {
  apply(options.common);
  require_sensible(options);
  Console console(console_options(options.common));
  const std::vector<FilePair> files = file_pairs(options.golden, options.candidate);
  CallFiles call;
  for (const FilePair& pair : files) {
    call.add_input(pair.golden, "the golden picture");
    call.add_input(pair.candidate, "the candidate");
  }
  call.add_input(options.draws, "--draws");
  call.add_input(options.waivers, "--waivers");
  if (is_probe(options.device)) call.add_input(options.device, "--device");
  const std::vector<std::pair<std::string, const char*>> outputs{
      {options.output, "-o"}, {options.common.json, "--json"}, {options.junit, "--junit"}, {options.html, "--html"}};
  for (const auto& [path, what] : outputs) {
    call.add_output(path, what);
    require_writable_file(path);
  }
  const PairOptions asked = pair_options(options);
  const std::vector<Waiver> waivers = options.waivers.empty() ? std::vector<Waiver>() : read_waivers(options.waivers);

  raster::CpuRenderer exact;
  std::vector<PairResult> pairs;
  for (const FilePair& pair : files) {
    console.progress("comparing", static_cast<int>(pairs.size()), static_cast<int>(files.size()));
    if (pair.golden.empty() || pair.candidate.empty())
      pairs.push_back(missing_pair(pair.name, pair.golden.empty() ? PairStatus::only_candidate : PairStatus::only_golden));
    else
      pairs.push_back(diff_pair(pair.name, pair.golden, pair.candidate, exact, asked));
  }
  const std::vector<std::string> unused = apply_waivers(pairs, waivers, asked.device ? asked.device->model.name : "", today_utc());
  for (const PairResult& pair : pairs) print_pair(pair, asked.thresholds, pairs.size() == 1, console);
  if (pairs.size() > 1) {
    const auto count = [&](PairVerdict verdict) {
      return std::count_if(pairs.begin(), pairs.end(), [&](const PairResult& pair) { return pair.verdict == verdict; });
    };
    console.line(fmt::format("{} compared: {} pass, {} with warnings, {} fail", counted(pairs.size(), "pair"), count(PairVerdict::pass),
                             count(PairVerdict::warning),
                             static_cast<std::ptrdiff_t>(pairs.size()) - count(PairVerdict::pass) - count(PairVerdict::warning)));
  }

  RunInfo run_info = current_run(options.common.start);
  run_info.paths = {options.golden, options.candidate};
  std::vector<VerifyInput> inputs;
  if (pairs.size() == 1 && pairs.front().status == PairStatus::compared)
    inputs = {input_of(pairs.front().golden_path, pairs.front().golden_sha256, "golden"),
              input_of(pairs.front().candidate_path, pairs.front().candidate_sha256, "candidate")};
  if (!pairs.front().draws_path.empty() && pairs.size() == 1) inputs.push_back(file_input(pairs.front().draws_path, "draws"));
  if (is_probe(options.device)) inputs.push_back(file_input(options.device, "device"));
  if (!options.waivers.empty()) inputs.push_back(file_input(options.waivers, "waivers"));
  nlohmann::ordered_json document = diff_document(pairs, asked.thresholds, inputs, run_info);
  document["unused_waivers"] = unused;
  if (!unused.empty()) document["verdict"] = to_string(std::max(worst_verdict(pairs), PairVerdict::failure));
  {
    const FinishWriting finish;
    if (pairs.size() == 1) write_difference(options, pairs.front());
    if (!options.junit.empty()) io::write_file(options.junit, diff_junit(pairs, asked.thresholds, unused));
    if (!options.html.empty()) io::write_file(options.html, diff_page(pairs, asked.thresholds, run_info));
  }
  write_document(options.common, document);
  if (pairs.size() == 1 && pairs.front().verdict == PairVerdict::bad_input) throw InputError(pairs.front().problem);
  for (const std::string& line : unused) print_error(line);
  return std::max(exit_code(worst_verdict(pairs)), unused.empty() ? kExitDone : kExitCheckFailed);
}

void add_threshold_options(CLI::App& app, Options& options) {
  const auto positive = number_between(0, 1e300);
  const auto percent = number_between(0, 100);
  app.add_option("--fail", options.fail, "Differences above this fail (1e-6; with --device 0)")->type_name("X")->check(positive);
  app.add_option("--failrelative", options.fail_relative, "... that are also above this share of the mean of both values (0)")
      ->type_name("R")
      ->check(positive);
  app.add_option("--failpercent", options.fail_percent, "So many percent of the texels may (0)")->type_name("P")->check(percent);
  app.add_option("--hardfail", options.hard_fail, "No texel may differ by more (inf)")->type_name("X")->check(positive);
  app.add_option("--allowfailures", options.allow_failures, "So many texels may differ by any amount (0)")
      ->type_name("N")
      ->check(number_between(0, 1e15));
  app.add_option("--warn", options.warn, "Differences above this warn (as --fail)")->type_name("X")->check(positive);
  app.add_option("--warnrelative", options.warn_relative, "(as --failrelative)")->type_name("R")->check(positive);
  app.add_option("--warnpercent", options.warn_percent, "(0)")->type_name("P")->check(percent);
  app.add_option("--hardwarn", options.hard_warn, "(inf)")->type_name("X")->check(positive);
}

}  // namespace

Verb add_diff(CLI::App& root) {
  const auto options = std::make_shared<Options>();
  CLI::App* app = root.add_subcommand("diff", "Compare a picture with a golden one: by thresholds, or by what a device may do");
  app->add_option("golden", options->golden, "Picture, or folder of pictures")->required()->type_name("GOLDEN");
  app->add_option("candidate", options->candidate, "Picture of the same size, or folder")->required()->type_name("CANDIDATE");
  add_threshold_options(*app, *options);
  app->add_option("-o,--output", options->output, "Write the picture of the differences, candidate - golden: .exr with signs, .png clamped")
      ->type_name("FILE");
  app->add_flag("--od", options->only_if_different, "... only where something differs");
  app->add_flag("--abs", options->absolute, "... their absolute values");
  app->add_option("--scale", options->scale, "... times this (1)")->type_name("X")->check(number_between(-1e300, 1e300));
  app->add_flag("-a", options->all, "idiff's 'all subimages': a picture here has one");
  app->add_option("--device", options->device,
                  "Let the classes decide: contract, llvmpipe, gl, d3d11, vulkan:BITS[:TEXELBITS], or what etalon probe wrote")
      ->type_name("NAME|PROBE.json")
      ->check(not_empty());
  app->add_option("--draws", options->draws, "What the golden was made from (default: what it names, or the .draws beside it)")
      ->type_name("FILE.draws")
      ->check(not_empty());
  app->add_option("--texel", options->texel, "Explain one texel in a sentence; row 0 is the lowest")->type_name("X,Y")->check(not_empty());
  app->add_option("--waivers", options->waivers, "Known failures: reason, device, end (etalon/waivers/1)")
      ->type_name("FILE")
      ->check(not_empty());
  app->add_option("--junit", options->junit, "Write JUnit XML")->type_name("FILE")->check(not_empty());
  app->add_option("--html", options->html, "Write a page: slider, heat map, classes, histogram, worst texels")
      ->type_name("FILE")
      ->check(not_empty());
  add_common_options(*app, options->common,
                     "  etalon diff golden.png candidate.png --fail 0.004 --failpercent 0.1\n"
                     "  etalon diff golden.exr candidate.png --device llvmpipe --html diff.html\n"
                     "  etalon diff goldens candidates --junit diff.xml");
  return {app, [options] { return run(*options); }};
}

}  // namespace etalon::cli
