#include "cli/probe_command.h"

#include <memory>

#include <fmt/format.h>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "cli/call_files.h"
#include "cli/exit_code.h"
#include "cli/gl_options.h"
#include "cli/interrupt.h"
#include "cli/model_input.h"
#include "core/base/error.h"
#include "core/io/atomic_file.h"
#include "validation/diff/waivers.h"
#include "validation/probe/probe_document.h"
#include "validation/report/json_report.h"

namespace etalon::cli {
namespace {

struct Options {
  std::string output;
  GlOptions gl;
  CommonOptions common;
};

int run(const Options& options) {
  apply(options.common);
  Console::Options told = console_options(options.common);
  told.data_on_stdout = told.data_on_stdout || options.output == "-";
  Console console(told);
  CallFiles call;
  call.add_output(options.output, "-o");
  call.add_output(options.common.json, "--json");
  if (options.output != "-") require_writable_file(options.output);
  require_writable_file(options.common.json);
  const OpenedProbeDevice opened = open_probe_device(options.gl, options.common.threads);
  if (!opened.renderer) throw UnavailableError(opened.unavailable);
  console.line(opened.words.name);
  validation::ProbeOptions asked;
  asked.progress = [&](const std::string& experiment, int done, int total) { console.progress(experiment, done, total); };
  validation::ProbeRecord record{opened.words, validation::today_utc(), validation::probe_device(*opened.renderer, asked)};
  for (const std::string& line : validation::probe_lines(record.findings)) console.line("  " + line);
  const int declared = record.device.declared_subtexel_bits;
  if (record.findings.coverage.subtexel_bits && *record.findings.coverage.subtexel_bits != declared)
    console.line(fmt::format("  note: the device declares {} sub-texel bits", declared));
  const nlohmann::ordered_json document = validation::probe_document(record, validation::current_run(options.common.start));
  if (options.output == "-") {
    write_stdout(validation::to_text(document));
  } else {
    const FinishWriting finish;
    io::write_file(options.output, validation::to_text(document));
  }
  write_document(options.common, document);
  return kExitDone;
}

}  // namespace

Verb add_probe(CLI::App& root) {
  const auto options = std::make_shared<Options>();
  CLI::App* app = root.add_subcommand("probe", "Measure an OpenGL device: its grid, fill rule, interpolation error, sampler, storage");
  app->add_option("-o,--output", options->output, "Description of the device to write, for etalon diff --device ('-': standard output)")
      ->required()
      ->type_name("PROBE.json")
      ->check(not_empty());
  add_gl_options(*app, options->gl);
  add_common_options(*app, options->common,
                     "  etalon probe -o llvmpipe.json\n"
                     "  etalon probe --context egl -o gpu.json\n"
                     "  etalon diff golden.exr candidate.png --device gpu.json");
  return {app, [options] { return run(*options); }};
}

}  // namespace etalon::cli
