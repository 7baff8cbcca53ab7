// etalon_hash_jobs [--threads N[,N…]] [--golden FILE] [MESH…]: does the jobs on small built-in models and prints a line a result: SHA256 NAME;
// given meshes, simplifies these by every metric instead. Results that differ between thread counts, or from FILE (lines as printed), are
// named. Exit code 0: none; 1: some; 64: usage.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/parallel.h"
#include "tests/determinism/jobs.h"
#ifdef ETALON_HASH_MESH_FILES
#include "core/io/mesh_file.h"
#include "core/mesh/weld.h"
#endif

using namespace etalon;
using namespace etalon::test;

namespace {

struct Arguments {
  std::vector<int> threads{1};
  std::string golden;
  std::vector<std::string> meshes;
};

bool parse(int argc, char** argv, Arguments& arguments) {
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--threads" && i + 1 < argc) {
      arguments.threads.clear();
      std::istringstream list(argv[++i]);
      for (std::string number; std::getline(list, number, ',');) arguments.threads.push_back(std::atoi(number.c_str()));
    } else if (word == "--golden" && i + 1 < argc) {
      arguments.golden = argv[++i];
    } else if (word.starts_with("--")) {
      return false;
    } else {
      arguments.meshes.push_back(word);
    }
  }
  for (const int count : arguments.threads)
    if (count < 1) return false;
#ifndef ETALON_HASH_MESH_FILES
  if (!arguments.meshes.empty()) return false;
#endif
  return !arguments.threads.empty();
}

std::vector<HashedWay> ways_of(const Arguments& arguments) {
  std::vector<HashedWay> ways;
  const auto append = [&](std::vector<HashedWay> more) { ways.insert(ways.end(), more.begin(), more.end()); };
#ifdef ETALON_HASH_MESH_FILES
  for (const std::string& path : arguments.meshes)
    append(simplify_ways(std::filesystem::path(path).stem().string(), welded_by_position(io::read_mesh(path).mesh)));
#endif
  if (!arguments.meshes.empty()) return ways;
  append(simplify_ways());
  append(adapt_ways());
  append(bake_ways());
  append(joint_ways());
  return ways;
}

std::map<std::string, std::string> read_golden(const std::string& path) {
  std::map<std::string, std::string> golden;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);)
    if (const std::size_t blank = line.find("  "); blank != std::string::npos) golden[line.substr(blank + 2)] = line.substr(0, blank);
  return golden;
}

// How many hashes are not what they should be.
int print_hashes(const Arguments& arguments) {
  std::map<std::string, std::string> golden = read_golden(arguments.golden);
  int differing = 0;
  for (const HashedWay& way : ways_of(arguments)) {
    std::string first;
    for (const int threads : arguments.threads) {
      set_thread_count(threads);
      const std::string hash = way.hash();
      if (first.empty()) {
        first = hash;
        std::printf("%s  %s\n", hash.c_str(), way.name.c_str());
      } else if (hash != first) {
        ++differing;
        std::printf("differs with %d threads: %s  %s\n", threads, hash.c_str(), way.name.c_str());
      }
    }
    if (!arguments.golden.empty()) {
      const auto wanted = golden.find(way.name);
      if (wanted == golden.end() || wanted->second != first) {
        ++differing;
        std::printf("expected %s  %s\n", wanted == golden.end() ? "nothing" : wanted->second.c_str(), way.name.c_str());
      }
      golden.erase(way.name);
    }
    std::fflush(stdout);
  }
  if (arguments.meshes.empty())
    for (const auto& [name, hash] : golden) {
      ++differing;
      std::printf("nobody makes %s  %s\n", hash.c_str(), name.c_str());
    }
  return differing;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  if (!parse(argc, argv, arguments)) {
    std::fprintf(stderr, "usage: etalon_hash_jobs [--threads N[,N...]] [--golden FILE] [MESH...]\n");
    return 64;
  }
  try {
    return print_hashes(arguments) > 0 ? 1 : 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "etalon_hash_jobs: %s\n", error.what());
    return 1;
  }
}
