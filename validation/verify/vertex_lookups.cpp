#include "validation/verify/vertex_lookups.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/error.h"

namespace etalon::validation {
namespace {

constexpr std::size_t kRow = 16384;  ///< vertices a row of the frame
constexpr std::uint32_t kNone = 0xFFFFFFFFu;

/// The first face at each vertex: its texture coordinate there and its material.
struct FirstFace {
  std::uint32_t material = kNone;
  Vec2f uv{0, 0};
};

std::vector<FirstFace> first_faces(const Mesh& mesh) {
  std::vector<FirstFace> first(mesh.vertex_count());
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    for (int c = 0; c < 3; ++c) {
      const Wedge& wedge = mesh.wedge(FaceId(f), c);
      FirstFace& here = first[wedge.vertex.index];
      if (here.material == kNone) here = {mesh.face_materials.empty() ? 0 : mesh.face_materials[f], wedge.uv};
    }
  }
  return first;
}

// Around the centre of the vertex's own texel and no other one: at half its height it spans the middle half of that texel.
void add_triangle(DrawList& list, std::size_t vertex, const Vec2f& uv, std::int32_t texel) {
  const std::int32_t x = static_cast<std::int32_t>(vertex % kRow) * texel, y = static_cast<std::int32_t>(vertex / kRow) * texel;
  const auto corner = static_cast<std::uint32_t>(list.vertices.size());
  list.vertices.push_back({.x = x, .y = y, .uv = uv});
  list.vertices.push_back({.x = x + texel, .y = y, .uv = uv});
  list.vertices.push_back({.x = x + texel / 2, .y = y + texel, .uv = uv});
  list.triangles.push_back({corner, corner + 1, corner + 2});
}

}  // namespace

std::vector<Vec4f> texture_at_vertices(const Mesh& mesh, const std::vector<Material>& materials, Renderer& exact) {
  const std::size_t count = mesh.vertex_count();
  if (count > kRow * kRow) throw InputError(fmt::format("expected at most {} vertices, got {}", kRow * kRow, count));
  if (count == 0) return {};
  constexpr float kMidGrey = 128.0f / 255;
  Frame frame;
  frame.width = static_cast<int>(std::min(count, kRow));
  frame.height = static_cast<int>((count + kRow - 1) / kRow);
  frame.guard = 0;
  frame.targets = {{TargetContent::color, kRgba8, {kMidGrey, kMidGrey, kMidGrey, 1}}};

  const std::vector<FirstFace> first = first_faces(mesh);
  DrawList list;
  for (std::uint32_t m = 0; m < materials.size(); ++m) {
    if (materials[m].texture == nullptr) continue;
    Draw draw{.first_triangle = static_cast<std::uint32_t>(list.triangles.size()), .shading = Shading::texture};
    for (std::size_t v = 0; v < count; ++v)
      if (first[v].material == m) add_triangle(list, v, first[v].uv, 1 << frame.state.subtexel_bits);
    draw.triangle_count = static_cast<std::uint32_t>(list.triangles.size()) - draw.first_triangle;
    if (draw.triangle_count == 0) continue;
    draw.texture = static_cast<std::uint32_t>(list.images.size());
    draw.sampler = materials[m].sampler;
    draw.sampler.filter = Filter::nearest;
    list.images.push_back(materials[m].texture);
    list.draws.push_back(draw);
  }

  const Image drawn = exact.render(list, frame).front();
  std::vector<Vec4f> colors(count);
  for (std::size_t v = 0; v < count; ++v) {
    const auto* const texel = drawn.channels<std::uint8_t>(static_cast<int>(v % kRow), static_cast<int>(v / kRow));
    for (int c = 0; c < 4; ++c) colors[v][c] = static_cast<float>(texel[c]) / 255;
  }
  return colors;
}

}  // namespace etalon::validation
