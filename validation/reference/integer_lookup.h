// Texture lookup of docs/contract.md#values at exact fractions.
#pragma once

#include <array>

#include "core/draw/draw_list.h"
#include "validation/reference/fraction.h"

namespace etalon::validation::reference {

struct TextureCoordinate {
  Fraction u;
  Fraction v;
};

/// The exact value of the four channels at `uv`, by the sampler's filter and wraps.
[[nodiscard]] std::array<Fraction, 4> look_up(const Image& image, const Sampler& sampler, const TextureCoordinate& uv);

/// "indexing_map is looked up at uv; its first two channels are the coordinate of the second lookup".
[[nodiscard]] TextureCoordinate look_up_coordinate(const Image& map, const Sampler& sampler, const TextureCoordinate& uv);

}  // namespace etalon::validation::reference
