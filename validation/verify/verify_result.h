// What a verification found: the same scenes drawn by the exact rasterizer and by a device, every texel put in a class.
// Plain data, light enough to keep (pictures are bounded); report/ turns it into JSON and into a page.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/draw/state.h"
#include "core/image/image.h"
#include "validation/metrics/image_difference.h"

namespace etalon::validation {

/// Texels of frames by class (texel_explainer.h says what each means); a texel's class is the worst of its targets'. They add up to `texels`.
struct ClassTally {
  std::uint64_t texels = 0;
  std::uint64_t identical = 0;
  std::uint64_t rounding = 0;
  std::uint64_t tie = 0;
  std::uint64_t unbounded = 0;
  std::uint64_t unexplained = 0;
  ClassTally& operator+=(const ClassTally& other);
  friend bool operator==(const ClassTally&, const ClassTally&) = default;
};

/// A file or an embedded model the result depends on.
struct VerifyInput {
  std::string name;         ///< base name, or "head (embedded)"
  std::string sha256;       ///< of the file's bytes; of mesh and texture for embedded models
  std::string path;         ///< as given; empty for embedded models
  std::string role;         ///< "model", "texture", "view"
  std::string attribution;  ///< who must be named; empty where nobody
};

/// One of the texels that need explaining most, with its surroundings on both sides.
struct WorstTexel {
  int x = 0, y = 0;         ///< texel, row 0 at the bottom
  std::string texel_class;  ///< "rounding", "tie", …
  std::string cpu_value;    ///< stored channels, printed
  std::string gl_value;
  std::string explanation;  ///< margin, bound and verdict in one sentence
  Image cpu_crop, gl_crop;  ///< RGB unorm8, kCropSize squared, centred on the texel (outside the frame: mid grey)
};
inline constexpr int kCropSize = 17;

/// One target of one scene.
struct TargetResult {
  std::string content;                        ///< "color", "triangle_id", "depth"
  std::string format;                         ///< "rgba unorm8"
  std::optional<ImageDifference> difference;  ///< nothing where there is no device
  std::string cpu_sha256, gl_sha256;          ///< the latter empty where there is no device
  /// RGB unorm8 for people, row 0 at the bottom, at most VerifyOptions::picture_px on a side (then the frame is reduced by whole steps).
  /// gl_picture is empty where both are the same bytes, or there is no device.
  Image cpu_picture, gl_picture;
  Image error_picture;  ///< empty where nothing differs; brightness: log2 of the difference
};

/// What a page calls the two sides.
struct SideNames {
  std::string exact = "CPU, exact", device = "OpenGL";
  std::string exact_long = "the exact rasterizer", device_long = "OpenGL";
  std::string exact_short = "CPU", device_short = "GL";
};

/// A usual mistake, and the share of the unexplained texels that it explains.
struct NamedCause {
  std::string name;  ///< "filter linear"
  double share = 0;  ///< 0..1
};

/// One scene: a model seen from one view with one sampler.
struct CaseResult {
  SideNames sides;
  std::string job;          ///< of verify_jobs()
  std::string model;        ///< "head"
  std::string view;         ///< "fit"
  std::string sampling;     ///< "nearest", "linear"
  std::string description;  ///< one sentence for the page
  int width = 0, height = 0;
  std::uint64_t triangles = 0;  ///< in the draw list, after clipping
  std::uint64_t covered = 0;    ///< texels that show a triangle on the exact side
  std::string skipped;          ///< why the device could not draw it; empty where it could; else nothing of it was compared
  double cpu_seconds = 0, gl_seconds = 0, compare_seconds = 0;
  ClassTally tally;                ///< all 0 where there is no device
  std::string diagnosis;           ///< what pattern the unexplained texels show; empty where there are none
  std::vector<NamedCause> causes;  ///< the best first
  std::vector<WorstTexel> worst;   ///< worst first
  Image class_picture;             ///< the CPU's colours in faint grey, marks of class_color() over them; empty where there is no device
  std::vector<TargetResult> targets;
  [[nodiscard]] std::string name() const { return model + ", " + view + ", " + sampling; }
};

struct JobResult {
  std::string job;
  std::string skipped;  ///< why it was not done, and what to try; empty where it was
  std::vector<CaseResult> cases;
  [[nodiscard]] ClassTally tally() const;
};

struct VerifyResult {
  std::vector<VerifyInput> inputs;
  std::vector<JobResult> jobs;
  std::string cpu_name;
  std::string gl_name;               ///< empty where there is no device
  std::string gl_unavailable;        ///< why; empty where there is one
  std::string bounds_origin;         ///< "derived: …" or "measured: …"
  bool bounds_measured = false;      ///< then agreement is not called proven
  RasterState state;                 ///< drawn with; of what was wanted that which the device supports
  std::vector<std::string> notes;    ///< about the inputs: "head: 12 faces without area"
  std::vector<std::string> caveats;  ///< what was asked for and done otherwise or shows nothing: "no triangle covers a texel"
  [[nodiscard]] ClassTally total() const;
  [[nodiscard]] std::uint64_t covered() const;      ///< texels that show a triangle, of all scenes
  [[nodiscard]] std::size_t skipped_cases() const;  ///< scenes that the device could not draw
};

enum class Verdict : std::uint8_t { agreed, not_compared, failed };

/// failed: an unexplained texel; not_compared: no texel was, or none that shows a triangle, or a scene was skipped; else agreed
/// (VerifyResult::bounds_measured says whether that is proof).
[[nodiscard]] Verdict verdict(const VerifyResult& result);
[[nodiscard]] std::string to_string(Verdict value);

}  // namespace etalon::validation
