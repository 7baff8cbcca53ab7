// Drawings of the study: figures 3 and 4 of the paper from what core/simplify computes, the sweep over units as curves.
#pragma once

#include <string>
#include <vector>

#include "validation/studies/kim_study.h"

namespace etalon::validation {

/// A flat fan of six triangles around vertex 0 at the origin; colours by vertex.
[[nodiscard]] Mesh color_fan(const std::vector<Vec4f>& colors);
/// I(v0) of equation 14, as the metric `kim` computes it.
[[nodiscard]] double visual_importance(const Mesh& mesh, std::uint32_t vertex);

/// A flat patch of triangles, and the half-edge collapse v0 → v1 in its middle.
struct CollapsePatch {
  Mesh mesh;  ///< with colours
  std::uint32_t v0 = 0, v1 = 0;
  std::vector<bool> changed;                        ///< #F: faces that vanish or get another corner
  std::vector<std::array<std::uint32_t, 3>> after;  ///< vertices of the faces that remain, in the order of the input's
  std::vector<std::uint32_t> source;                ///< of each of those, its face before
};
[[nodiscard]] CollapsePatch collapse_patch();

/// SVG elements, no outside resources.
[[nodiscard]] std::string importance_drawing();
[[nodiscard]] std::string collapse_drawing();

/// For each subject with a sweep three curves over the unit: Metro mean, Metro RMS and image RMS of `kim`, each divided by that of half-edge
/// `qem6`; the default unit is marked.
[[nodiscard]] std::string sweep_drawing(const std::vector<KimSubjectResult>& subjects);

/// kim/qem6 of Metro mean, RMS, image RMS and time as dots on one scale: ours against both kinds of collapse, and the paper's.
[[nodiscard]] std::string ratio_drawing(const std::vector<KimSubjectResult>& subjects);

}  // namespace etalon::validation
