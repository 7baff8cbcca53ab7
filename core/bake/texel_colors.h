// The colours of the scan's vertices in the texels they fall into, averaged [Soucy, Godin & Rioux 1996, sec. 2, figure 3].
#pragma once

#include "core/bake/texel_nodes.h"
#include "core/mesh/landing.h"

namespace etalon::bake {

using Rgb8 = std::array<std::uint8_t, 3>;

/// By texel, in the numbering of TexelNodes. A texel has its node's colour and hits, so texels that must be equal are.
struct TexelColors {
  std::vector<Rgb8> color;          ///< black where nothing hit
  std::vector<std::uint32_t> hits;  ///< vertices of the scan averaged there
  std::size_t without_face = 0;     ///< vertices of the scan that no face used: their colours go nowhere

  [[nodiscard]] bool is_hit(std::uint32_t texel) const { return hits[texel] > 0; }
};

/// A colour channel in [0, 1] as a byte: the nearest of 0..255, halves up.
[[nodiscard]] std::uint8_t color_byte(float channel);

/// Each vertex of the scan goes to the texel whose centre is nearest, in the texture, to its landing; a node's colour is the mean of all that
/// hit one of its texels, each channel on its own, in integers, rounded to nearest, halves up. `colors` and `landings` are by vertex of the
/// scan, landings on the mesh of the atlas. A vertex at a corner, that is, one that the mesh kept, hits all triangles around it, once.
/// InputError where `colors` is empty.
[[nodiscard]] TexelColors average_colors(const Atlas& atlas, const TexelNodes& nodes, const std::vector<Vec4f>& colors,
                                         const std::vector<Landing>& landings);

}  // namespace etalon::bake
