// Small pieces of HTML: escaping, base64, pictures as data URIs.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "core/image/image.h"

namespace etalon::validation {

/// `text` for element content and for attributes in double quotes; control characters become U+FFFD.
[[nodiscard]] std::string escaped(const std::string& text);

/// RFC 4648, with padding.
[[nodiscard]] std::string base64(std::span<const std::byte> bytes);

/// "data:image/png;base64,…" of an RGB unorm8 image; our row 0 becomes the bottom row.
[[nodiscard]] std::string png_data_uri(const Image& picture);

}  // namespace etalon::validation
