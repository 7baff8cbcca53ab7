// Textures of one size side by side, texel by texel, so that one lookup reads all of them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/image/image.h"
#include "raster/fast/kernels.h"

namespace etalon::validation {

class TextureGroup {
 public:
  static constexpr std::size_t kMost = raster::fast::kGroupTextures;
  using Sums = std::array<std::uint64_t, kMost>;  ///< by texture; unspecified behind the last

  /// 1 to kMost textures, RGBA unorm8, opaque, of one size; they must outlive the group.
  explicit TextureGroup(std::span<const Image> textures);

  [[nodiscard]] std::span<const Image> textures() const { return textures_; }
  /// Of each texel the R of all textures, then G, then B; those behind the last are copies of the first.
  [[nodiscard]] const std::vector<std::byte>& texels() const { return texels_; }

 private:
  std::span<const Image> textures_;
  std::vector<std::byte> texels_;
};

}  // namespace etalon::validation
