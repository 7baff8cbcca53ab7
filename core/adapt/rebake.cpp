#include "core/adapt/rebake.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/math/nearest_point.h"

namespace etalon::adapt {
namespace {

constexpr std::size_t kQueriesAtOnce = 1024;

}  // namespace

Image rebake_map(Renderer& renderer, const Mesh& full, const TriangleTree& tree, const Mesh& simplified, const RebakeOptions& options) {
  if (!full.has_uv) throw InputError("re-bake: expected a full mesh with texture coordinates, got one without");
  if (options.gutter < 0 || options.gutter > 16) throw InputError(fmt::format("re-bake: gutter: expected 0 to 16, got {}", options.gutter));
  const TexelFaces texels = texel_faces(renderer, simplified, options.width, options.height, options.gutter);
  Image map(options.width, options.height, kRg32f);
  auto* const out = map.channels<float>(0, 0);
  parallel_for_blocks(map.texel_count(), kQueriesAtOnce, [&](std::size_t begin, std::size_t end) {
    std::vector<std::size_t> asked;
    std::vector<Vec3d> points;
    for (std::size_t n = begin; n < end; ++n) {
      const auto columns = static_cast<std::size_t>(options.width);
      out[2 * n] = static_cast<float>((static_cast<double>(n % columns) + 0.5) / options.width);
      out[2 * n + 1] = static_cast<float>((static_cast<double>(n / columns) + 0.5) / options.height);
      if (texels.faces[n] == kNoTriangle) continue;
      const FaceId face(texels.faces[n]);
      const Vec3d &w = texels.weights[n], a = to_double(simplified.position(face, 0)), b = to_double(simplified.position(face, 1)),
                  c = to_double(simplified.position(face, 2));
      asked.push_back(n);
      points.push_back(detail::at_weights({0, 0, 0}, a, b, c, w).point);
    }
    std::vector<SurfacePoint> found(points.size());
    tree.nearest(points, found);
    for (std::size_t k = 0; k < asked.size(); ++k) {
      const SurfacePoint& at = found[k];
      const Vec2d a(full.wedge(at.face, 0).uv), ab = Vec2d(full.wedge(at.face, 1).uv) - a, ac = Vec2d(full.wedge(at.face, 2).uv) - a;
      const Vec2d uv = a + at.weights.y * ab + at.weights.z * ac;
      out[2 * asked[k]] = static_cast<float>(uv.x), out[2 * asked[k] + 1] = static_cast<float>(uv.y);
    }
  });
  return map;
}

}  // namespace etalon::adapt
