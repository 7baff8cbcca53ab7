// An image: width × height texels of one format, tightly packed rows. Row 0 is v = 0 (the first row of glReadPixels); only file I/O flips.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/image/pixel_format.h"

namespace etalon {

inline constexpr int kMaxImageSize = 32768;  ///< texels on a side

class Image {
 public:
  /// The empty image, 0 × 0: "no image".
  Image() = default;

  /// All bytes zero. Sizes 1..kMaxImageSize, channels 1..4; anything else is InputError.
  Image(int width, int height, PixelFormat format);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] PixelFormat format() const { return format_; }
  [[nodiscard]] bool empty() const { return bytes_.empty(); }
  [[nodiscard]] std::size_t texel_count() const { return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_); }

  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }
  [[nodiscard]] std::span<std::byte> bytes() { return bytes_; }

  /// First byte of texel (x, y); 0 <= x < width(), 0 <= y < height(), unchecked.
  [[nodiscard]] const std::byte* texel(int x, int y) const { return bytes_.data() + offset(x, y); }
  [[nodiscard]] std::byte* texel(int x, int y) { return bytes_.data() + offset(x, y); }

  /// Channel values of texel (x, y) as the stored type: unorm8/srgb8 → uint8_t, unorm16/half → uint16_t, float32 → float, uint32 → uint32_t.
  template <class T>
  [[nodiscard]] const T* channels(int x, int y) const {
    return reinterpret_cast<const T*>(texel(x, y));
  }
  template <class T>
  [[nodiscard]] T* channels(int x, int y) {
    return reinterpret_cast<T*>(texel(x, y));
  }

  /// sha256 over format, size and bytes: equal exactly when the images are.
  [[nodiscard]] std::string sha256() const;

  friend bool operator==(const Image&, const Image&) = default;

 private:
  [[nodiscard]] std::size_t offset(int x, int y) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)) *
           static_cast<std::size_t>(bytes_per_texel(format_));
  }
  int width_ = 0;
  int height_ = 0;
  PixelFormat format_;
  std::vector<std::byte> bytes_;
};

/// How many texels differ in a byte. ETALON_CHECKs that size and format are the same.
[[nodiscard]] std::size_t differing_texels(const Image& a, const Image& b);

/// The same image with its rows in reverse order; what file I/O does between top-down files and our v-up rows.
[[nodiscard]] Image flipped_rows(const Image& image);

}  // namespace etalon
