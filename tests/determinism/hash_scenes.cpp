// etalon_hash_scenes [--threads N[,N…]] [--simd all|LEVEL] [--evaluation all|NAME] [--families]: draws the fixed scenes of the self-test.
// Prints a line a drawing: EVALUATION LEVEL THREADS SHA256; with --families, instead, the text of data/golden/hash_scenes.sha256 as the
// first drawing gives it. By default all levels of the vectorised evaluation and the filtered one, with one thread; the wide integers of
// `exact` only when asked for.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <sstream>
#include <string>
#include <vector>

#include "raster/cpu_renderer.h"
#include "validation/selftest/drawing.h"
#include "validation/selftest/scene_hash.h"

using namespace etalon;
using raster::Evaluation;

namespace {

struct Arguments {
  std::vector<int> threads{1};
  std::string simd = "all";
  std::string evaluation;  // empty: vectorised and filtered
  bool families = false;
};

bool parse(int argc, char** argv, Arguments& arguments) {
  for (int i = 1; i < argc; ++i) {
    const std::string option = argv[i];
    if (option == "--families") {
      arguments.families = true;
    } else if (option == "--threads" && i + 1 < argc) {
      arguments.threads.clear();
      std::istringstream list(argv[++i]);
      for (std::string number; std::getline(list, number, ',');) arguments.threads.push_back(std::atoi(number.c_str()));
    } else if (option == "--simd" && i + 1 < argc) {
      arguments.simd = argv[++i];
    } else if (option == "--evaluation" && i + 1 < argc) {
      arguments.evaluation = argv[++i];
    } else {
      return false;
    }
  }
  const auto positive = [](int n) { return n > 0; };
  return !arguments.threads.empty() && std::all_of(arguments.threads.begin(), arguments.threads.end(), positive);
}

std::vector<validation::Drawing> drawings_of(const Arguments& arguments) {
  std::vector<validation::Drawing> drawings;
  const auto wants = [&](Evaluation evaluation) {
    return arguments.evaluation == "all" || arguments.evaluation == validation::to_string(evaluation) ||
           (arguments.evaluation.empty() && evaluation != Evaluation::exact);
  };
  for (const int threads : arguments.threads) {
    for (const Evaluation evaluation : {Evaluation::exact, Evaluation::filtered})
      if (wants(evaluation)) drawings.push_back({evaluation, {}, threads});
    for (const raster::SimdLevel level : raster::available_simd_levels())
      if (wants(Evaluation::vectorised) && (arguments.simd == "all" || arguments.simd == raster::to_string(level)))
        drawings.push_back({Evaluation::vectorised, level, threads});
  }
  return drawings;
}

validation::SceneHashes hashes_of(const std::vector<validation::SceneFamily>& families, const validation::Drawing& drawing) {
  validation::apply(drawing);
  raster::CpuRenderer renderer(drawing.evaluation);
  return validation::hash_scenes(families, renderer);
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  if (!parse(argc, argv, arguments)) {
    std::fprintf(stderr, "usage: etalon_hash_scenes [--threads N[,N...]] [--simd all|LEVEL] [--evaluation all|NAME] [--families]\n");
    return 64;
  }
  try {
    const std::vector<validation::Drawing> drawings = drawings_of(arguments);
    if (drawings.empty()) {
      std::fprintf(stderr, "etalon_hash_scenes: no such evaluation or level here\n");
      return 64;
    }
    const std::vector<validation::SceneFamily> families = validation::fixed_scenes();
    if (arguments.families) {
      std::fputs(validation::to_text(hashes_of(families, drawings.front())).c_str(), stdout);
      return 0;
    }
    for (const validation::Drawing& drawing : drawings) {
      std::printf("%s %s %d %s\n", validation::to_string(drawing.evaluation).c_str(), validation::level_name(drawing).c_str(),
                  drawing.threads, hashes_of(families, drawing).all.c_str());
      std::fflush(stdout);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "etalon_hash_scenes: %s\n", error.what());
    return 1;
  }
}
