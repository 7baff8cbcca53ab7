// The JSON header of FILE.draws as a struct; both directions. Not for use outside core/io.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/draw/draw_list.h"

namespace etalon::io {

inline constexpr std::string_view kDrawsSignature = "etalonDR";
inline constexpr std::size_t kDrawsPreambleBytes = 16;  ///< signature, then the header's size as uint64
inline constexpr std::uint64_t kDrawsHeaderLimitBytes = 1 << 24;
inline constexpr std::size_t kDrawsVertexBytes = 40;
inline constexpr std::size_t kDrawsTriangleBytes = 12;

struct DrawsImage {
  std::string path;
  std::string sha256;
  bool srgb = false;       ///< unorm8 colours hold the sRGB curve
  bool top_first = false;  ///< v = 0 is the top row of the picture
};

struct DrawsDraw {
  bool clip_space = false;
  std::uint64_t vertex_count = 0;
  Draw draw;  ///< first_triangle and triangle_count count the file's triangles
};

struct DrawsHeader {
  Frame frame;
  std::vector<DrawsImage> images;
  std::vector<DrawsDraw> draws;
};

/// InputError "FILE: FIELD: …". Checks fields and image indices; the arrays are the caller's.
[[nodiscard]] DrawsHeader parse_draws_header(std::span<const std::byte> json, const std::string& file);
[[nodiscard]] std::string draws_header_text(const DrawsHeader& header);

}  // namespace etalon::io
