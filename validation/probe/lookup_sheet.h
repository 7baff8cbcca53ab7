// Lookups at coordinates that no interpolation has touched: they stand in an indexing map, one to a texel, and a frame of the map's size is
// drawn through it. The map itself is looked up at its texels' centres, half a texel from where a device could err.
#pragma once

#include <memory>
#include <vector>

#include "core/draw/renderer.h"

namespace etalon::validation {

inline constexpr int kSheetSize = 256;
inline constexpr std::size_t kSheetLookups = std::size_t{kSheetSize} * kSheetSize;

/// Looks `texture` up at `coordinates` (at most kSheetLookups); the result's texel n mod kSheetSize, n / kSheetSize is of coordinate n.
[[nodiscard]] Image look_up(Renderer& device, const std::shared_ptr<const Image>& texture, const Sampler& sampler,
                            const std::vector<Vec2f>& coordinates, PixelFormat target);

/// The first channel of each lookup, as float32.
[[nodiscard]] std::vector<float> look_up_floats(Renderer& device, const std::shared_ptr<const Image>& texture, const Sampler& sampler,
                                                const std::vector<Vec2f>& coordinates);

/// The numbers `values` (at most kSheetLookups) copied texel by texel into a target of `format`, 1 channel.
[[nodiscard]] Image store(Renderer& device, const std::vector<float>& values, PixelFormat format);

}  // namespace etalon::validation
