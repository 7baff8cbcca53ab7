// What an indexing map must be stored as [Chen & Chuang 2006, sec. 3.4, Figure 10], and pictures of parameterizations.
#pragma once

#include <memory>
#include <vector>

#include "core/adapt/adapt_sequence.h"
#include "core/adapt/chart_borders.h"
#include "core/draw/renderer.h"
#include "core/mesh/mesh.h"
#include "validation/studies/chen_inverse.h"

namespace etalon::validation {

struct ChenFormat {
  ChannelType type = ChannelType::float32;
  std::shared_ptr<const Image> map;  ///< of the level, adapted in this format
  std::size_t unnamed = 0;           ///< texels that its identity map does not name
  TexelErrors errors;                ///< from where the exact chain leads
};

/// The indexing map adapted from the finest level to `level`, with its gutter, in float32, half, unorm16 and unorm8. `analytic`: of that
/// level and size.
[[nodiscard]] std::vector<ChenFormat> adapt_in_formats(Renderer& renderer, const adapt::AdaptSequence& sequence,
                                                       const adapt::ChartBorders& borders, std::size_t level, const Image& analytic);

/// The edges of the faces over the texture, RGB unorm8, size × size.
[[nodiscard]] Image parameterization_picture(Renderer& renderer, const Mesh& mesh, const std::shared_ptr<const Image>& texture, int size);

}  // namespace etalon::validation
