#include "validation/studies/surface_shading.h"

#include <cmath>

#include "core/base/error.h"
#include "core/math/nearest_point.h"

namespace etalon::validation {
namespace {

Vec3d area_vector(const Mesh& mesh, FaceId f) {
  return cross_product(difference_of(mesh.position(f, 0), mesh.position(f, 1)), difference_of(mesh.position(f, 0), mesh.position(f, 2)));
}

Vec4f grey(const Vec3d& normal, const Vec3d& to_lamp) {
  const double lengths = std::sqrt(dot_product(normal, normal)) * std::sqrt(dot_product(to_lamp, to_lamp));
  const double cosine = lengths > 0 ? dot_product(normal, to_lamp) / lengths : 0;
  const auto value = static_cast<float>(0.25 + 0.75 * (cosine > 0 ? cosine : 0));
  return {value, value, value, 1};
}

}  // namespace

Mesh flat_shaded(const Mesh& mesh, const Vec3d& to_lamp) {
  Mesh result;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    const Vec4f color = grey(area_vector(mesh, FaceId(f)), to_lamp);
    for (int c = 0; c < 3; ++c) {
      result.wedges.push_back({VertexId(result.positions.size()), {0, 0}});
      result.positions.push_back(mesh.position(FaceId(f), c));
      result.colors.push_back(color);
    }
    result.faces.push_back({WedgeId(3 * f), WedgeId(3 * f + 1), WedgeId(3 * f + 2)});
  }
  return result;
}

Mesh smooth_shaded(const Mesh& mesh, const Vec3d& to_lamp) {
  std::vector<Vec3d> normals(mesh.vertex_count(), Vec3d(0, 0, 0));
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    const Vec3d area = area_vector(mesh, FaceId(f));
    for (int c = 0; c < 3; ++c) normals[mesh.vertex(FaceId(f), c).index] = normals[mesh.vertex(FaceId(f), c).index] + area;
  }
  Mesh result = mesh;
  result.has_uv = false;
  result.face_materials.clear();
  result.colors.clear();
  for (const Vec3d& normal : normals) result.colors.push_back(grey(normal, to_lamp));
  return result;
}

Image multiplied(const Image& color, const Image& light) {
  ETALON_CHECK(color.format() == kRgb8 && light.format() == kRgb8 && color.width() == light.width() && color.height() == light.height(),
               "RGB pictures of one size");
  Image result(color.width(), color.height(), kRgb8);
  for (int y = 0; y < color.height(); ++y)
    for (int x = 0; x < color.width(); ++x)
      for (int c = 0; c < 3; ++c)
        result.channels<std::uint8_t>(x, y)[c] =
            static_cast<std::uint8_t>((2 * color.channels<std::uint8_t>(x, y)[c] * light.channels<std::uint8_t>(x, y)[c] + 255) / 510);
  return result;
}

}  // namespace etalon::validation
