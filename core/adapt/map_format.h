// What an indexing map's texels are stored as, and whether that can name the texels of a texture of its size [Chen & Chuang 2006, sec. 3.4,
// Figure 10].
#pragma once

#include <cstddef>

#include "core/image/image.h"
#include "core/math/vec.h"

namespace etalon::adapt {

/// The map that names every texel's own centre, ((x + ½)/width, (y + ½)/height), as two channels of `type`, each rounded once to nearest
/// even. float32, half, unorm16 or unorm8; InputError for other types.
[[nodiscard]] Image identity_map(int width, int height, ChannelType type = ChannelType::float32);

/// The coordinate that texel (x, y) holds: the stored number, exactly for float32 and half; i/255 and i/65535 rounded once to double.
/// 0 <= x < width, 0 <= y < height, unchecked; the map has two channels or more of a type that identity_map() knows.
[[nodiscard]] Vec2d map_coordinate(const Image& map, int x, int y);

/// Stores a coordinate in texel (x, y): the nearest float32 or half, ties to even; the nearest integer to 255·p or 65535·p as computed in
/// double, of p clamped to [0, 1]. p finite. The map has two channels of a type that identity_map() knows; x and y are unchecked.
void set_map_coordinate(Image& map, int x, int y, const Vec2d& p);

/// How many texels of a width × height texture the identity map of this type and size does not give back by nearest lookup,
/// floor(stored · size) clamped to the texture ≠ own index; exact. 0: the type names every texel. A map of such a size loses detail before
/// anything is adapted. InputError for a type that identity_map() does not know.
[[nodiscard]] std::size_t unnamed_texels(int width, int height, ChannelType type);

}  // namespace etalon::adapt
