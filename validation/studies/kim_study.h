// The study of [Kim, Choi & Lee 2008]: their metric against the colour quadric of Garland & Heckbert, on any coloured meshes: time, memory,
// distance of surfaces, difference of pictures; their tables and figures beside ours; how the result depends on the unit of length.
// Does not: read or write files, print.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/simplify/simplify.h"
#include "validation/studies/vertex_color_view.h"
#include "validation/verify/verify_result.h"

namespace etalon::validation {

/// A row of the paper's tables 1 to 3. Distances and image errors are without unit there: only ratios can be compared.
struct KimPaperRow {
  std::string model;
  std::uint64_t vertices = 0, faces = 0;
  double qem6_seconds = 0, kim_seconds = 0;
  double qem6_mean = 0, kim_mean = 0, qem6_rms = 0, kim_rms = 0;
  double qem6_image = 0, kim_image = 0;
};
/// Monkey, Wood Duck, GIST Ari (whose face count is misprinted: 2,351,302 is meant).
[[nodiscard]] const std::array<KimPaperRow, 3>& kim_paper_rows();

struct KimSubject {
  std::string name;                      ///< [a-z0-9_-]
  Mesh mesh;                             ///< welded, with vertex colours
  double reduction = 0.9;                ///< share of the vertices that goes
  std::optional<std::size_t> paper_row;  ///< of kim_paper_rows()
  std::vector<VerifyInput> inputs;
};

/// What is compared.
enum class KimMethod : std::uint8_t { qem6, qem6_full, kim, qem };
inline constexpr std::array kKimMethods{KimMethod::qem6, KimMethod::qem6_full, KimMethod::kim, KimMethod::qem};
[[nodiscard]] const char* to_string(KimMethod method);

struct KimSubjectResult;

struct KimStudyOptions {
  int picture_px = 1024;  ///< side of the one view
  int views_px = 512;     ///< side of the 24 views
  int view_count = 24;    ///< of the 24, the first so many: fewer for a quick look
  std::uint64_t metro_samples = 1'000'000;
  std::uint64_t sweep_samples = 200'000;
  std::size_t sweep_faces = 400'000;  ///< subjects of more faces are not swept
  int time_repeats = 3;               ///< the least time of so many runs; subjects of over a million faces are timed once
  Renderer* device = nullptr;         ///< OpenGL; none: pictures are drawn by the exact rasterizer only
  DeviceModel device_model;
  /// Called before each step; may be empty. An exception stops the study.
  std::function<void(const std::string& label, int done, int total)> progress;
  std::function<void(const KimSubjectResult&)> on_subject;  ///< called after each subject; may be empty
};

/// One method on one subject.
struct KimOutcome {
  KimMethod method = KimMethod::qem6;
  std::size_t vertices = 0, faces = 0;
  bool reached = true;                           ///< false: no legal collapse was left above the target
  double seconds = 0;                            ///< CPU time of the library call
  std::size_t state_bytes_per_vertex = 0;        ///< of the metric, measured
  double mean = 0, rms = 0, max = 0;             ///< Metro, the larger direction, in % of the diagonal
  double color_rms = 0;                          ///< of the colours at nearest points, 0..√3
  double image_rms = 0;                          ///< of the one view, in steps of 1/255
  double image_rms_views = 0;                    ///< mean over the 24 views
  double inside_rms = 0, outline_share = 0;      ///< of the one view, as in PictureError
  std::optional<double> device_image_rms;        ///< of the one view, both pictures drawn by the device
  std::optional<ClassCounts> device_classes;     ///< texels of the one view of the simplified mesh
  Image picture, closeup, error, closeup_error;  ///< RGB unorm8
};

/// One point of the sweep: `kim` with another unit of length.
struct KimSweepPoint {
  double unit_of_diagonal = 0;
  double mean = 0, rms = 0, image_rms = 0;  ///< as in KimOutcome
};

struct KimSubjectResult {
  std::string name;
  std::string attribution;  ///< who must be named with its pictures; empty where nobody
  double reduction = 0;
  std::optional<std::size_t> paper_row;
  std::size_t vertices = 0, faces = 0, target_vertices = 0;
  double diagonal = 0;
  std::vector<KimOutcome> outcomes;  ///< in the order of kKimMethods
  std::vector<KimSweepPoint> sweep;  ///< empty where it was left out
  Image picture, closeup;
  std::optional<ClassCounts> device_classes;  ///< of the original
  [[nodiscard]] const KimOutcome& of(KimMethod method) const;
};

struct KimStudyResult {
  std::vector<VerifyInput> inputs;
  std::vector<KimSubjectResult> subjects;
  std::string exact_name, device_name;  ///< the latter empty where there is none
  int picture_px = 0, views_px = 0, view_count = 0;
  std::uint64_t metro_samples = 0, sweep_samples = 0;
  [[nodiscard]] std::uint64_t unexplained() const;  ///< texels of both renderers that no class explains
};

/// InputError where a subject has no colours, or a reduction is not in (0, 1). Everything but the seconds is the same bytes for any number of
/// threads.
[[nodiscard]] KimStudyResult run_kim_study(const std::vector<KimSubject>& subjects, Renderer& exact, const KimStudyOptions& options);

/// The face count at which a simplification with `options` has `vertices` vertices left: simplification stops by faces, the paper counts
/// vertices. Open meshes are collapsed twice for it. What is left where it cannot be reached is the least there is.
[[nodiscard]] std::size_t faces_for_vertices(const Mesh& mesh, const simplify::SimplifyOptions& options, std::size_t vertices);

}  // namespace etalon::validation
