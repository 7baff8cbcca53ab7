#include "validation/joint/texture_group.h"

#include <string>

#include "core/base/error.h"
#include "core/base/parallel.h"

namespace etalon::validation {

TextureGroup::TextureGroup(std::span<const Image> textures) : textures_(textures) {
  ETALON_CHECK(!textures.empty() && textures.size() <= kMost, std::to_string(textures.size()));
  constexpr std::size_t kBlock = 4096;
  const std::size_t texels = textures[0].texel_count();
  for (const Image& texture : textures)
    ETALON_CHECK(texture.format() == kRgba8 && texture.texel_count() == texels, std::to_string(texture.texel_count()));
  texels_.resize(texels * 3 * kMost);
  parallel_for_blocks(texels, kBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = 0; t < kMost; ++t) {
      const std::byte* from = textures_[t < textures_.size() ? t : 0].bytes().data() + 4 * begin;
      std::byte* to = texels_.data() + 3 * kMost * begin + t;
      for (std::size_t n = begin; n < end; ++n, from += 4, to += 3 * kMost) to[0] = from[0], to[kMost] = from[1], to[2 * kMost] = from[2];
    }
  });
}

}  // namespace etalon::validation
