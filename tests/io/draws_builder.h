// FILE.draws built by hand from a header and numbers, so that every field can be made wrong.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace etalon::test {

template <class T>
void append_bytes(std::string& bytes, T value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

/// Signature, size, header, arrays.
inline std::string draws_bytes(const std::string& header, const std::string& arrays) {
  std::string bytes = "etalonDR";
  append_bytes(bytes, std::uint64_t{header.size()});
  return bytes + header + arrays;
}

/// A vertex in clip space: x y z w u v, white.
inline std::string clip_record(float x, float y, float z, float w, float u = 0, float v = 0) {
  std::string bytes;
  for (const float value : {x, y, z, w, u, v, 1.0f, 1.0f, 1.0f, 1.0f}) append_bytes(bytes, value);
  return bytes;
}

/// A vertex in raster space: x y in sub-texels, z 0.5, w 1, u v, white.
inline std::string raster_record(std::int32_t x, std::int32_t y, float u = 0, float v = 0) {
  std::string bytes;
  append_bytes(bytes, x);
  append_bytes(bytes, y);
  for (const float value : {0.5f, 1.0f, u, v, 1.0f, 1.0f, 1.0f, 1.0f}) append_bytes(bytes, value);
  return bytes;
}

inline std::string indices(const std::vector<std::uint32_t>& values) {
  std::string bytes;
  for (const std::uint32_t value : values) append_bytes(bytes, value);
  return bytes;
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at != std::string::npos) text.replace(at, from.size(), to);
  return text;
}

/// A header of an 8 × 8 frame with one draw of one triangle in raster space, looked up in one image; `sha` is that image's.
inline std::string small_header(const std::string& sha = std::string(64, '0')) {
  return R"({"schema":"etalon/draws/1","frame":{"width":8,"height":8,"guard":16},)"
         R"("state":{"subtexel_bits":8,"snap":"nearest_even","fill_rule":"left_ymin","half_rounding":"nearest_even","cull":"none","depth_test":true},)"
         R"("images":[{"path":"t.png","sha256":")" +
         sha +
         R"("}],)"
         R"("draws":[{"space":"raster","vertices":3,"triangles":1,"shading":"texture","texture":0,)"
         R"("sampler":{"filter":"nearest","wrap_u":"clamp","wrap_v":"clamp"}}]})";
}

inline std::string small_arrays() {
  return raster_record(0, 0) + raster_record(2048, 0, 1, 0) + raster_record(0, 2048, 0, 1) + indices({0, 1, 2});
}

}  // namespace etalon::test
