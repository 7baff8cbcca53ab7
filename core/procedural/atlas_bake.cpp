#include "core/procedural/atlas_bake.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/procedural/texture_bytes.h"

namespace etalon::procedural {

namespace {

/// Twice the area of (a, b, p).
double area(const Vec2d& a, const Vec2d& b, const Vec2d& p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); }

int first_centre(double x) { return static_cast<int>(std::ceil(x - 0.5)); }
int last_centre(double x) { return static_cast<int>(std::floor(x - 0.5)); }

std::vector<TexelOnFace> texels_on_faces(const Mesh& mesh, int size) {
  std::vector<TexelOnFace> result(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    Vec2d c[3];
    for (int k = 0; k < 3; ++k) c[k] = Vec2d(mesh.wedge(FaceId(f), k).uv) * static_cast<double>(size);
    const double whole = area(c[0], c[1], c[2]);
    if (!(whole > 0)) continue;
    const int y0 = std::max(0, first_centre(std::min({c[0].y, c[1].y, c[2].y})));
    const int y1 = std::min(size - 1, last_centre(std::max({c[0].y, c[1].y, c[2].y})));
    const int x0 = std::max(0, first_centre(std::min({c[0].x, c[1].x, c[2].x})));
    const int x1 = std::min(size - 1, last_centre(std::max({c[0].x, c[1].x, c[2].x})));
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        const Vec2d p(x + 0.5, y + 0.5);
        const double w0 = area(c[1], c[2], p), w1 = area(c[2], c[0], p), w2 = area(c[0], c[1], p);
        if (w0 < 0 || w1 < 0 || w2 < 0) continue;
        TexelOnFace& texel = result[static_cast<std::size_t>(y) * static_cast<std::size_t>(size) + static_cast<std::size_t>(x)];
        if (texel.face.valid()) continue;
        texel = {FaceId(f), {w0 / whole, w1 / whole, w2 / whole}};
      }
  }
  return result;
}

}  // namespace

Image bake_atlas(const Mesh& mesh, int size, int gutter_texel, const Vec3d& background,
                 const std::function<Vec3d(const TexelOnFace&)>& paint) {
  const auto n = static_cast<std::size_t>(size);
  const std::vector<TexelOnFace> texels = texels_on_faces(mesh, size);
  std::vector<Vec3d> colors(n * n, background);
  std::vector<int> ring(n * n, -1);  // -1: not coloured
  parallel_for(n, [&](std::size_t y) {
    for (std::size_t i = y * n; i < (y + 1) * n; ++i)
      if (texels[i].face.valid()) {
        colors[i] = paint(texels[i]);
        ring[i] = 0;
      }
  });
  for (int step = 1; step <= gutter_texel; ++step) {
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        const std::size_t i = static_cast<std::size_t>(y) * n + static_cast<std::size_t>(x);
        if (ring[i] >= 0) continue;
        Vec3d sum(0, 0, 0);
        int count = 0;
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx) {
            if (x + dx < 0 || x + dx >= size || y + dy < 0 || y + dy >= size) continue;
            const std::size_t j = static_cast<std::size_t>(y + dy) * n + static_cast<std::size_t>(x + dx);
            if (ring[j] < 0 || ring[j] >= step) continue;
            sum += colors[j];
            ++count;
          }
        if (count == 0) continue;
        colors[i] = sum * (1.0 / count);
        ring[i] = step;
      }
  }
  Image image(size, size, kRgb8);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) store_rgb8(image, x, y, colors[static_cast<std::size_t>(y) * n + static_cast<std::size_t>(x)]);
  return image;
}

}  // namespace etalon::procedural
