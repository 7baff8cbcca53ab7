#include "validation/verify/draw_list_hash.h"

#include <bit>

#include "core/base/sha256.h"

namespace etalon::validation {
namespace {

class FieldHash {
 public:
  void add(std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) {
      const auto byte = static_cast<unsigned char>(value >> (8 * i));
      buffer_ += static_cast<char>(byte);
    }
    if (buffer_.size() > 1 << 16) flush();
  }
  void add(std::uint32_t value) { add(value, 4); }
  void add(std::int32_t value) { add(static_cast<std::uint32_t>(value), 4); }
  void add(float value) { add(std::bit_cast<std::uint32_t>(value), 4); }
  void add(const std::string& text) { buffer_ += text; }
  void add(const Sampler& sampler) {
    add(static_cast<std::uint64_t>(sampler.filter), 1);
    add(static_cast<std::uint64_t>(sampler.wrap_u), 1);
    add(static_cast<std::uint64_t>(sampler.wrap_v), 1);
  }
  [[nodiscard]] std::string hex() {
    flush();
    return hash_.hex();
  }

 private:
  void flush() {
    hash_.update(buffer_.data(), buffer_.size());
    buffer_.clear();
  }
  Sha256 hash_;
  std::string buffer_;
};

}  // namespace

std::string draw_list_sha256(const DrawList& list) {
  FieldHash hash;
  for (const std::size_t count : {list.vertices.size(), list.triangles.size(), list.draws.size(), list.images.size()}) hash.add(count, 8);
  for (const RasterVertex& vertex : list.vertices) {
    hash.add(vertex.x);
    hash.add(vertex.y);
    for (const float value : {vertex.z, vertex.w, vertex.uv.x, vertex.uv.y, vertex.color.x, vertex.color.y, vertex.color.z, vertex.color.w})
      hash.add(value);
  }
  for (const auto& triangle : list.triangles) {
    for (const std::uint32_t index : triangle) hash.add(index);
  }
  for (const Draw& draw : list.draws) {
    hash.add(draw.first_triangle);
    hash.add(draw.triangle_count);
    hash.add(static_cast<std::uint64_t>(draw.shading), 1);
    hash.add(draw.texture);
    hash.add(draw.sampler);
    hash.add(draw.indexing_map);
    hash.add(draw.map_sampler);
  }
  for (const auto& image : list.images) hash.add(image->sha256());
  return hash.hex();
}

}  // namespace etalon::validation
