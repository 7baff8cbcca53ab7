#include "core/adapt/texel_faces.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/draw/scene.h"

namespace etalon::adapt {
namespace {

double cross(const Vec2d& a, const Vec2d& b) { return a.x * b.y - a.y * b.x; }

Vec3d weights_at(const Mesh& mesh, FaceId face, const Vec2d& p) {
  const Vec2d a(mesh.wedge(face, 0).uv), ab = Vec2d(mesh.wedge(face, 1).uv) - a, ac = Vec2d(mesh.wedge(face, 2).uv) - a, ap = p - a;
  const double area = cross(ab, ac);
  if (area == 0) return {1.0 / 3, 1.0 / 3, 1.0 / 3};
  const double v = cross(ap, ac) / area, w = cross(ab, ap) / area;
  return {1 - v - w, v, w};
}

bool is_far(const Vec3d& weights) {
  return std::min({weights.x, weights.y, weights.z}) < -1 || std::max({weights.x, weights.y, weights.z}) > 2;
}

}  // namespace

TexelFaces texel_faces(Renderer& renderer, const Mesh& mesh, int width, int height, int gutter) {
  if (!mesh.has_uv) throw InputError("texels of faces: expected a mesh with texture coordinates, got one without");
  Frame frame{.width = width, .height = height, .guard = 2048, .state = {}, .targets = {{}}};
  frame.state.depth_test = false;
  frame.state = renderer.supported_state(frame.state);
  frame.targets[0].content = TargetContent::triangle_id, frame.targets[0].format = kR32ui;
  Mesh plain = mesh;
  plain.face_materials.clear();
  const Image ids = renderer.render(make_uv_scene(plain, {Material{}}, frame), frame).front();
  const auto* const id = ids.channels<std::uint32_t>(0, 0);
  TexelFaces result{width, height, {}, {}};
  result.faces.assign(id, id + ids.texel_count());
  result.weights.resize(ids.texel_count());
  parallel_for(static_cast<std::size_t>(height), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    const auto index = [&](int i, int j) {
      return static_cast<std::size_t>(j) * static_cast<std::size_t>(width) + static_cast<std::size_t>(i);
    };
    const auto centre = [&](int i, int j) { return Vec2d((i + 0.5) / width, (j + 0.5) / height); };
    for (int x = 0; x < width; ++x) {
      const std::size_t n = index(x, y);
      if (id[n] != kNoTriangle) {
        result.weights[n] = weights_at(mesh, FaceId(id[n]), centre(x, y));
        continue;
      }
      int nearest = 2 * gutter * gutter + 1, near_x = 0, near_y = 0;
      for (int j = std::max(0, y - gutter); j <= std::min(height - 1, y + gutter); ++j)
        for (int i = std::max(0, x - gutter); i <= std::min(width - 1, x + gutter); ++i) {
          const int distance2 = (i - x) * (i - x) + (j - y) * (j - y);
          if (id[index(i, j)] != kNoTriangle && distance2 < nearest) nearest = distance2, near_x = i, near_y = j;
        }
      if (nearest > 2 * gutter * gutter) continue;
      const FaceId face(id[index(near_x, near_y)]);
      result.faces[n] = face.index;
      result.weights[n] = weights_at(mesh, face, centre(x, y));
      if (is_far(result.weights[n])) result.weights[n] = weights_at(mesh, face, centre(near_x, near_y));
    }
  });
  return result;
}

}  // namespace etalon::adapt
