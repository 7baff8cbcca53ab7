// The experiments of [Soucy, Godin & Rioux 1996, sec. 5]: range images with test patterns, decimated to tolerances and baked into maps of two
// sizes, seen as their sensor saw them; coloured models at a thousand triangles, seen from around. Does not: read or write files.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/bake/bake.h"
#include "validation/studies/orthographic_view.h"
#include "validation/studies/textured_view.h"
#include "validation/verify/verify_result.h"

namespace etalon::validation {

/// A range image as a surface.
struct SoucyScan {
  std::string name;  ///< [a-z0-9_-]
  Mesh mesh;         ///< its samples, at the places that SampleGrid says; colours are not read
  SampleGrid grid;
  std::vector<double> tolerances;  ///< model units, ascending
  std::string unit;                ///< of the tolerances: "mm", or empty
  std::vector<VerifyInput> inputs;
};

/// A coloured model.
struct SoucyModel {
  std::string name;
  Mesh mesh;  ///< with vertex colours
  std::size_t target_faces = 1000;
  bool pictured = false;  ///< shown as in figures 11 and 12
  std::vector<VerifyInput> inputs;
};

enum class SoucyPattern : std::uint8_t { chessboard, ramp };
inline constexpr std::array kSoucyPatterns{SoucyPattern::chessboard, SoucyPattern::ramp};
[[nodiscard]] const char* to_string(SoucyPattern pattern);
/// The test images of section 5 (core/procedural/test_images.h).
[[nodiscard]] Image soucy_pattern(SoucyPattern pattern, int width, int height);

/// How much error pictures exaggerate: the ramp's errors of a few steps would not be seen.
[[nodiscard]] constexpr int error_gain(SoucyPattern pattern) { return pattern == SoucyPattern::chessboard ? 1 : 32; }

/// Sums over the texels that both the surface of the range image and the decimated one cover.
struct SoucyError {
  std::uint64_t texels = 0;
  std::uint64_t sse = 0;  ///< of the pattern's own channels: the chessboard's one grey, the ramp's red and green
  int channels = 0;       ///< so many
  /// Texels that touch a colour edge: one of the four neighbours in the pattern has another colour. Of the chessboard only.
  std::uint64_t edge_texels = 0, edge_sse = 0;
  /// How often texture minus pattern is −255..255, all channels.
  std::array<std::uint64_t, 511> histogram{};
  [[nodiscard]] double mse() const;
  [[nodiscard]] double mean_magnitude() const;
};
[[nodiscard]] SoucyError measure_pattern_error(const DrawnView& original, const DrawnView& baked, const Image& pattern, SoucyPattern which);

/// A range image decimated to one tolerance.
struct SoucyLevel {
  double tolerance = 0;
  std::size_t vertices = 0, faces = 0;
  double distance_max = 0;  ///< of an original vertex to the surface, audited
};

/// And baked with one pattern into one map.
struct SoucyMapping {
  std::size_t level = 0;
  SoucyPattern pattern = SoucyPattern::chessboard;
  int map_size = 0;
  bake::TexelCounts texels;
  int iterations = 0, seam_residual = 0;
  std::size_t reductions = 0;     ///< halvings of triangles for the map
  std::uint64_t wrong_means = 0;  ///< hit texels that are not the integer mean of their hits (wrong_mean_count)
  SoucyError error;
  Image picture, error_picture;  ///< RGB unorm8; |texture − pattern| times error_gain()
};

struct SoucyScanResult {
  std::string name, unit, attribution;
  std::size_t vertices = 0, faces = 0;
  SampleGrid grid;
  std::uint64_t off_pattern = 0;  ///< texels in which the undecimated surface does not show its sample's colour
  Image shaded;                   ///< the surface itself
  std::vector<SoucyLevel> levels;
  std::vector<SoucyMapping> mappings;  ///< by level, pattern, map size
  [[nodiscard]] const SoucyMapping& of(std::size_t level, SoucyPattern pattern, int map_size) const;
};

/// A model baked into one map, against the undecimated one in the 24 views.
struct SoucyModelMap {
  int map_size = 0;
  bake::TexelCounts texels;
  int smallest = 0, largest = 0;  ///< sizes of triangles
  int iterations = 0, seam_residual = 0;
  std::uint64_t wrong_means = 0;
  double flat_size = 0,
         bent_size = 0;  ///< mean size of the flattest and of the most bent quarter of the triangles, by their neighbours' normals
  PictureSums sums;
  std::uint64_t bytes = 0, png_bytes = 0;  ///< PLY with texture coordinates and PNG together; the PNG alone
  std::size_t equal_faces = 0;             ///< faces of the mesh with vertex colours, simplified alike, of as many bytes
  std::optional<PictureSums> equal_sums;   ///< of that mesh; none where the scan itself is smaller
};

struct SoucyModelResult {
  std::string name, attribution;
  std::size_t vertices = 0, faces = 0, baked_vertices = 0, baked_faces = 0;
  double diagonal = 0, distance_max = 0;
  std::uint64_t bytes = 0;        ///< of the model: 15 B a vertex, 13 B a face
  std::uint64_t plain_bytes = 0;  ///< of the decimated one with vertex colours
  PictureSums plain_sums;         ///< the decimated one in the colours of the vertices that are left
  std::vector<SoucyModelMap> maps;
  std::array<Image, 6> figure11;  ///< where pictured; RGB unorm8, in the paper's order a to f
  Image atlas;                    ///< figure 12
};

struct SoucyStudyOptions {
  std::array<int, 2> map_sizes{512, 256};  ///< of the range images: first the paper's
  std::vector<int> model_maps{512, 1024};  ///< of the models: first the paper's
  int views_px = 512, view_count = 24;
  int picture_px = 720;        ///< of figure 11, before it is cut to what is shown
  Renderer* device = nullptr;  ///< OpenGL; none: pictures are drawn by the exact rasterizer only
  DeviceModel device_model;
  std::function<void(const std::string& label, int done, int total)> progress;  ///< before each step; an exception stops the study
  std::function<void(const SoucyScanResult&)> on_scan;
  std::function<void(const SoucyModelResult&)> on_model;
};

struct SoucyStudyResult {
  std::vector<VerifyInput> inputs;
  std::vector<SoucyScanResult> scans;
  std::vector<SoucyModelResult> models;
  std::array<int, 2> map_sizes{};
  int views_px = 0, view_count = 0;
  std::string exact_name, device_name;  ///< the latter empty where there is none
  std::vector<CheckedDrawing::Group> drawings;
  [[nodiscard]] std::uint64_t unexplained() const;
};

/// Everything is the same bytes for any number of threads. InputError where a scan's tolerances are not above 0 and ascending, or a model has no
/// colours; what bake_scan() refuses, with the name in front.
[[nodiscard]] SoucyStudyResult run_soucy_study(const std::vector<SoucyScan>& scans, const std::vector<SoucyModel>& models, Renderer& exact,
                                               const SoucyStudyOptions& options);

/// Texels of the finished map that vertices of the scan fell into and that do not hold the integer mean of these, halves up, each channel on its own.
/// Recounted from landings and tiles. `scan`: what was baked, welded.
[[nodiscard]] std::uint64_t wrong_mean_count(const Mesh& scan, const bake::BakeResult& baked);

}  // namespace etalon::validation
