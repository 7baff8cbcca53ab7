// Small scenes by hand for the tests of the diff.
#pragma once

#include <memory>
#include <vector>

#include "core/draw/draw_list.h"

namespace etalon::test {

inline RasterVertex at(double x_texel, double y_texel, Vec2f uv = {0, 0}, Vec4f color = {0, 0, 0, 1}, float z = 0.5f, float w = 1) {
  return {static_cast<std::int32_t>(x_texel * 256), static_cast<std::int32_t>(y_texel * 256), z, w, uv, color};
}

inline Frame frame_of(int width, int height, std::vector<TargetSpec> targets, const RasterState& state = {}) {
  Frame frame;
  frame.width = width;
  frame.height = height;
  frame.guard = 64;
  frame.state = state;
  frame.targets = std::move(targets);
  return frame;
}

inline DrawList list_of(std::vector<RasterVertex> vertices, Draw draw = {}, std::vector<std::shared_ptr<const Image>> images = {}) {
  DrawList list;
  list.vertices = std::move(vertices);
  for (std::uint32_t i = 0; i + 2 < list.vertices.size(); i += 3) list.triangles.push_back({i, i + 1, i + 2});
  draw.triangle_count = static_cast<std::uint32_t>(list.triangles.size());
  list.draws = {draw};
  list.images = std::move(images);
  return list;
}

/// Two triangles over [0, width] × [0, height] whose uv run from `lo` to `hi`.
inline DrawList quad(int width, int height, Vec2f lo, Vec2f hi, std::shared_ptr<const Image> texture, Sampler sampler = {}) {
  const RasterVertex a = at(0, 0, lo), b = at(width, 0, {hi.x, lo.y}), c = at(width, height, hi), d = at(0, height, {lo.x, hi.y});
  return list_of({a, b, c, a, c, d}, {.shading = Shading::texture, .texture = 0, .sampler = sampler}, {std::move(texture)});
}

/// unorm8 texels that differ from all their neighbours by much: (37·x + 101·y + 59·c) mod 256.
inline std::shared_ptr<const Image> busy_texture(int width, int height, PixelFormat format = kRgba8) {
  Image image(width, height, format);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < format.channels; ++c) {
        const int value = (37 * x + 101 * y + 59 * c) % 256;
        if (format.type == ChannelType::unorm8) image.channels<std::uint8_t>(x, y)[c] = static_cast<std::uint8_t>(value);
        if (format.type == ChannelType::float32) image.channels<float>(x, y)[c] = static_cast<float>(value) / 64;
      }
    }
  }
  return std::make_shared<const Image>(std::move(image));
}

}  // namespace etalon::test
