#include "tests/validation/reference/suite_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <istream>

#include "tests/validation/reference/fast_subject.h"
#include "tests/validation/reference/frame_suite.h"
#include "tests/validation/reference/lattice_suite.h"
#include "tests/validation/reference/mass_suite.h"
#include "tests/validation/reference/tiling_suite.h"

namespace etalon::validation::reference {

namespace {

struct SeedRange {
  std::uint64_t first;
  std::uint64_t count;
};

// [1, count] in pieces of at most `piece`.
std::vector<SeedRange> pieces(std::uint64_t count, std::uint64_t piece) {
  std::vector<SeedRange> ranges;
  for (std::uint64_t done = 0; done < count; done += piece) ranges.push_back({1 + done, std::min(piece, count - done)});
  return ranges;
}

std::string seeds(const char* suite, SeedRange range) {
  return fmt::format("{} seeds {}..{}", suite, range.first, range.first + range.count - 1);
}

std::vector<Block> mass_blocks(Suite suite, std::uint64_t triangles, int samples_per_triangle, const MakeSubject& subject) {
  std::vector<Block> blocks;
  for (const SeedRange range : pieces((triangles + kTrianglesPerBlock - 1) / kTrianglesPerBlock, 1250))
    blocks.push_back({seeds(to_string(suite), range), [=] { return run_mass({range.first, range.count, samples_per_triangle}, subject); }});
  return blocks;
}

// Full: all triangles under all fill rules. Quick: one in twenty, each first vertex under one of the rules.
std::vector<Block> lattice_blocks(Suite suite, bool full, const MakeSubject& subject) {
  std::vector<Block> blocks;
  for (int rule = 0; rule < 4; ++rule)
    for (int first = 0; first < kLatticePoints; first += 13) {
      if (!full && (first / 13) % 4 != rule) continue;
      LatticeOptions options{first, 13, static_cast<FillRule>(rule), full ? 1 : 20, full ? 100 : 5};
      blocks.push_back({fmt::format("{} {} points {}..{}", to_string(suite), to_string(options.fill_rule), first, first + 12),
                        [options, subject] { return run_lattice(options, subject); }});
    }
  return blocks;
}

std::vector<Block> tiling_blocks(std::uint64_t count, int size) {
  std::vector<Block> blocks;
  for (const SeedRange range : pieces(count, 1))
    blocks.push_back({fmt::format("{} size {}", seeds("tilings", range), size), [=] {
                        EveryLevelRenderer renderer;
                        return run_tilings({range.first, range.count, size}, renderer);
                      }});
  return blocks;
}

using RunFrames = Tally (*)(const FrameOptions&, Renderer&);

void add_frame_blocks(std::vector<Block>& blocks, const char* suite, RunFrames run, std::uint64_t count, std::uint64_t piece, int width,
                      int height, int triangles) {
  for (const SeedRange range : pieces(count, piece))
    blocks.push_back({fmt::format("{} {}x{}", seeds(suite, range), width, height), [=] {
                        EveryLevelRenderer renderer;
                        return run({range.first, range.count, width, height, triangles}, renderer);
                      }});
}

}  // namespace

std::vector<Block> blocks_of(Suite suite, Length length) {
  const bool full = length == Length::full;
  std::vector<Block> blocks;
  switch (suite) {
    case Suite::mass: return mass_blocks(suite, full ? 2'000'000 : 40'000, 64, raster_subject());
    case Suite::mass_exact: return mass_blocks(suite, full ? 200'000 : 4'000, 64, exact_raster_subject());
    case Suite::mass_fast: return mass_blocks(suite, full ? 2'000'000 : 10'000, 64, fast_subject());
    case Suite::judge: return mass_blocks(suite, full ? 10'000 : 500, 16, judge_subject(Arithmetic::rational));
    case Suite::lattice: return lattice_blocks(suite, full, raster_subject());
    case Suite::lattice_fast: return lattice_blocks(suite, full, fast_subject());
    case Suite::tilings: return full ? tiling_blocks(6, 2048) : tiling_blocks(1, 512);
    case Suite::frames:
      add_frame_blocks(blocks, "frames", run_frames, full ? 10'000 : 100, 100, 24, 24, 30);
      add_frame_blocks(blocks, "frames", run_frames, full ? 200 : 2, 10, 150, 100, 60);  // several tiles
      return blocks;
    case Suite::threads: add_frame_blocks(blocks, "threads", run_threads, full ? 200 : 3, 10, 300, 200, 400); return blocks;
  }
  return blocks;
}

const std::vector<Suite>& all_suites() {
  static const std::vector<Suite> kSuites{Suite::mass,         Suite::mass_exact, Suite::mass_fast, Suite::judge,  Suite::lattice,
                                          Suite::lattice_fast, Suite::tilings,    Suite::frames,    Suite::threads};
  return kSuites;
}

const char* to_string(Suite suite) {
  switch (suite) {
    case Suite::mass: return "mass";
    case Suite::mass_exact: return "mass_exact";
    case Suite::mass_fast: return "mass_fast";
    case Suite::judge: return "judge";
    case Suite::lattice: return "lattice";
    case Suite::lattice_fast: return "lattice_fast";
    case Suite::tilings: return "tilings";
    case Suite::frames: return "frames";
    case Suite::threads: return "threads";
  }
  return "";
}

std::string log_line(const Block& block, const Tally& tally, double seconds) {
  return fmt::format("{} | {} | {:.2f} s", block.name, to_string(tally), seconds);
}

std::set<std::string> agreed_blocks(std::istream& log) {
  std::set<std::string> names;
  for (std::string line; std::getline(log, line);)
    if (line.find(": 0 mismatches | ") != std::string::npos && line.ends_with(" s")) names.insert(line.substr(0, line.find(" | ")));
  return names;
}

}  // namespace etalon::validation::reference
