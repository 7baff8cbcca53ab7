// etalon_judge [SUITE …] [--full] [--log FILE]: runs the judge's suites (all where none is named), one line a block. With a log, every
// finished block is appended to it, and blocks that it already holds without a mismatch are not run again. Exit 0: no mismatch; 2: some.
// etalon_judge mass --first SEED --count BLOCKS: one range of random blocks again, as a mismatch names it.

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "tests/validation/reference/mass_suite.h"
#include "tests/validation/reference/suite_plan.h"

namespace {

using namespace etalon::validation::reference;

struct Options {
  std::vector<Suite> suites;
  Length length = Length::quick;
  std::string log;
  std::uint64_t first = 0;  // 0: the suite's own blocks
  std::uint64_t count = 1;
};

Suite suite_named(const std::string& name) {
  for (const Suite suite : all_suites())
    if (name == to_string(suite)) return suite;
  throw etalon::InputError(fmt::format("unknown suite or option '{}'", name));
}

Options parse(const std::vector<std::string>& arguments) {
  Options options;
  for (std::size_t n = 0; n < arguments.size(); ++n) {
    const std::string& argument = arguments[n];
    const auto value = [&] {
      if (n + 1 == arguments.size()) throw etalon::InputError(argument + " needs a value");
      return arguments[++n];
    };
    if (argument == "--full")
      options.length = Length::full;
    else if (argument == "--log")
      options.log = value();
    else if (argument == "--first")
      options.first = std::strtoull(value().c_str(), nullptr, 10);
    else if (argument == "--count")
      options.count = std::strtoull(value().c_str(), nullptr, 10);
    else
      options.suites.push_back(suite_named(argument));
  }
  if (options.suites.empty()) options.suites = all_suites();
  return options;
}

std::vector<Block> blocks_to_run(const Options& options) {
  std::vector<Block> blocks;
  if (options.first != 0) {
    blocks.push_back({fmt::format("mass first {} count {}", options.first, options.count), [options] {
                        return run_mass({options.first, options.count, 64}, raster_subject());
                      }});
    return blocks;
  }
  for (const Suite suite : options.suites)
    for (Block& block : blocks_of(suite, options.length)) blocks.push_back(std::move(block));
  return blocks;
}

int run(const Options& options) {
  std::ifstream earlier(options.log);
  const std::set<std::string> agreed = agreed_blocks(earlier);
  earlier.close();
  std::ofstream log;
  if (!options.log.empty()) {
    log.open(options.log, std::ios::app);
    if (!log) throw etalon::WriteError(options.log + ": cannot be written");
  }
  Tally sum;
  std::size_t skipped = 0;
  for (const Block& block : blocks_to_run(options)) {
    if (agreed.contains(block.name)) {
      ++skipped;
      continue;
    }
    const auto start = std::chrono::steady_clock::now();
    const Tally tally = block.run();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const std::string line = log_line(block, tally, seconds);
    std::puts(line.c_str());
    std::fflush(stdout);
    if (log.is_open()) log << line << std::endl;
    sum += tally;
  }
  std::puts(fmt::format("sum | {} | {} blocks already in the log", to_string(sum), skipped).c_str());
  return sum.mismatches == 0 ? 0 : 2;
}

}  // namespace

int main(int count, char** arguments) {
  try {
    return run(parse(std::vector<std::string>(arguments + 1, arguments + count)));
  } catch (const etalon::InputError& error) {
    std::fputs(fmt::format("etalon_judge: error: {}\n", error.what()).c_str(), stderr);
    return 64;
  } catch (const etalon::Error& error) {
    std::fputs(fmt::format("etalon_judge: error: {}\n", error.what()).c_str(), stderr);
    return 4;
  }
}
