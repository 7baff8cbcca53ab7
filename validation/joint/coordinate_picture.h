// A mesh drawn once into texture coordinates, through which any number of textures are looked up: the pictures of all pairs of one mesh for the
// price of one drawing.
//
// What a picture is here: first the mesh is drawn into its coordinates, stored as float32, rounded once (docs/contract.md#targets); then each covered texel
// looks the texture up at its stored coordinate, linearly, clamped, the value rounded once to unorm8 (docs/contract.md#values, indexed lookup);
// uncovered texels are black. draw_in_two_passes() has a renderer do both; CoordinatePicture does the second itself, in integers: the same bytes.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/draw/camera.h"
#include "core/draw/renderer.h"
#include "validation/joint/texture_group.h"

namespace etalon::validation {

/// Frame of the pictures: the view's size, the renderer's own state.
struct PictureFrame {
  Camera camera;
  int width = 640, height = 480;
};

/// What a mesh covers and at which coordinates.
struct DrawnCoordinates {
  std::shared_ptr<const Image> coordinates;  ///< RG float32
  Image ids;                                 ///< R uint32: triangle of the draw list, kNoTriangle where nothing is seen
};

/// The mesh of one wedge a vertex, drawn into its own coordinates. Errors of make_scene() and Renderer::render().
[[nodiscard]] DrawnCoordinates draw_coordinates(Renderer& renderer, const Mesh& mesh, const PictureFrame& frame);

/// Covers no longer in either what both show at the same coordinate, bit by bit: there all their pictures are equal, so that between errors of these
/// rests lies the same difference as between those of the whole. Of one size (InternalError).
void hide_what_both_show(DrawnCoordinates& one, DrawnCoordinates& other);

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
  CoordinatePicture(DrawnCoordinates drawn, int texture_width, int texture_height);

  /// The picture of a texture (RGBA unorm8, opaque, of that size).
  [[nodiscard]] Image picture(const Image& texture) const;

  /// A picture that others are compared with: made once for all textures.
  struct Reference {
    std::vector<std::array<std::uint8_t, 4>> covered;  ///< its texels where this picture is covered, alpha 255
    std::uint64_t elsewhere = 0;                       ///< sum of the squares of its R, G, B where it is not
  };
  /// `wanted`: RGBA unorm8, the frame's size.
  [[nodiscard]] Reference reference(const Image& wanted) const;

  /// Sum of squared RGB differences between the picture of `texture` and the reference, over the whole frame. By vectors, and in integers where
  /// these cannot decide how a value is rounded.
  [[nodiscard]] std::uint64_t sse(const Image& texture, const Reference& reference) const;

  /// The same for all textures of a group.
  [[nodiscard]] TextureGroup::Sums sse(const TextureGroup& textures, const Reference& reference) const;

  [[nodiscard]] std::size_t covered_texels() const { return at_.size(); }

 private:
  [[nodiscard]] std::array<std::uint8_t, 3> color(const std::uint8_t* texels, std::size_t lookup) const;
  [[nodiscard]] std::uint64_t square(const std::uint8_t* texels, std::size_t lookup, const Reference& reference) const;
  void require_texture(const Image& texture) const;

  std::shared_ptr<const Image> coordinates_;
  int texture_width_, texture_height_;
  // By covered texel, in the frame's order: where it is; texel (i, j) of (i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1); the weights of the second
  // column and row.
  std::vector<std::uint32_t> at_, texel_;
  std::vector<float> fx_, fy_;
};

/// RGBA unorm8, opaque. InputError for other formats than RGB and RGBA unorm8 (1 channel: grey).
[[nodiscard]] Image opaque_rgba(const Image& image);

/// RGB of RGBA unorm8.
[[nodiscard]] Image without_alpha(const Image& picture);

}  // namespace etalon::validation
