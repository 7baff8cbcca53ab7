// Every picture of a study drawn by the exact rasterizer and, where there is one, by a device too; their texels compared and counted.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/draw/renderer.h"
#include "validation/bounds.h"
#include "validation/studies/study_scene.h"
#include "validation/studies/vertex_color_view.h"
#include "validation/texel_diff.h"

namespace etalon::validation {

class CheckedDrawing {
 public:
  /// `device` may be null. All must outlive it.
  CheckedDrawing(Renderer& exact, Renderer* device, const DeviceModel& model) : exact_(exact), device_(device), model_(model) {}

  /// The exact picture, in the contract's own state. The device draws the scene in a state that it supports, beside the exact rasterizer in
  /// the same state; classes are added to those of `group`. `scene` makes the drawing for a state.
  DrawnView draw(const std::string& group, const std::function<StudyScene(const RasterState&)>& scene);

  struct Group {
    std::string name;
    std::uint64_t pictures = 0;
    ClassCounts counts;  ///< all 0 without a device
  };
  /// In order of first use.
  [[nodiscard]] const std::vector<Group>& groups() const { return groups_; }

 private:
  Group& group(const std::string& name);
  Renderer& exact_;
  Renderer* device_;
  const DeviceModel& model_;
  std::vector<Group> groups_;
};

}  // namespace etalon::validation
