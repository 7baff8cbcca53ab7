// A coloured scan as few triangles and a texture map: the whole of [Soucy, Godin & Rioux 1996].
#pragma once

#include "core/bake/surface_fill.h"
#include "core/image/image.h"
#include "core/simplify/simplify.h"

namespace etalon::bake {

enum class FillKind : std::uint8_t {
  iterative,  ///< the paper's distance transforms
  exact,      ///< the least distances on the surface
  sampled,    ///< ours, not the paper's: every texel takes the colours of the scan's surface around it, hit or not: sample_scan()
};
enum class Corners : std::uint8_t {
  inset,  ///< drawn in: every point of a triangle is looked up in its own texels
  exact,  ///< the paper's, on the corners of texels: the hypotenuse's integer points are looked up in a neighbour
};

struct BakeOptions {
  std::size_t target_faces = 0;     ///< as simplify::SimplifyOptions
  std::optional<double> tolerance;  ///< model units, above 0
  int width = 512, height = 512;    ///< texels; width a power of two
  FillKind fill = FillKind::iterative;
  Corners corners = Corners::inset;
  Gutter gutter;  ///< mip levels, 0 to 8, in which linear lookup stays within a triangle and its border
  std::function<void(std::size_t done, std::size_t total)> progress;  ///< of the simplification
};

struct TexelCounts {
  std::uint64_t atlas = 0;     ///< width · height
  std::uint64_t inside = 0;    ///< in triangles
  std::uint64_t border = 0;    ///< in their borders, with a gutter
  std::uint64_t hit = 0;       ///< whose node some vertex of the scan fell into
  std::uint64_t averaged = 0;  ///< of these: two vertices or more
  std::uint64_t filled = 0;    ///< inside − hit
};

struct BakeResult {
  /// Its own three wedges for every face, with texture coordinates for nearest lookup, with a gutter linear too; no colours, no materials.
  Mesh mesh;
  Image texture;  ///< RGB unorm8, black where no triangle and no border is
  simplify::SimplifyResult simplified;
  Atlas atlas;
  double spacing = 0;  ///< D_i, model units
  double share = 0;    ///< how far corners are drawn in, of a triangle's size; 0 for Corners::exact
  TexelCounts texels;
  std::size_t without_face = 0;  ///< vertices of the scan in no face: their colours go nowhere
  int iterations = 0;            ///< of the iterative fill
  double fill_distance_max =
      0;                  ///< of a texel to what it took its colour from, model units: on the surface; sampled: in space, to the scan
  int seam_residual = 0;  ///< largest_seam_residual() of the texture
};

/// Simplifies by qem half-edge collapses and bakes the colours (their first three channels). Every vertex lands near where the collapses took
/// it: without a tolerance as land_vertices() says, with one where the simplifier followed it to, never farther than the tolerance. Texture
/// coordinates and materials of the scan count for nothing; vertices of equal place and colour are welded. Where the scan is no oriented
/// manifold, places stay as they are (simplified.repair). Triangles of zero area get texels like others; of what falls on them all are used.
/// The same bytes for every thread count. InputError: no vertex colours, a tolerance not above 0, a colour that is not finite, what
/// simplify_mesh() refuses, edges that all have length 0, a map too small (the smallest that would do is named).
[[nodiscard]] BakeResult bake_scan(const Mesh& scan, const BakeOptions& options);

}  // namespace etalon::bake
