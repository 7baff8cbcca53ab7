// Baking beside what it is built on and beside its rival: how long, how that grows, and how well its results look.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/mesh/mesh.h"
#include "tests/bench/figure.h"
#include "validation/studies/textured_view.h"

namespace etalon::bench {

inline constexpr std::size_t kBakedFaces = 1000;
inline constexpr int kBakeViews_px = 512;  ///< side of the 24 views

/// A scan that is baked; nothing where the real input is absent.
struct BakeScan {
  std::string name, title;
  std::optional<Mesh> mesh;
};
/// The head of 282,944 faces and the milk carton.
[[nodiscard]] std::vector<BakeScan> bake_scans();

/// bake_scan() beside simplify_mesh() to the same count by the same metric, in turns, CPU seconds on one thread.
struct BakeTime {
  std::string title;
  std::size_t faces_in = 0, vertices_in = 0;
  int map = 512;                             ///< texels on a side
  std::vector<double> bake, simplify;        ///< by round
  [[nodiscard]] double own_seconds() const;  ///< the median of what baking took on top, by round; at least 0
};
[[nodiscard]] BakeTime measure_bake_time(const std::string& title, const Mesh& scan, int map, int rounds);

/// The 24 views of a model against the dense one's.
struct ViewQuality {
  std::string title;
  std::size_t faces = 0;
  std::uint64_t bytes = 0;           ///< of its files, binary PLY and PNG; 0: not asked
  double frame_db = 0, both_db = 0;  ///< whole frames; the texels where both show the surface
  double outline_share = 0;          ///< of the frames' squared error, what lies where only one of both shows it
};
struct BakeQuality {
  std::string title;
  std::vector<ViewQuality> rows;  ///< the first: vertex colours on the same triangles; the second and third: baked, 512² and 1024²
  struct Shares {
    int map = 0;
    double hit = 0, averaged = 0, filled = 0;  ///< of the texels in triangles
  };
  std::vector<Shares> shares;
};

/// The dense model's 24 views, drawn once.
class DenseViews {
 public:
  explicit DenseViews(const Mesh& scan);
  /// `texture`: looked up by `filter`; none: vertex colours.
  [[nodiscard]] ViewQuality compare(const std::string& title, const Mesh& mesh, const std::shared_ptr<const Image>& texture,
                                    Filter filter = Filter::nearest) const;

 private:
  BoundingBox box_;
  std::vector<validation::DrawnView> views_;
};
[[nodiscard]] BakeQuality measure_bake_quality(const BakeScan& scan);

/// `etalon bake` and MeshLab's script (trivial parametrisation per triangle, transfer of vertex attributes to a texture) as whole processes.
struct BakeRivalResult {
  std::string title, skipped;                                        ///< skipped: why MeshLab was not run
  std::vector<double> our_wall, our_cpu, meshlab_wall, meshlab_cpu;  ///< seconds, by round
  std::vector<double> sampled_wall, sampled_cpu;                     ///< ours with --fill sampled
  std::vector<ViewQuality> rows;                                     ///< ours; MeshLab's, nearest and linear; ours with --fill sampled
};
/// `program`: etalon. MeshLab gets the mesh that ours has simplified: that it need not do.
[[nodiscard]] BakeRivalResult measure_bake_rival(const BakeScan& scan, const std::string& program, int rounds);

struct BakeBenchResult {
  std::vector<BakeTime> times, growth_faces, growth_maps;
  std::vector<BakeQuality> qualities;
  std::vector<BakeRivalResult> rivals;
};
[[nodiscard]] std::vector<Figure> bake_figures(const BakeBenchResult& result);
[[nodiscard]] nlohmann::ordered_json bake_document(const BakeBenchResult& result);
/// Of such a document.
[[nodiscard]] std::string bake_tables(const nlohmann::ordered_json& document);
/// SVG; empty where the growth was not measured.
[[nodiscard]] std::string bake_growth_picture(const nlohmann::ordered_json& document);

inline constexpr const char* kBakeBlockBegin = "<!-- measured baking: begin (etalon_bench --page) -->\n";
inline constexpr const char* kBakeBlockEnd = "<!-- measured baking: end -->\n";
/// The page with its third measured block replaced. InputError where it has none.
[[nodiscard]] std::string with_bake_tables(const std::string& page, const std::string& tables);

}  // namespace etalon::bench
