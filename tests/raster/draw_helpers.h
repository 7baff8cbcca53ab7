// Small literal scenes for the tests of raster/.
#pragma once

#include <memory>
#include <vector>

#include "raster/cpu_renderer.h"

namespace etalon::test {

/// A vertex at (x, y) texels on a frame of 8 sub-texel bits.
inline RasterVertex at(double x, double y, float u = 0, float v = 0) {
  RasterVertex vertex;
  vertex.x = static_cast<std::int32_t>(x * 256), vertex.y = static_cast<std::int32_t>(y * 256);
  vertex.uv = {u, v};
  return vertex;
}

inline Frame frame_of(int width, int height, std::vector<TargetSpec> targets) {
  Frame frame;
  frame.width = width, frame.height = height, frame.guard = 64, frame.targets = std::move(targets);
  return frame;
}

/// One draw of all the triangles given as vertex triples.
inline DrawList list_of(std::vector<RasterVertex> vertices, Shading shading = Shading::vertex_color) {
  DrawList list;
  list.vertices = std::move(vertices);
  for (std::uint32_t n = 0; n + 2 < list.vertices.size(); n += 3) list.triangles.push_back({n, n + 1, n + 2});
  Draw draw;
  draw.triangle_count = static_cast<std::uint32_t>(list.triangles.size());
  draw.shading = shading;
  list.draws = {draw};
  return list;
}

/// Two triangles that cover [x0, x1] × [y0, y1] texels with uv from `lo` to `hi` at the corners.
inline std::vector<RasterVertex> quad(double x0, double y0, double x1, double y1, Vec2f lo = {0, 0}, Vec2f hi = {1, 1}) {
  return {at(x0, y0, lo.x, lo.y), at(x1, y0, hi.x, lo.y), at(x1, y1, hi.x, hi.y),
          at(x0, y0, lo.x, lo.y), at(x1, y1, hi.x, hi.y), at(x0, y1, lo.x, hi.y)};
}

inline const std::vector<TargetSpec> kIdOnly = {{TargetContent::triangle_id, kR32ui}};

inline std::vector<std::uint32_t> ids(const Image& image) {
  const auto* first = image.channels<std::uint32_t>(0, 0);
  return {first, first + image.texel_count()};
}

}  // namespace etalon::test
