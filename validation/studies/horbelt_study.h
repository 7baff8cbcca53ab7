// The study of [Horbelt, Balmelli & Vetterli]: marginal analysis against the exhaustive search of all pairs of a terrain's meshes and textures,
// from several views. Does not: read or write files, print.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/joint/joint_levels.h"
#include "core/joint/marginal_analysis.h"
#include "validation/bounds.h"
#include "validation/joint/path_gaps.h"
#include "validation/joint/terrain_views.h"
#include "validation/studies/horbelt_flight.h"
#include "validation/texel_diff.h"
#include "validation/verify/verify_result.h"

namespace etalon::validation {

struct HorbeltSubject {
  std::string name;   ///< [a-z0-9_-]
  std::string title;  ///< "davosdorf, 257² heights, 512² texels"
  terrain::HeightField field;
  Image image;  ///< RGB unorm8
  std::vector<VerifyInput> inputs;
  std::vector<std::string> notes, warnings;  ///< what was done to the files, and what to doubt: for the report
  std::vector<NamedTerrainView> views;       ///< names differ; empty: those of terrain_views()
  std::string joint_command;                 ///< that looks at the same terrain: "etalon joint dem.tif photo.png --grid 257"
};

enum class HorbeltMethod : std::uint8_t {
  slope,          ///< marginal analysis, pruning: error per bit
  printed,        ///< the loop as printed: error alone
  budget,         ///< B bits of either, or B/2 of both
  grow_slope,     ///< slope, growing
  grow_printed,   ///< printed, growing
  texture_first,  ///< the whole texture goes before the mesh
  mesh_first,     ///< the whole mesh goes before the texture
  independent,    ///< each judged beside the other at its finest
};
inline constexpr std::array kHorbeltMethods{HorbeltMethod::slope,      HorbeltMethod::printed,      HorbeltMethod::budget,
                                            HorbeltMethod::grow_slope, HorbeltMethod::grow_printed, HorbeltMethod::texture_first,
                                            HorbeltMethod::mesh_first, HorbeltMethod::independent};
[[nodiscard]] const char* to_string(HorbeltMethod method);

struct HorbeltViewResult;

struct HorbeltStudyOptions {
  int width = 640, height = 480;
  std::size_t view_count = 5;  ///< of terrain_views(), the first so many; a subject's own views are all taken
  joint::LevelOptions levels;
  Renderer* device = nullptr;  ///< OpenGL: draws what the exact renderer drew on the path of slope, for the first checked_views views
  std::optional<DeviceModel> device_model;
  std::size_t checked_views = 5;
  std::size_t checked_subject = 0;  ///< index
  std::size_t flight_frames = 12;   ///< of a flight over each terrain, in frames of half the size; 0: none
  /// Called before each step; may be empty. An exception stops the study.
  std::function<void(const std::string& label, int done, int total)> progress;
  std::function<void(const std::string& subject, const HorbeltViewResult&)> on_view;  ///< called after each view; may be empty
};

struct HorbeltOutcome {
  HorbeltMethod method;
  joint::Path path;  ///< with the errors of all its points
  PathGaps gaps;
};

/// Three pairs of nearly the same bits (Figure 6): (a) the finest texture, (b) the least error, (c) the finest mesh.
struct HorbeltTrade {
  joint::Pair pair;
  std::uint64_t bits = 0;
  std::optional<double> psnr_db;
  double mesh_share = 0;     ///< of its error that stands when the texture is the finest: D(M_i, T_M) / D(M_i, T_j)
  double texture_share = 0;  ///< D(M_N, T_j) / D(M_i, T_j)
  Image picture;
};

/// A level of the pyramid of section 2.2 (Figure 3): what of the texture is resolvable from so many times the view's own distance.
struct HorbeltDistance {
  double distance = 1;  ///< d_i / d_0 = 2^(i/k)
  std::size_t significant = 0;
  std::uint64_t bits = 0;
  Image map;  ///< from above, with viewer and frustum
};

struct HorbeltViewResult {
  NamedTerrainView view;
  std::size_t faces = 0, visible_faces = 0;  ///< of the full mesh
  std::vector<std::uint64_t> mesh_bits, texture_bits;
  std::vector<std::uint32_t> vertices;
  std::vector<std::size_t> significant;
  std::size_t significant_total = 0;
  std::uint64_t samples = 0;  ///< of a picture
  joint::AllPairs all;
  std::vector<joint::Staircase::Stair> stairs;
  std::vector<HorbeltOutcome> outcomes;
  std::vector<HorbeltTrade> trades;
  Image full, finest;                               ///< pictures: of the full pair, and of the finest levels
  Image mesh_map, texture_map;                      ///< from above, with viewer and frustum (Figure 2)
  std::size_t mapped_mesh = 0, mapped_texture = 0;  ///< the levels that they show
  std::size_t mapped_faces = 0;                     ///< of that mesh: about 8,000, or all that the finest has
  std::vector<HorbeltDistance> distances;           ///< T_0, one of the middle, T_M
  double level_seconds = 0, search_seconds = 0, exhaustive_seconds = 0;
  ClassCounts checked;  ///< texels of the frames drawn on both renderers
  std::size_t checked_frames = 0;
  [[nodiscard]] const HorbeltOutcome& of(HorbeltMethod method) const;
  [[nodiscard]] std::optional<double> psnr_db(joint::Pair pair) const;
};

struct HorbeltSubjectResult {
  std::string name, title, joint_command;
  std::vector<std::string> notes, warnings;
  bool has_own_views = false;  ///< not those of terrain_views()
  std::vector<HorbeltViewResult> views;
  std::uint64_t flight_budget_bits = 0;  ///< those of the first view's pair (b) of Figure 6
  std::vector<FlightFrame> flight;
};

struct HorbeltStudyResult {
  std::vector<VerifyInput> inputs;
  std::vector<HorbeltSubjectResult> subjects;
  std::string exact_name, device_name;  ///< the latter empty where there is none
  [[nodiscard]] std::uint64_t unexplained() const;
};

/// Everything but the seconds is the same bytes for any number of threads. InputError "SUBJECT, VIEW: …" as TerrainProblem.
[[nodiscard]] HorbeltStudyResult run_horbelt_study(const std::vector<HorbeltSubject>& subjects, Renderer& exact,
                                                   const HorbeltStudyOptions& options);

}  // namespace etalon::validation
