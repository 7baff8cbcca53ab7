#include "core/draw/clip_placer.h"

#include <algorithm>

#include "core/draw/scene.h"

namespace etalon {
namespace {

constexpr std::uint32_t kNotPlaced = 0xFFFFFFFFu;

RasterVertex raster_vertex(const ClipVertex& v, const Frame& frame) {
  const double w = v.w;
  // After clipping only the rounding of a cut vertex can leave the guard, or the ranges of depth and w, by less than a sub-texel: brought back here.
  const auto window = [&](float clip, int size) {
    const double texels = (double{clip} / w + 1) * 0.5 * size;
    return std::clamp(texels, -static_cast<double>(frame.guard), static_cast<double>(size) + frame.guard);
  };
  RasterVertex r;
  r.x = snap(window(v.x, frame.width), frame.state);
  r.y = snap(window(v.y, frame.height), frame.state);
  r.z = static_cast<float>(std::clamp((double{v.z} / w + 1) * 0.5, 0.0, 1.0));
  r.w = std::clamp(v.w, 0x1p-20f, 0x1p20f);
  r.uv = v.uv;
  r.color = v.color;
  return r;
}

bool all_inside(const std::array<ClipVertex, 3>& t, const std::array<ClipPlane, 8>& planes) {
  for (const ClipPlane& p : planes)
    for (const ClipVertex& v : t)
      if (p.x * v.x + p.y * v.y + p.z * v.z + p.w * v.w + p.constant < 0) return false;
  return true;
}

}  // namespace

ClipPlacer::ClipPlacer(std::span<const ClipVertex> vertices, const Frame& frame, DrawList& list)
    : vertices_(vertices),
      frame_(frame),
      list_(list),
      planes_(clip_planes(frame.width, frame.height, frame.guard)),
      placed_(vertices.size(), kNotPlaced) {}

std::uint32_t ClipPlacer::add_vertex(const ClipVertex& v) {
  list_.vertices.push_back(raster_vertex(v, frame_));
  return static_cast<std::uint32_t>(list_.vertices.size() - 1);
}

void ClipPlacer::add(const std::array<std::uint32_t, 3>& corners) {
  const std::array<ClipVertex, 3> triangle = {vertices_[corners[0]], vertices_[corners[1]], vertices_[corners[2]]};
  if (all_inside(triangle, planes_)) {
    std::array<std::uint32_t, 3> v{};
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t& id = placed_[corners[k]];
      if (id == kNotPlaced) id = add_vertex(triangle[k]);
      v[k] = id;
    }
    list_.triangles.push_back(v);
    return;
  }
  std::vector<std::uint32_t> v;
  for (const ClipVertex& p : clip_triangle(triangle, planes_)) v.push_back(add_vertex(p));
  for (std::size_t k = 2; k < v.size(); ++k) list_.triangles.push_back({v[0], v[k - 1], v[k]});
}

}  // namespace etalon
