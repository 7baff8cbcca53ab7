// Joint compression: the searches of one view beside the same pairs drawn and read back by a device, and how building the quadtree grows.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/terrain/height_field.h"
#include "tests/bench/bench_options.h"
#include "tests/bench/figure.h"
#include "validation/joint/terrain_problem.h"

namespace etalon::bench {

/// Draws pairs of a terrain's levels: texture by linear lookup, depth-tested, into a picture of bytes.
class PairRival {
 public:
  virtual ~PairRival() = default;
  /// `picture`: RGBA unorm8 of the view's size, overwritten.
  virtual void draw_and_read_back(joint::Pair pair, Image& picture) = 0;
};
/// Empty: there is no device.
using MakePairRival = std::function<std::unique_ptr<PairRival>(const validation::TerrainProblem&)>;

struct JointTerrain {
  terrain::HeightField field;
  Image image;
};
struct JointScene {
  std::string name, title;
  std::function<std::optional<JointTerrain>()> make;  ///< nothing where a real input is absent
};
[[nodiscard]] std::vector<JointScene> joint_scenes();

inline constexpr std::size_t kRivalStep = 7;  ///< the rival draws each seventh pair, mesh by mesh: its time is taken as that share of all
/// Largest difference of a channel from ours up to which a device's texel counts as the same: its filter has 8 bits, and coordinates err.
inline constexpr int kSameByte = 2;

struct JointBenchResult {
  std::string name, title, skipped;  ///< why there is no rival
  std::size_t meshes = 0, textures = 0, evaluations = 0, rival_pairs = 0;
  double level_seconds = 0;
  std::vector<double> marginal, exhaustive;            ///< wall seconds, by round; the levels exist, nothing is drawn yet
  std::vector<double> rival_pair;                      ///< of one pair, by round
  std::vector<double> exhaustive_cpu, rival_pair_cpu;  ///< the same in CPU seconds of all threads: what other programs take matters less
  std::size_t compared = 0, equal = 0;                 ///< pairs whose picture and error were compared with a full rendering
  double differing = 0;                                ///< share of the rival's texels that differ from ours by more than kSameByte
  [[nodiscard]] std::size_t pairs() const { return meshes * textures; }
};
[[nodiscard]] JointBenchResult measure_joint(const JointScene& scene, const JointTerrain& terrain, const MakePairRival& make_rival,
                                             int rounds, const joint::LevelOptions& levels = {}, int width = 640, int height = 480);

/// removal_order() of procedural heights, in a process of its own.
struct QuadtreeCost {
  int side = 0;
  double order_seconds = 0;  ///< CPU, one thread
  double peak_bytes = 0;     ///< of the whole process, heights included
};
inline constexpr const char* kQuadtreeChild = "--quadtree-child";
/// Prints the costs of arguments[0] points on a side.
int quadtree_child(const std::vector<std::string>& arguments);
/// `program` called as that child. UnavailableError where it fails.
[[nodiscard]] QuadtreeCost measure_quadtree(const std::string& program, int side);

struct JointScenes {
  std::vector<JointBenchResult> joint;
  std::vector<QuadtreeCost> quadtrees;
  std::vector<std::string> absent;
  [[nodiscard]] std::size_t measured() const { return joint.size() + (quadtrees.empty() ? 0 : 1); }
};
[[nodiscard]] std::vector<std::pair<std::string, std::string>> joint_scene_titles();
/// Those that the options ask for; quadtrees of 2049 and 4097 points on a side with --long.
[[nodiscard]] JointScenes measure_joint_scenes(const BenchOptions& options, const std::string& program, const MakePairRival& make_rival);

[[nodiscard]] std::vector<Figure> joint_figures(const JointScenes& scenes);
[[nodiscard]] nlohmann::ordered_json joint_document(const JointScenes& scenes);
[[nodiscard]] std::string joint_tables(const nlohmann::ordered_json& document);
/// Time and memory of the quadtrees beside n·log n; empty where fewer than two were measured.
[[nodiscard]] std::string quadtree_picture(const nlohmann::ordered_json& document);

inline constexpr const char* kJointBlockBegin = "<!-- measured joint: begin (etalon_bench --page) -->\n";
inline constexpr const char* kJointBlockEnd = "<!-- measured joint: end -->\n";

}  // namespace etalon::bench
