#include "validation/studies/chen_examples.h"

#include <algorithm>
#include <cmath>

#include "core/adapt/adapt_map.h"
#include "core/adapt/analytic_map.h"
#include "core/adapt/collapse_ring.h"
#include "core/adapt/ring_cells.h"
#include "core/adapt/texel_faces.h"
#include "core/base/error.h"
#include "core/math/nearest_point.h"
#include "core/progressive/progressive_mesh.h"

namespace etalon::validation {
namespace {

constexpr float kHalfRoot3 = 0.8660254f;  // √3/2 rounded
constexpr double kWidth = 2;              // of the hexagon

// Texture coordinates of the corners are their places; those of the two inside are not.
Mesh hexagon() {
  const std::vector<Vec2f> places = {
      {1, 0}, {0.5f, kHalfRoot3}, {-0.5f, kHalfRoot3}, {-1, 0}, {-0.5f, -kHalfRoot3}, {0.5f, -kHalfRoot3}, {-0.4f, 0.1f}, {0.45f, -0.1f}};
  const std::vector<Vec2f> inside_uv = {{-0.12f, -0.35f}, {0.25f, 0.38f}};
  Mesh mesh;
  mesh.has_uv = true;
  for (std::uint32_t v = 0; v < places.size(); ++v) {
    mesh.positions.push_back({places[v].x, places[v].y, 0});
    const Vec2f& at = v < 6 ? places[v] : inside_uv[v - 6];
    mesh.wedges.push_back({VertexId(v), {0.5f + 0.48f * at.x, 0.5f + 0.48f * at.y}});
  }
  const std::array<std::uint32_t, 3> faces[] = {{7, 0, 1}, {7, 1, 2}, {7, 2, 6}, {6, 2, 3}, {6, 3, 4}, {6, 4, 5}, {6, 5, 7}, {7, 5, 0}};
  for (const auto& f : faces) mesh.faces.push_back({WedgeId(f[0]), WedgeId(f[1]), WedgeId(f[2])});
  return mesh;
}

Vec3d place(const Mesh& mesh, FaceId face, const Vec3d& weights) {
  return detail::at_weights({0, 0, 0}, to_double(mesh.position(face, 0)), to_double(mesh.position(face, 1)),
                            to_double(mesh.position(face, 2)), weights)
      .point;
}

// Rings around a point off the middle, in two colours on each half.
void paint(const Vec3d& p, std::uint8_t* rgb) {
  const double dx = p.x - 0.05, dy = p.y - 0.02, r = std::sqrt(dx * dx + dy * dy);
  const bool light = static_cast<int>(r * 9) % 2 == 0, right = dx > 0.35 * dy, upper = dy > -0.35 * dx;
  const std::uint8_t colors[4][3] = {{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}};
  const auto& color = colors[(right ? 1 : 0) + (upper ? 2 : 0)];
  for (int k = 0; k < 3; ++k) rgb[k] = light ? static_cast<std::uint8_t>(247 - 4 * k) : color[k];
}

Image painted(Renderer& renderer, const Mesh& mesh, int size) {
  const adapt::TexelFaces texels = adapt::texel_faces(renderer, mesh, size, size, 4);
  Image texture(size, size, kRgb8);
  auto* const bytes = texture.channels<std::uint8_t>(0, 0);
  for (std::size_t n = 0; n < texture.texel_count(); ++n) {
    if (texels.faces[n] == kNoTriangle) {
      std::fill_n(bytes + 3 * n, 3, std::uint8_t{214});
    } else {
      paint(place(mesh, FaceId(texels.faces[n]), texels.weights[n]), bytes + 3 * n);
    }
  }
  return texture;
}

// Where a texture coordinate of a mesh is in space: of the face that holds it.
std::optional<Vec3d> place_of(const Mesh& mesh, const Vec2d& p) {
  const auto cross = [](const Vec2d& a, const Vec2d& b) { return a.x * b.y - a.y * b.x; };
  double best = -0x1p-20;  // on an edge rounding may leave p outside of both its faces; those are 2^-24 across
  std::optional<Vec3d> found;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const FaceId face(f);
    const Vec2d a(mesh.wedge(face, 0).uv), ab = Vec2d(mesh.wedge(face, 1).uv) - a, ac = Vec2d(mesh.wedge(face, 2).uv) - a;
    const double area = cross(ab, ac), v = cross(p - a, ac) / area, w = cross(ab, p - a) / area, least = std::min({1 - v - w, v, w});
    if (least <= best) continue;
    best = least;
    found = place(mesh, face, {1 - v - w, v, w});
  }
  return found;
}

double farthest_of(const Mesh& coarse, const Mesh& fine, const adapt::AdaptSequence& sequence, std::size_t level) {
  constexpr int kAlong = 256;
  double farthest2 = 0;
  for (int y = 0; y < kAlong; ++y)
    for (int x = 0; x < kAlong; ++x) {
      const Vec2d p((x + 0.5) / kAlong, (y + 0.5) / kAlong);
      const std::optional<Vec3d> here = place_of(coarse, p), shown = place_of(fine, sequence.follow(p, level, sequence.size()));
      if (here && shown) farthest2 = std::max(farthest2, squared_distance(*here, *shown));
    }
  return std::sqrt(farthest2) / kWidth;
}

}  // namespace

ChenLineExample line_example() {
  ChenLineExample line;
  const auto up = [](const Vec2d& p) { return Vec3f(Vec3d(p.x, p.y, 0)); };
  adapt::CollapseRing ring;
  ring.on_curve = true;
  ring.position_of_u = up(line.c), ring.uv_of_u = {static_cast<float>(line.c_before), 0};
  // The line is the border of a strip: between A and B a third corner.
  ring.positions = {up(line.b), {0.5f, 2, 0}, up(line.a)};
  ring.uv = {{1, 0}, {0.5f, 1}, {0, 0}};
  const auto cells = adapt::make_ring_cells(ring);
  ETALON_CHECK(cells.has_value(), "the line of Figure 1 has cells");
  line.c_after = static_cast<double>(cells->nodes.front().after.x);
  return line;
}

ChenPlaneExample plane_example(Renderer& renderer, int texture_px) {
  const Mesh mesh = hexagon();
  simplify::SimplifyOptions options;
  options.metric = simplify::MetricName::qem5, options.target_faces = 4;
  for (std::uint32_t v = 0; v < 6; ++v) options.locked.push_back(VertexId(v));
  progressive::ProgressiveMesh levels(progressive::make_progressive(mesh, options).data);
  const adapt::AdaptSequence sequence(levels);
  ETALON_CHECK(sequence.size() == 2, "two vertices go");
  ChenPlaneExample example;
  for (std::size_t n = 0; n < 2; ++n)
    for (const adapt::ChartCells& chart : sequence.split(n))
      example.damped += chart.status != adapt::CellStatus::made || chart.cells.u_kept < 1 || chart.cells.crossings_kept < 1;
  Image texture = painted(renderer, mesh, texture_px);
  example.texture = std::make_shared<const Image>(texture);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t level = 2 - i;
    levels.go_to(level);
    if (i > 0) (void)adapt::adapt_map(renderer, sequence, level + 1, level, texture);
    example.levels[i].mesh = levels.mesh();
    example.levels[i].adapted = std::make_shared<const Image>(texture);
    example.levels[i].analytic = std::make_shared<const Image>(adapt::analytic_map(sequence, level, texture_px, texture_px));
    example.levels[i].farthest = farthest_of(example.levels[i].mesh, mesh, sequence, level);
  }
  return example;
}

}  // namespace etalon::validation
