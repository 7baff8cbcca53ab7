#include "validation/studies/normal_texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/adapt/texel_faces.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/math/nearest_point.h"

namespace etalon::validation {
namespace {

Vec3d scaled(const Vec3d& a, double s) { return {a.x * s, a.y * s, a.z * s}; }
Vec3d sum(const Vec3d& a, const Vec3d& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec3d unit(const Vec3d& a, const Vec3d& otherwise) {
  const double length2 = dot_product(a, a);
  return length2 > 0 ? scaled(a, 1 / std::sqrt(length2)) : otherwise;
}

struct Frames {
  std::vector<Vec3d> normals;           ///< #V
  std::vector<Vec3d> along_u, along_v;  ///< #W
};

// Normals by vertex, directions of u and v by wedge: sums over faces, in face order.
Frames frames_of(const Mesh& mesh) {
  Frames frames{std::vector<Vec3d>(mesh.vertex_count(), {0, 0, 0}), std::vector<Vec3d>(mesh.wedge_count(), {0, 0, 0}), {}};
  frames.along_v = frames.along_u;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const FaceId face(f);
    const Vec3d ab = difference_of(mesh.position(face, 0), mesh.position(face, 1)),
                ac = difference_of(mesh.position(face, 0), mesh.position(face, 2));
    const Vec3d normal = cross_product(ab, ac);
    const Vec2d a(mesh.wedge(face, 0).uv), p = Vec2d(mesh.wedge(face, 1).uv) - a, q = Vec2d(mesh.wedge(face, 2).uv) - a;
    const double sign = p.x * q.y - p.y * q.x < 0 ? -1 : 1;
    const Vec3d u = scaled(sum(scaled(ab, q.y), scaled(ac, -p.y)), sign), v = scaled(sum(scaled(ac, p.x), scaled(ab, -q.x)), sign);
    for (int k = 0; k < 3; ++k) {
      Vec3d& n = frames.normals[mesh.vertex(face, k).index];
      n = sum(n, normal);
      Vec3d &du = frames.along_u[mesh.faces[f][static_cast<std::size_t>(k)].index],
            &dv = frames.along_v[mesh.faces[f][static_cast<std::size_t>(k)].index];
      du = sum(du, u), dv = sum(dv, v);
    }
  }
  return frames;
}

}  // namespace

Image object_normals(Renderer& renderer, const Mesh& mesh, const Image* tangent, int size) {
  if (tangent != nullptr && (tangent->format().type != ChannelType::unorm8 || tangent->format().channels < 3))
    throw InputError(fmt::format("normal map: expected RGB or RGBA unorm8, got {}", to_string(tangent->format())));
  const int width = tangent != nullptr ? tangent->width() : size, height = tangent != nullptr ? tangent->height() : size;
  constexpr int kGutter = 4;
  const adapt::TexelFaces texels = adapt::texel_faces(renderer, mesh, width, height, kGutter);
  const Frames frames = frames_of(mesh);
  Image result(width, height, kRgb8);
  parallel_for(static_cast<std::size_t>(height), [&](std::size_t row) {
    for (int x = 0; x < width; ++x) {
      const int y = static_cast<int>(row);
      const std::size_t n = row * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      Vec3d normal(0, 0, 1);
      if (texels.faces[n] != kNoTriangle) {
        const FaceId face(texels.faces[n]);
        const Vec3d& w = texels.weights[n];
        const double weight[3] = {w.x, w.y, w.z};
        Vec3d across(0, 0, 0), along_u(0, 0, 0), along_v(0, 0, 0);
        for (int k = 0; k < 3; ++k) {
          across = sum(across, scaled(unit(frames.normals[mesh.vertex(face, k).index], {0, 0, 0}), weight[k]));
          along_u =
              sum(along_u, scaled(unit(frames.along_u[mesh.faces[face.index][static_cast<std::size_t>(k)].index], {0, 0, 0}), weight[k]));
          along_v =
              sum(along_v, scaled(unit(frames.along_v[mesh.faces[face.index][static_cast<std::size_t>(k)].index], {0, 0, 0}), weight[k]));
        }
        normal = unit(across, {0, 0, 1});
        if (tangent != nullptr) {
          const auto* const t = tangent->channels<std::uint8_t>(x, y);
          const Vec3d u = unit(sum(along_u, scaled(normal, -dot_product(along_u, normal))), {0, 0, 0});
          const Vec3d v = unit(sum(along_v, scaled(normal, -dot_product(along_v, normal))), {0, 0, 0});
          const double a = t[0] / 127.5 - 1, b = t[1] / 127.5 - 1, c = t[2] / 127.5 - 1;
          normal = unit(sum(sum(scaled(u, a), scaled(v, b)), scaled(normal, c)), normal);
        }
      }
      auto* const out = result.channels<std::uint8_t>(x, y);
      for (int k = 0; k < 3; ++k)
        out[k] = static_cast<std::uint8_t>(std::floor(std::clamp((k == 0   ? normal.x
                                                                  : k == 1 ? normal.y
                                                                           : normal.z) *
                                                                         0.5 +
                                                                     0.5,
                                                                 0.0, 1.0) *
                                                          255 +
                                                      0.5));
    }
  });
  return result;
}

Image lit_by_normals(const Image& drawn_normals, const Vec3d& toward_light) {
  Image result = drawn_normals;
  const Vec3d light = unit(toward_light, {0, 0, 1});
  for (int y = 0; y < result.height(); ++y)
    for (int x = 0; x < result.width(); ++x) {
      auto* const c = result.channels<std::uint8_t>(x, y);
      const Vec3d n = unit({c[0] / 127.5 - 1, c[1] / 127.5 - 1, c[2] / 127.5 - 1}, {0, 0, 0});
      const double facing = dot_product(n, light), shade = 0.16 + 0.12 * (0.5 + 0.5 * n.y) + 0.72 * std::max(facing, 0.0);
      for (int k = 0; k < 3; ++k) c[k] = static_cast<std::uint8_t>(std::floor(std::min(shade, 1.0) * (k == 2 ? 240 : 250) + 0.5));
    }
  return result;
}

}  // namespace etalon::validation
