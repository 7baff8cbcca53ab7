// A terrain seen from a view as a joint problem: its levels, and their errors on the screen.
#pragma once

#include <memory>
#include <vector>

#include "core/joint/joint_levels.h"
#include "validation/joint/screen_errors.h"

namespace etalon::validation {

[[nodiscard]] PictureFrame picture_frame(const terrain::TerrainView& view);

/// The field's mesh of all grid points: M_0.
[[nodiscard]] Mesh full_mesh(const terrain::HeightField& field);

/// Triangles of `mesh` of which at least one texel of the view shows a part.
[[nodiscard]] std::size_t visible_triangles(Renderer& renderer, const Mesh& mesh, const PictureFrame& frame);

class TerrainProblem {
 public:
  /// Makes the levels and the picture of the full pair: the field's own heights, the image as it is. InputError: make_joint_levels() or the scene
  /// refuses, or the view shows nothing of the terrain.
  TerrainProblem(Renderer& renderer, const terrain::HeightField& field, const Image& image, const terrain::TerrainView& view,
                 const joint::LevelOptions& options);

  /// As long as this object lives and stays where it is.
  [[nodiscard]] joint::Problem problem();

  [[nodiscard]] const joint::JointLevels& levels() const { return *levels_; }
  [[nodiscard]] Mesh mesh(std::size_t level) const { return terrain::level_mesh(levels_->field, levels_->levels, level); }
  [[nodiscard]] const std::vector<Image>& textures() const { return textures_; }  ///< RGB or grey, as decoded
  [[nodiscard]] const PictureFrame& frame() const { return frame_; }
  [[nodiscard]] ScreenErrors& errors() { return *errors_; }

 private:
  PictureFrame frame_;
  std::unique_ptr<joint::JointLevels> levels_;
  std::vector<Image> textures_;
  std::unique_ptr<ScreenErrors> errors_;
};

}  // namespace etalon::validation
