// A mesh drawn once into texture coordinates, through which any number of textures are looked up: the pictures of all pairs of one mesh for the
// price of one drawing.
//
// What a picture is here: first the mesh is drawn into its coordinates, stored as float32, rounded once (docs/contract.md#targets); then each covered texel
// looks the texture up at its stored coordinate, linearly, clamped, the value rounded once to unorm8 (docs/contract.md#values, indexed lookup);
// uncovered texels are black. draw_in_two_passes() has a renderer do both; CoordinatePicture does the second itself, in integers: the same bytes.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/draw/camera.h"
#include "core/draw/renderer.h"

namespace etalon::validation {

/// Frame of the pictures: the view's size, the renderer's own state.
struct PictureFrame {
  Camera camera;
  int width = 640, height = 480;
};

/// What a mesh covers and at which coordinates.
struct DrawnCoordinates {
  Image coordinates;  ///< RG float32
  Image ids;          ///< R uint32: triangle of the draw list, kNoTriangle where nothing is seen
};

/// The mesh of one wedge a vertex, drawn into its own coordinates. Errors of make_scene() and Renderer::render().
[[nodiscard]] DrawnCoordinates draw_coordinates(Renderer& renderer, const Mesh& mesh, const PictureFrame& frame);

/// The list and frame of the second pass: a rectangle over the whole frame, `texture` looked up at what `coordinates` holds.
struct LookupPass {
  DrawList list;
  Frame frame;
};
[[nodiscard]] LookupPass lookup_pass(const Renderer& renderer, std::shared_ptr<const Image> texture,
                                     std::shared_ptr<const Image> coordinates);

/// RGB or RGBA unorm8 in, RGBA unorm8 out (alpha 255 where covered, else 0): both passes by the renderer.
[[nodiscard]] Image draw_in_two_passes(Renderer& renderer, const Mesh& mesh, std::shared_ptr<const Image> texture,
                                       const PictureFrame& frame);

class CoordinatePicture {
 public:
  /// For textures of this size, at least 2 × 2 (InputError).
  CoordinatePicture(const DrawnCoordinates& drawn, int texture_width, int texture_height);

  /// The picture of a texture (RGBA unorm8, opaque, of that size).
  [[nodiscard]] Image picture(const Image& texture) const;

  /// Sum of squared RGB differences between the picture of `texture` and `reference` (RGBA unorm8, the frame's size), over the whole frame.
  [[nodiscard]] std::uint64_t sse(const Image& texture, const Image& reference) const;

  [[nodiscard]] std::size_t covered_texels() const { return lookups_.size(); }

 private:
  // Texel (i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1) with weights (1 − fx)(1 − fy) …, fx and fy in multiples of 2^-24.
  struct Lookup {
    std::uint32_t at;      ///< in the frame
    std::uint32_t texel;   ///< (i, j) in the texture
    std::uint32_t fx, fy;  ///< 0..2^24; the highest bit: rounded
  };
  template <class Body>
  void for_each_color(const Image& texture, std::size_t begin, std::size_t end, const Body& body) const;
  void require_texture(const Image& texture) const;

  Image coordinates_;
  int texture_width_, texture_height_;
  std::vector<Lookup> lookups_;
  std::vector<std::uint32_t> uncovered_;
};

/// RGBA unorm8, opaque. InputError for other formats than RGB and RGBA unorm8 (1 channel: grey).
[[nodiscard]] Image opaque_rgba(const Image& image);

/// RGB of RGBA unorm8.
[[nodiscard]] Image without_alpha(const Image& picture);

}  // namespace etalon::validation
