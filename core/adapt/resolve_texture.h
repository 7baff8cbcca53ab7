// A texture of the finest level as a level shows it through an indexing map: for programs that cannot look up twice.
#pragma once

#include "core/draw/renderer.h"
#include "core/draw/state.h"

namespace etalon::adapt {

/// At the texture's own size and in its format: each texel is the texture looked up, linearly, at what the map holds there, which is looked up
/// by `map_filter`; both clamped, rounded once at storage. One map serves any number of textures (colour, normals, …), of any sizes.
/// UnavailableError where the renderer does not draw the format; InputError as Renderer::render(), as for a texture of integers.
[[nodiscard]] Image resolve_texture(Renderer& renderer, const Image& texture, const Image& map, Filter map_filter = Filter::linear);

}  // namespace etalon::adapt
