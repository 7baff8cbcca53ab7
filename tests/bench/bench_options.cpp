#include "tests/bench/bench_options.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "core/base/error.h"

namespace etalon::bench {
namespace {

int number(const std::string& option, const std::string& text, int lowest, int highest) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < lowest || value > highest)
    throw InputError(fmt::format("{}: expected {} to {}, got '{}'", option, lowest, highest, text));
  return value;
}

}  // namespace

BenchOptions parse_options(const std::vector<std::string>& arguments) {
  BenchOptions options;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& option = arguments[i];
    const auto value = [&]() -> const std::string& {
      if (i + 1 == arguments.size()) throw InputError(fmt::format("{}: expected a value after it", option));
      return arguments[++i];
    };
    if (option == "--help" || option == "-h")
      options.help = true;
    else if (option == "--list")
      options.list = true;
    else if (option == "--scene")
      options.scenes.push_back(value());
    else if (option == "--repetitions")
      options.repetitions = number(option, value(), kFewestRounds, 10'000);
    else if (option == "--seconds")
      options.seconds = number(option, value(), 0, 36'000);
    else if (option == "--threads")
      options.threads = number(option, value(), 1, 32);
    else if (option == "--rival-threads")
      options.rival_threads = number(option, value(), 0, 32);
    else if (option == "--all-levels")
      options.all_levels = true;
    else if (option == "--only-ours")
      options.only_ours = true;
    else if (option == "--long")
      options.long_scenes = true;
    else if (option == "--picture")
      options.picture = value();
    else if (option == "--json")
      options.json = value();
    else if (option == "--page")
      options.page = value();
    else if (option == "--from")
      options.from = value();
    else
      throw InputError(fmt::format("{}: expected an option of etalon_bench --help", option));
  }
  return options;
}

std::string usage() {
  return fmt::format(
      "usage: etalon_bench [OPTIONS] [--benchmark_OPTIONS]\n"
      "Times the CPU renderer, llvmpipe and the limits of memory in turns, on drawings that both get alike; simplification beside CGAL, "
      "OpenMesh\n"
      "and meshoptimizer; the surface distance and baking beside MeshLab; texture streams beside OpenJPEG; joint compression. Prints the "
      "ratios.\n"
      "\n"
      "  --scene NAME       only scenes whose name contains NAME; may be repeated\n"
      "  --list             the names of the scenes\n"
      "  --repetitions N    rounds of a scene without much else on the machine (default {}, at least {})\n"
      "  --seconds S        begin no further round of a scene after S seconds (default {}); where other programs took more than {:.0f} % "
      "of\n"
      "                     the processors in all but a few rounds till then, all rounds count, and the tables say what others took\n"
      "  --threads N        of ours and of llvmpipe (default {})\n"
      "  --rival-threads N  of llvmpipe alone; 0: it draws in the calling thread\n"
      "  --all-levels       ours at every SIMD level that this machine has\n"
      "  --only-ours        nothing but our renderer: for a profiler\n"
      "  --long             also the scenes that take minutes: simplification of up to 10,000,000 faces, a quadtree of 4097²\n"
      "  --json FILE        write the results\n"
      "  --page FILE        put the tables into the measured blocks of a Markdown page\n"
      "  --picture FILE     how the time of simplification grows, as SVG; needs --long\n"
      "  --from FILE        the tables from results written before; nothing is measured\n"
      "\n"
      "  etalon_bench --scene head --repetitions 25 --json head.json\n"
      "  etalon_bench --all-levels --page docs/performance.md\n"
      "  perf record -F 499 etalon_bench --scene terrain --only-ours --repetitions 200\n"
      "Exit code: 0 done; 2 the renderers draw different images; 4 bad input or file; 64 usage.\n",
      BenchOptions{}.repetitions, kFewestRounds, BenchOptions{}.seconds, 100 * kMostOthers, BenchOptions{}.threads);
}

bool wants(const BenchOptions& options, const std::string& scene) {
  return options.scenes.empty() ||
         std::ranges::any_of(options.scenes, [&](const std::string& part) { return scene.find(part) != std::string::npos; });
}

}  // namespace etalon::bench
