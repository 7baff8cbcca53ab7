#include <cstring>

#include "core/base/error.h"
#include "core/base/sha256.h"
#include "core/io/atomic_file.h"
#include "core/io/draws_file.h"
#include "core/io/draws_header.h"
#include "core/io/image_file.h"
#include "core/io/inputs.h"

namespace etalon::io {
namespace {

const char* extension_for(const Image& image) {
  const ChannelType type = image.format().type;
  if (type == ChannelType::half || type == ChannelType::float32 || type == ChannelType::uint32) return ".exr";
  return image.format().channels == 2 ? ".tif" : ".png";
}

template <class T>
void append(std::string& bytes, T value) {
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof value);
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

void append(std::string& bytes, const RasterVertex& v) {
  append(bytes, v.x);
  append(bytes, v.y);
  for (const float value : {v.z, v.w, v.uv.x, v.uv.y, v.color.x, v.color.y, v.color.z, v.color.w}) append(bytes, value);
}

}  // namespace

std::vector<std::filesystem::path> draws_image_paths(const std::filesystem::path& path, const DrawList& list) {
  std::vector<std::filesystem::path> paths;
  for (std::size_t n = 0; n < list.images.size(); ++n)
    paths.push_back(path.parent_path() / (path.stem().string() + "." + std::to_string(n) + extension_for(*list.images[n])));
  return paths;
}

std::string write_draws(const std::filesystem::path& path, const DrawList& list, const Frame& frame) {
  if (list.draws.empty() && !list.vertices.empty()) throw WriteError(path.string() + ": the draw list has vertices but no draw");
  DrawsHeader header{.frame = frame, .images = {}, .draws = {}};
  for (const Draw& draw : list.draws) header.draws.push_back({.draw = draw});
  if (!header.draws.empty()) header.draws.front().vertex_count = list.vertices.size();  // a draw may use the vertices of those before it
  const std::vector<std::filesystem::path> image_paths = draws_image_paths(path, list);
  for (std::size_t n = 0; n < list.images.size(); ++n) {
    write_image(image_paths[n], *list.images[n]);
    header.images.push_back({.path = image_paths[n].filename().string(),
                             .sha256 = file_sha256(image_paths[n]),
                             .srgb = list.images[n]->format().type == ChannelType::srgb8});
  }
  std::string text = draws_header_text(header);
  while ((text.size() + kDrawsPreambleBytes) % 8 != 0) text += ' ';  // arrays at a multiple of eight: nobody needs it, some like it
  std::string bytes(kDrawsSignature);
  append(bytes, std::uint64_t{text.size()});
  bytes += text;
  bytes.reserve(bytes.size() + list.vertices.size() * kDrawsVertexBytes + list.triangles.size() * kDrawsTriangleBytes);
  for (const RasterVertex& v : list.vertices) append(bytes, v);
  for (const auto& triangle : list.triangles)
    for (const std::uint32_t corner : triangle) append(bytes, corner);
  write_file(path, bytes);
  return sha256_hex(std::as_bytes(std::span(bytes)));
}

}  // namespace etalon::io
