#include "validation/studies/horbelt_maps.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace etalon::validation {
namespace {

constexpr int kSide = 800, kTerrain = 520, kBorder = (kSide - kTerrain) / 2;  // pixels: the viewer may stand outside
using Color = std::array<std::uint8_t, 3>;
constexpr Color kPaper{250, 250, 247}, kEdge{60, 66, 76}, kBlue{30, 90, 220}, kRed{214, 40, 40};

class Map {
 public:
  Map(const terrain::HeightField& field) : picture_(kSide, kSide, kRgb8), metres_(field.steps() * field.spacing) {
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) put(x, y, kPaper);
  }

  /// Row 0 is the lowest, and south has the larger z.
  [[nodiscard]] Vec2d place(double x, double z) const {
    const double scale = kTerrain / metres_;
    return {kSide / 2.0 + x * scale, kSide / 2.0 - z * scale};
  }
  void put(int x, int y, const Color& color) {
    if (x >= 0 && y >= 0 && x < kSide && y < kSide) std::copy_n(color.begin(), 3, picture_.channels<std::uint8_t>(x, y));
  }
  void line(const Vec2d& a, const Vec2d& b, const Color& color, int thickness) {
    const int steps = 1 + static_cast<int>(std::max(std::abs(b.x - a.x), std::abs(b.y - a.y)));
    if (steps > 8 * kSide) return;
    for (int n = 0; n <= steps; ++n) {
      const double t = static_cast<double>(n) / steps;
      const int x = static_cast<int>(std::floor(a.x + (b.x - a.x) * t)), y = static_cast<int>(std::floor(a.y + (b.y - a.y) * t));
      for (int j = 0; j < thickness; ++j)
        for (int i = 0; i < thickness; ++i) put(x + i, y + j, color);
    }
  }
  void ball(const Vec2d& at, int radius, const Color& color) {
    for (int j = -radius; j <= radius; ++j)
      for (int i = -radius; i <= radius; ++i)
        if (i * i + j * j <= radius * radius) put(static_cast<int>(at.x) + i, static_cast<int>(at.y) + j, color);
  }

  /// The borders left and right of what is seen, in the plane of the map, and the viewer.
  void viewer(const terrain::TerrainView& view) {
    const Vec3d forward{view.target.x - view.eye.x, 0, view.target.z - view.eye.z};
    const double length = std::sqrt(forward.x * forward.x + forward.z * forward.z);
    const Vec2d eye = place(view.eye.x, view.eye.z);
    const Vec3d whole{view.target.x - view.eye.x, view.target.y - view.eye.y, view.target.z - view.eye.z};
    const double distance = std::sqrt(whole.x * whole.x + whole.y * whole.y + whole.z * whole.z);
    if (length > 0) {
      // Across the frame's middle row the view is tan_x · distance wide at the target's distance.
      const double tan_x = view.tan_half_fov_y * view.width / view.height, reach = 3 * metres_;
      const double fx = forward.x / length, fz = forward.z / length, along = length / distance;
      for (const double side : {-1.0, 1.0}) {
        const double dx = fx * along - side * fz * tan_x, dz = fz * along + side * fx * tan_x;
        const double unit = std::sqrt(dx * dx + dz * dz);
        line(eye, place(view.eye.x + dx / unit * reach, view.eye.z + dz / unit * reach), kRed, 2);
      }
    }
    ball(eye, 7, kBlue);
  }

  [[nodiscard]] Image take() { return std::move(picture_); }

 private:
  Image picture_;
  double metres_;
};

}  // namespace

Image mesh_from_above(const Mesh& mesh, const terrain::HeightField& field, const terrain::TerrainView& view) {
  Map map(field);
  for (const auto& face : mesh.faces)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3f &a = mesh.positions[mesh.wedges[face[k].index].vertex.index],
                  &b = mesh.positions[mesh.wedges[face[(k + 1) % 3].index].vertex.index];
      map.line(map.place(a.x, a.z), map.place(b.x, b.z), kEdge, 1);
    }
  map.viewer(view);
  return map.take();
}

Image texture_from_above(const Image& texture, const terrain::HeightField& field, const terrain::TerrainView& view) {
  Map map(field);
  const bool is_grey = texture.format().channels < 3;
  for (int y = 0; y < kTerrain; ++y)
    for (int x = 0; x < kTerrain; ++x) {
      const auto* texel =
          texture.channels<std::uint8_t>((2 * x + 1) * texture.width() / (2 * kTerrain), (2 * y + 1) * texture.height() / (2 * kTerrain));
      map.put(kBorder + x, kBorder + y, {texel[0], texel[is_grey ? 0 : 1], texel[is_grey ? 0 : 2]});
    }
  map.viewer(view);
  return map.take();
}

}  // namespace etalon::validation
