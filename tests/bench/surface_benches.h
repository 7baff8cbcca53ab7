// The scenes of simplification, of the surface distance, of texture streams, of baking and of joint compression, as etalon_bench runs them beside the drawings.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/bench/bake_scenes.h"
#include "tests/bench/bench_options.h"
#include "tests/bench/joint_bench.h"
#include "tests/bench/metro_bench.h"
#include "tests/bench/simplify_bench.h"
#include "tests/bench/texture_bench.h"

namespace etalon::bench {

struct SurfaceResults {
  std::vector<SimplifySceneResult> simplifications;
  std::optional<MetroBenchResult> metro;
  std::vector<TextureSceneResult> textures;
  BakeScenes baking;
  JointScenes joint;
  std::size_t measured = 0;
  int skipped = 0;
};

/// Names and titles, in order.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> surface_scene_titles();

/// Those that the options ask for.
[[nodiscard]] SurfaceResults measure_surface_scenes(const BenchOptions& options, const MakePairRival& make_rival);

/// As document["simplification"], document["metro"], document["textures"], document["baking"] and document["joint"], where there are any.
void add_surface_results(const SurfaceResults& results, nlohmann::ordered_json& document);
/// Of such a document; empty where it has none.
[[nodiscard]] std::string surface_tables(const nlohmann::ordered_json& document);
[[nodiscard]] std::string stream_tables(const nlohmann::ordered_json& document);  ///< of textures
[[nodiscard]] std::string bake_block(const nlohmann::ordered_json& document);     ///< of baking
[[nodiscard]] std::string joint_block(const nlohmann::ordered_json& document);    ///< of joint compression
/// How simplification grows; where that was not measured, how baking does, or the quadtree.
[[nodiscard]] std::string surface_picture(const nlohmann::ordered_json& document);
/// The page with its measured block of surfaces, of textures, or of joint compression, replaced. InputError where it has none.
[[nodiscard]] std::string with_surface_tables(const std::string& page, const std::string& tables);
[[nodiscard]] std::string with_stream_tables(const std::string& page, const std::string& tables);
[[nodiscard]] std::string with_joint_tables(const std::string& page, const std::string& tables);

inline constexpr const char* kSurfaceBlockBegin = "<!-- measured surfaces: begin (etalon_bench --page) -->\n";
inline constexpr const char* kSurfaceBlockEnd = "<!-- measured surfaces: end -->\n";
inline constexpr const char* kStreamBlockBegin = "<!-- measured textures: begin (etalon_bench --page) -->\n";
inline constexpr const char* kStreamBlockEnd = "<!-- measured textures: end -->\n";

}  // namespace etalon::bench
