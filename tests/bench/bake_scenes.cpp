#include "tests/bench/bake_scenes.h"

#include <algorithm>

#include "core/procedural/knot.h"

namespace etalon::bench {
namespace {

constexpr const char *kTime = "bake-time", *kQuality = "bake-quality", *kMeshlab = "bake-meshlab", *kGrowth = "bake-growth";
constexpr int kGrowthFaces[] = {20'000, 100'000, 283'000, 1'000'000, 2'360'000};
constexpr int kGrowthMaps[] = {256, 512, 1024, 2048, 4096};
constexpr int kGrowthRounds = 3;

void measure_growth(const BakeScan& head, BakeBenchResult& result) {
  for (const int faces : kGrowthFaces) {
    const Mesh knot = procedural::make_knot(procedural::knot_of_faces(faces));
    result.growth_faces.push_back(measure_bake_time("`make knot`", knot, 512, kGrowthRounds));
  }
  for (const int map : kGrowthMaps)
    if (head.mesh) result.growth_maps.push_back(measure_bake_time(head.title, *head.mesh, map, kGrowthRounds));
}

}  // namespace

std::vector<std::pair<std::string, std::string>> bake_scene_titles() {
  return {{kTime, "two scans to 1,000 triangles and a map of 512², beside simplification alone"},
          {kQuality, "the 24 views of what was baked, beside vertex colours"},
          {kMeshlab, "`etalon bake` beside MeshLab, whole processes"},
          {kGrowth, "baking `make knot` of 20,000 to 2,360,000 faces, and the head in maps of 256² to 4096² (--long)"}};
}

BakeScenes measure_bake_scenes(const BenchOptions& options, const std::string& program) {
  BakeScenes scenes;
  const bool time = wants(options, kTime), quality = wants(options, kQuality), meshlab = wants(options, kMeshlab),
             growth = wants(options, kGrowth) && options.long_scenes;
  if (!time && !quality && !meshlab && !growth) return scenes;
  const int rounds = std::min(options.repetitions, kFewestRounds);
  const std::vector<BakeScan> scans = bake_scans();
  for (const BakeScan& scan : scans) {
    if (!scan.mesh) {
      scenes.absent.push_back("bake-" + scan.name);
      continue;
    }
    if (time) scenes.result.times.push_back(measure_bake_time(scan.title, *scan.mesh, 512, rounds));
    if (quality) scenes.result.qualities.push_back(measure_bake_quality(scan));
    if (meshlab) scenes.result.rivals.push_back(measure_bake_rival(scan, program, rounds));
    ++scenes.measured;
  }
  if (growth) measure_growth(scans[0], scenes.result), ++scenes.measured;
  return scenes;
}

}  // namespace etalon::bench
