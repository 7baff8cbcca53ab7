// Figures 1 to 8 of [Soucy, Godin & Rioux 1996], drawn from what core/bake and the exact rasterizer compute; histograms of errors. SVG.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/bake/surface_fill.h"
#include "validation/studies/soucy_study.h"

namespace etalon::validation {

/// Figure 1: the pixels of a triangle, and where one of them is looked up.
[[nodiscard]] std::string lookup_drawing(Renderer& exact);
/// Figure 2: two triangles of sizes 4 and 2 with a common edge; texels that continuity makes one have one colour.
[[nodiscard]] std::string adjacent_drawing();
/// Figure 3: a triangle of size 4 of a decimated model, the vertices that fell on it, the texels that stayed empty.
[[nodiscard]] std::string projection_drawing();
/// Figure 4: rectangles of two triangles.
[[nodiscard]] std::string pairing_drawing();
/// Figure 5: a tiled map; numbers are the order in which rectangles are placed.
[[nodiscard]] std::string tiling_drawing();
/// The example of section 3: which triangle goes to a lower class at which step.
[[nodiscard]] std::string reclassification_drawing();

/// Two triangles with a common edge and a few hit texels: how the fill stands after its stages.
struct FillExample {
  Mesh mesh;
  bake::Atlas atlas;
  std::vector<std::uint32_t> hits;        ///< texels
  std::vector<bake::SurfaceFill> stages;  ///< transformed, propagated, transformed, …
  /// The paper's t1 to t6: t3 and t5 on the edge find t2 and t1 over it; t4 of the second triangle leaves t6 for t2, by way of t3.
  std::array<std::uint32_t, 6> named{};
};
[[nodiscard]] FillExample fill_example();
/// Figures 6 to 8.
[[nodiscard]] std::string fill_drawing(const FillExample& example);

/// One histogram: how many texels (on a scale of decibels) are off by how much, −255 to 255.
[[nodiscard]] std::string histogram_drawing(const SoucyError& error, const std::string& label);
/// Several side by side, `columns` in a row.
struct NamedError {
  std::string name;
  const SoucyError* error = nullptr;
};
[[nodiscard]] std::string histograms_drawing(const std::vector<NamedError>& errors, int columns, const std::string& label);

}  // namespace etalon::validation
