// The surface distance beside MeshLab's Hausdorff filter (vcglib inside): both directions, as many samples, one thread.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/mesh/mesh.h"
#include "tests/bench/figure.h"

namespace etalon::bench {

inline constexpr const char* kMetroScene = "metro-knot100k";

/// One side's figures: of a to b and of b to a.
struct MetroSide {
  std::vector<double> seconds;  ///< by round, CPU: search structures and both directions; files are loaded outside
  std::array<double, 2> mean{}, rms{};
  std::array<std::uint64_t, 2> samples{};
};

struct MetroBenchResult {
  std::string skipped;  ///< why MeshLab was not run
  std::size_t faces_a = 0, faces_b = 0;
  MetroSide ours, meshlab;
  std::vector<Figure> figures;
};

/// MeshLab's time is that of a script that measures four times, less that of one that measures once, by three: what loading and starting take goes
/// out. Skipped where meshlabserver or xvfb-run is absent, or where it does not answer as version 2020.09 does.
[[nodiscard]] MetroBenchResult measure_metro(const Mesh& a, const Mesh& b, int rounds);

[[nodiscard]] nlohmann::ordered_json metro_document(const MetroBenchResult& result);
[[nodiscard]] std::string metro_tables(const nlohmann::ordered_json& document);

/// What MeshLab's log says of one direction. Nothing where it says none of it.
struct MeshlabAnswer {
  std::uint64_t samples = 0;
  double mean = 0, rms = 0;  ///< model units
};
[[nodiscard]] std::vector<MeshlabAnswer> meshlab_answers(const std::string& log);

}  // namespace etalon::bench
