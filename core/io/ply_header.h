// The header of a PLY file [Turk 1994]: elements, their counts and properties. Not for use outside core/io.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace etalon::io {

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

[[nodiscard]] std::size_t size_bytes(PlyType type);
[[nodiscard]] constexpr bool is_real(PlyType type) { return type == PlyType::float32 || type == PlyType::float64; }

enum class PlyEncoding : std::uint8_t { ascii, little_endian, big_endian };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;  ///< of the value, or of the list's items
  bool is_list = false;
  PlyType count_type = PlyType::uint8;
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;        ///< in file order
  std::vector<std::string> texture_names;  ///< of `comment TextureFile NAME` lines
  std::uint64_t grid_columns = 0;          ///< of `obj_info num_cols N`; 0: not said
  std::uint64_t grid_rows = 0;             ///< of `obj_info num_rows N`
  std::size_t body_offset_bytes = 0;       ///< first byte after the header
  std::size_t line_count = 0;              ///< lines of the header
};

/// Parses the header at the start of `content`; InputError "FILE:LINE: …". No element claims more rows than the rest of the file can hold.
[[nodiscard]] PlyHeader parse_ply_header(const std::string& file, std::string_view content);

}  // namespace etalon::io
