// A map that stays with its renderer while passes of texture-space triangles change it, each by lookups in the map as it was before: what
// texture adaptation does thousands of times to one image.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/draw/draw_list.h"
#include "core/image/image.h"

namespace etalon {

class Renderer;

/// Triangles over a map's own texels. `x`, `y` are places in the map in sub-texels of the map's state, `uv` where to look it up; z, w and
/// color are left as they are (0, 1, black). Of several triangles on a texel the last counts.
struct MapPass {
  std::vector<RasterVertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< #T by 3, either orientation
  /// Where each group's triangles end, ascending, the last #T. Triangles of different groups have no texel in common (a renderer may draw
  /// groups at the same time); where callers cannot say so all are one group.
  std::vector<std::uint32_t> group_ends;
};

/// InputError where group_ends do not ascend to #T.
void validate_groups(const MapPass& pass);

/// How a map looks itself up and where its vertices may be.
struct MapState {
  Filter filter = Filter::linear;  ///< clamped to the map's edge
  RasterState raster;              ///< one the renderer supports; depth test and culling are off whatever it says
};

/// Dies before its renderer.
class ResidentMap {
 public:
  virtual ~ResidentMap() = default;

  /// Does the passes one after the other: a texel that a triangle covers becomes what the lookup at the triangle's coordinate gives in the
  /// map as it was before the pass; all others keep their bytes. InputError: a pass breaks docs/contract.md#input or its groups do; the map is then as
  /// the passes before it left it. UnavailableError as Renderer::render().
  virtual void apply(std::span<const MapPass> passes) = 0;

  [[nodiscard]] virtual Image read_back() = 0;

  /// Texels written by all passes so far, each pass counting its own; 0 where the renderer does not count.
  [[nodiscard]] virtual std::uint64_t texels_written() const { return 0; }
};

/// The frame of a map's passes: its size, guarded as far as frames go, with the map's colours as first target.
[[nodiscard]] Frame map_frame(int width, int height, PixelFormat format, const MapState& state);

/// The pass as a drawing: one draw that looks up `map`.
[[nodiscard]] DrawList map_pass_list(const MapPass& pass, std::shared_ptr<const Image> map, Filter filter);

/// Copies the texels of a drawn pass (colours; ids, R32ui, kNoTriangle where nothing was drawn) into the map. How many.
std::uint64_t copy_drawn(const Image& color, const Image& ids, Image& map);

/// By Renderer::render() and copies of the texels whose triangle id says that something was drawn: right for every renderer, fast for none.
[[nodiscard]] std::unique_ptr<ResidentMap> make_rendered_map(Renderer& renderer, Image map, const MapState& state);

}  // namespace etalon
