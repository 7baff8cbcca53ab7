// The error of a pair (M_i, T_j): what differs on the screen between its picture and that of the full pair (equation 1 of [Horbelt, Balmelli & Vetterli]),
// as an integer. A mesh is drawn when it is first asked for, not again for its other textures as long as it is among the last few.
#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <optional>
#include <vector>

#include "validation/joint/coordinate_picture.h"

namespace etalon::validation {

struct ScreenProblem {
  PictureFrame frame;
  std::function<Mesh(std::size_t)> mesh;  ///< level i; called each time it must be drawn
  std::vector<Image> textures;            ///< of all levels: RGBA unorm8, opaque, one size
  Image reference;                        ///< the picture of the full pair
};

class ScreenErrors {
 public:
  ScreenErrors(Renderer& renderer, ScreenProblem problem);

  /// Sum of squared differences of R, G, B over the whole frame; texels that show nothing are black.
  [[nodiscard]] std::uint64_t sse(std::size_t mesh, std::size_t texture);
  /// Of a mesh with each texture: faster than one by one, for a second copy of the textures' colours; the more so the more of the mesh is as in the one
  /// last asked for here, since only what differs on the screen is looked up.
  [[nodiscard]] std::vector<std::uint64_t> sse_of_mesh(std::size_t mesh);
  [[nodiscard]] Image picture(std::size_t mesh, std::size_t texture);

  [[nodiscard]] std::uint64_t samples() const { return 3 * std::uint64_t{problem_.reference.texel_count()}; }  ///< that sse() sums over
  /// As if nothing had been asked for.
  void forget_drawings() { last_.clear(), groups_.clear(), row_.reset(); }
  [[nodiscard]] std::size_t meshes_drawn() const { return meshes_drawn_; }
  [[nodiscard]] const Image& reference() const { return problem_.reference; }

 private:
  struct Drawn {
    std::size_t mesh;
    CoordinatePicture picture;
    CoordinatePicture::Reference reference;
  };
  struct Row {  ///< of the mesh that sse_of_mesh() was last asked for
    std::size_t mesh;
    DrawnCoordinates drawn;
    std::vector<std::uint64_t> errors;
  };
  const Drawn& drawn(std::size_t mesh);
  [[nodiscard]] DrawnCoordinates draw(std::size_t mesh);
  /// Of what is drawn, with each texture.
  [[nodiscard]] std::vector<std::uint64_t> errors_of(DrawnCoordinates drawn) const;

  Renderer& renderer_;
  ScreenProblem problem_;
  std::vector<TextureGroup> groups_;  ///< of all textures; made when first needed
  std::list<Drawn> last_;             ///< latest use first
  std::optional<Row> row_;
  std::size_t meshes_drawn_ = 0;
};

}  // namespace etalon::validation
