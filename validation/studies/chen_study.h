// The study of [Chen & Chuang 2006]: one texture for all levels of a progressive mesh, adapted collapse by collapse, against the same mesh
// without adaptation, the texture deviation metric, the exact limit of adaptation and a texture made anew for the level. Any textured meshes.
// Does not: read or write files, print.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/adapt/cell_statistics.h"
#include "core/mesh/mesh.h"
#include "validation/studies/chen_drawings.h"
#include "validation/studies/chen_examples.h"
#include "validation/studies/chen_formats.h"
#include "validation/studies/chen_packing.h"
#include "validation/studies/textured_view.h"
#include "validation/verify/verify_result.h"

namespace etalon::validation {

struct ChenTexture {
  std::string name;      ///< [a-z0-9-]: "colour", "normals", "checker"
  Image image;           ///< RGB or RGBA unorm8
  bool normals = false;  ///< in object space (normal_texture.h): compared as they are, shown lit
};

struct ChenSubject {
  std::string name;   ///< [a-z0-9_-]
  std::string title;  ///< "head, 7,685 faces"
  Mesh mesh;          ///< welded, with texture coordinates
  std::vector<ChenTexture> textures;
  std::vector<std::size_t> levels;       ///< faces, descending
  std::optional<std::size_t> paper_row;  ///< of chen_paper_rows()
  int paper_figure = 0;                  ///< that shows this subject; 0: none
  bool shows_parameterization = false;   ///< as Figures 14 and 15 do
  std::string view = "fit";              ///< of its pictures
  Vec3d light{0.3, 0.5, 1};              ///< toward it, for normals
  std::vector<VerifyInput> inputs;
};

/// What is drawn, each against the full mesh with its own texture.
enum class ChenMethod : std::uint8_t {
  qem5,      ///< the progressive mesh's level (5-D quadrics), the texture as it is
  aps,       ///< a mesh of as many faces by texture deviation, the texture as it is
  adapted,   ///< the level, its texture adapted collapse by collapse
  indexed,   ///< the level, the texture read through the adapted indexing map
  analytic,  ///< the same through the exact chain of cells
  rebaked,   ///< the level, its texture made anew from the full mesh by nearest points
};
inline constexpr std::array kChenMethods{ChenMethod::qem5,    ChenMethod::aps,      ChenMethod::adapted,
                                         ChenMethod::indexed, ChenMethod::analytic, ChenMethod::rebaked};
[[nodiscard]] const char* to_string(ChenMethod method);

struct ChenSubjectResult;

struct ChenStudyOptions {
  int map_size = 1024;                ///< of indexing maps and re-baked textures
  int views_px = 1024;                ///< side of the 24 views
  int view_count = 24;                ///< of the 24, the first so many: fewer for a quick look
  int picture_px = 512;               ///< side of pictures
  std::size_t device_singles = 1000;  ///< adaptations timed one by one on the device
  Renderer* device = nullptr;         ///< OpenGL, for the times of its passes; none: the exact rasterizer's only
  /// Called before each step; may be empty. An exception stops the study.
  std::function<void(const std::string& label, int done, int total)> progress;
  std::function<void(const ChenSubjectResult&)> on_subject;  ///< called after each subject; may be empty
};

/// One method on one texture at one level.
struct ChenOutcome {
  std::size_t texture = 0, level = 0;  ///< indices
  ChenMethod method = ChenMethod::qem5;
  std::size_t faces = 0;
  std::optional<double> masked_db, whole_db;  ///< all views; nothing where the pictures are the same
  double detail = 1;       ///< sum of squared differences of neighbouring texels, as a share of the full mesh's: below 1 blurred
  Image picture, closeup;  ///< RGB unorm8
};

/// The indexing map in one format, on the coarsest level.
struct ChenFormatOutcome {
  ChenFormat format;
  std::optional<double> masked_db;
  Image closeup;
};

struct ChenSubjectResult {
  std::string name, title, attribution;
  std::vector<std::string> textures;
  std::vector<std::size_t> levels;  ///< faces reached
  std::size_t faces = 0;
  int paper_figure = 0;
  std::optional<std::size_t> paper_row;
  std::vector<ChenOutcome> outcomes;
  std::vector<Image> originals, originals_close;  ///< one a texture
  Image parameterization;                         ///< edges over the first texture; empty for subjects of no figure that shows it
  std::vector<ChenFormatOutcome> formats;         ///< of one subject only: one with a checker, else the first
  std::size_t formats_texture = 0;
  std::vector<ChenInverse> inverses;  ///< of the same subject: down to its coarsest level and up again
  adapt::CellStatistics records;
  ChenPacking packing;
  std::optional<ChenCollapse> collapse;  ///< one to be drawn
  [[nodiscard]] const ChenOutcome& of(std::size_t texture, std::size_t level, ChenMethod method) const;
};

struct ChenStudyResult {
  std::vector<VerifyInput> inputs;
  std::vector<ChenSubjectResult> subjects;
  std::string exact_name, device_name;  ///< the latter empty where there is none
  int map_size = 0, views_px = 0, view_count = 0;
  std::optional<ChenSharing> sharing;  ///< of two subjects; nothing where the cells of all reach the map's edge
  ChenLineExample line;
  ChenPlaneExample plane;
};

/// InputError where a subject has no texture or texture coordinates, or levels that do not descend below its faces. Everything but the
/// seconds is the same bytes for any number of threads.
[[nodiscard]] ChenStudyResult run_chen_study(const std::vector<ChenSubject>& subjects, Renderer& exact, const ChenStudyOptions& options);

}  // namespace etalon::validation
