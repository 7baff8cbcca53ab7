#include "gpu/exact_records.h"

#include <algorithm>
#include <array>
#include <bit>

#include <fmt/core.h>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "gpu/exact_shaders.h"
#include "gpu/exact_texture.h"

namespace etalon::gpu {

namespace {

using Words = std::array<std::uint32_t, 4>;
constexpr PixelFormat kWordsFormat{ChannelType::uint32, 4};
constexpr std::size_t kRecordsPerTask = 4096;

std::uint32_t bits(float value) { return std::bit_cast<std::uint32_t>(canonical(value)); }

GlHandle upload_words(const gl::Api& gl, std::vector<Words>& words, int max_size, const std::string& what) {
  const std::size_t rows = std::max<std::size_t>((words.size() + kRecordWidth - 1) / kRecordWidth, 1);
  if (rows > static_cast<std::size_t>(max_size)) {
    throw UnavailableError(
        fmt::format("OpenGL: {}: the exact shader takes at most {}", what, std::size_t{kRecordWidth} * static_cast<std::size_t>(max_size)));
  }
  words.resize(rows * kRecordWidth);
  return make_bits_texture(gl, kWordsFormat, kRecordWidth, static_cast<int>(rows), words.data(), max_size, what);
}

/// Whether two draws give their triangles the same program and textures.
bool shades_alike(const Draw& a, const Draw& b) {
  if (a.shading != b.shading) return false;
  if (a.shading == Shading::vertex_color) return true;
  if (a.texture != b.texture || a.sampler != b.sampler) return false;
  return a.shading == Shading::texture || (a.indexing_map == b.indexing_map && a.map_sampler == b.map_sampler);
}

/// Corners of a growing rectangle of sub-texels.
struct Extent {
  std::int32_t x0 = INT32_MAX, y0 = INT32_MAX, x1 = INT32_MIN, y1 = INT32_MIN;
  void add(const RasterVertex& v) {
    x0 = std::min(x0, v.x), y0 = std::min(y0, v.y);
    x1 = std::max(x1, v.x), y1 = std::max(y1, v.y);
  }
  [[nodiscard]] TexelBox texels(const Frame& frame) const {
    if (x0 > x1) return {};
    const int b = frame.state.subtexel_bits;
    const int left = std::max(x0 >> b, 0), bottom = std::max(y0 >> b, 0);
    return {left, bottom, std::min((x1 >> b) + 1, frame.width) - left, std::min((y1 >> b) + 1, frame.height) - bottom};
  }
};

}  // namespace

ExactRecords upload_records(const gl::Api& gl, const DrawList& list, const Frame& frame, int max_size) {
  ExactRecords records;
  std::vector<Words> words(3 * list.vertices.size());
  parallel_for_blocks(list.vertices.size(), kRecordsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const RasterVertex& v = list.vertices[i];
      words[3 * i] = {static_cast<std::uint32_t>(v.x), static_cast<std::uint32_t>(v.y), bits(v.z), bits(v.w)};
      words[3 * i + 1] = {bits(v.uv.x), bits(v.uv.y), bits(v.color.x), bits(v.color.y)};
      words[3 * i + 2] = {bits(v.color.z), bits(v.color.w), 0, 0};
    }
  });
  records.vertices = upload_words(gl, words, max_size, fmt::format("{} vertices", list.vertices.size()));

  words.assign(list.triangles.size(), {});
  std::vector<Extent> extents;
  for (const Draw& draw : list.draws) {
    const auto known = std::find_if(records.groups.begin(), records.groups.end(),
                                    [&](const ShadingGroup& group) { return shades_alike(group.draw, draw); });
    const auto group = static_cast<std::uint32_t>(known - records.groups.begin());
    if (known == records.groups.end()) {
      records.groups.push_back({draw, {}});
      extents.emplace_back();
    }
    for (std::uint32_t t = draw.first_triangle; t < draw.first_triangle + draw.triangle_count; ++t) {
      const auto& corners = list.triangles[t];
      words[t] = {corners[0], corners[1], corners[2], group};
      for (const std::uint32_t corner : corners) extents[group].add(list.vertices[corner]);
    }
  }
  for (std::size_t group = 0; group < extents.size(); ++group) records.groups[group].box = extents[group].texels(frame);
  records.triangles = upload_words(gl, words, max_size, fmt::format("{} triangles", list.triangles.size()));
  return records;
}

}  // namespace etalon::gpu
