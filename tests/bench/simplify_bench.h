// Ours beside the rivals: time, memory and distance of the same simplification, each call in a process of its own, in turns.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/bench/figure.h"
#include "tests/bench/simplify_way.h"

namespace etalon::bench {

/// A simplification that several ways do alike.
struct SimplifyScene {
  std::string name, title;
  std::function<std::optional<Mesh>()> make;  ///< nothing where a real input is absent
  double ratio = 0.1;                         ///< of the faces, to keep
  std::vector<std::string> ways;
  int most_rounds = 15;
  bool is_long = false;  ///< only with --long
};
[[nodiscard]] std::vector<SimplifyScene> simplify_scenes();

/// What one way needed in one scene.
struct WayResult {
  std::string name, title;
  std::string skipped;  ///< why it was not run
  std::vector<double> seconds,
      peak_bytes;  ///< the peak is what came on top of the program itself: the input, the library's own mesh, its work
  std::size_t faces = 0;
  double rms = 0, mean = 0;  ///< the larger direction, as shares of the input's diagonal
  std::optional<double> colour_rms;
};

struct SimplifySceneResult {
  std::string name, title;
  std::size_t faces_in = 0, target_faces = 0;
  double metro_diagonal = 1;  ///< of the input, in diagonals of its bounding box: what Metro's own program calls 100 %
  std::vector<WayResult> ways;
  std::vector<Figure> figures;
  [[nodiscard]] const WayResult* way(const std::string& name) const;
};

/// How often, and how long, as for the drawings; `program` is this program, which runs one call when asked with kSimplifyChild.
struct SimplifyBenchOptions {
  std::string program;
  int rounds = 5;
  double seconds = 12;  ///< no further round of a scene is begun after that
};

/// Measures a scene and derives its figures.
[[nodiscard]] SimplifySceneResult measure_simplification(const SimplifyScene& scene, const Mesh& mesh, const SimplifyBenchOptions& options);

inline constexpr const char* kSimplifyChild = "--simplify-child";
/// What the program does in a process of its own: WAY INPUT FACES [OUTPUT]. Prints "seconds peak_bytes faces".
int simplify_child(const std::vector<std::string>& arguments);

}  // namespace etalon::bench
