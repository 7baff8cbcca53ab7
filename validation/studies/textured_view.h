// Textured meshes drawn unlit, and how far two such drawings are apart: over the texels in which both show a surface, and over all.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "core/draw/camera.h"
#include "core/draw/renderer.h"
#include "validation/studies/vertex_color_view.h"

namespace etalon::validation {

/// A mesh with its one texture, looked up by one filter (clamped): at its own coordinates, or at those that an indexing map holds.
struct TexturedMesh {
  const Mesh* mesh = nullptr;
  std::shared_ptr<const Image> texture;
  std::shared_ptr<const Image> map;  ///< none: the texture itself
  Filter filter = Filter::linear;    ///< of texture and map
};

/// RGBA unorm8 on black, and ids, in a state. InputError as make_scene().
[[nodiscard]] StudyScene textured_scene(const TexturedMesh& what, const Camera& camera, int width, int height, const RasterState& state);

/// The same drawn, in the renderer's own state.
[[nodiscard]] DrawnView draw_textured(Renderer& renderer, const TexturedMesh& what, const Camera& camera, int width, int height);

/// Sums of squared RGB differences, exact, of any number of picture pairs.
struct PictureSums {
  std::uint64_t texels = 0, sse = 0;                ///< all
  std::uint64_t common_texels = 0, common_sse = 0;  ///< both pictures show the surface
  std::uint64_t detail_a = 0, detail_b = 0;         ///< squared RGB differences of texels side by side, where both show it
  void add(const DrawnView& a, const DrawnView& b);
  /// dB over all pictures (peak 255); nothing where they are the same.
  [[nodiscard]] std::optional<double> whole_db() const;
  [[nodiscard]] std::optional<double> masked_db() const;
};

/// The picture for people: RGB, `factor` × `factor` texels averaged (sides must be divisible by it).
[[nodiscard]] Image averaged_down(const Image& picture, int factor);

/// The same with grey instead of the empty background (RGB unorm8; `id` of the same size).
[[nodiscard]] Image on_paper(const DrawnView& view);

}  // namespace etalon::validation
