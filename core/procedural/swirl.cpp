#include "core/procedural/swirl.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.h"
#include "core/procedural/smooth_math.h"
#include "core/procedural/texture_bytes.h"

namespace etalon::procedural {

namespace {

constexpr double kTurns = 0.4;
constexpr double kFinest = 24;  ///< cells on a side from which a grid follows kTurns without a fold; coarser ones turn less

/// A dome with a saddle in it, so that no direction is straight.
double height(double x, double y) {
  const double dome = (1 - x * x) * (1 - y * y);
  return 0.55 * dome + 0.22 * (x * x - y * y) + 0.12 * x * y * (x - y);
}

/// Turning by an angle that depends on the radius alone keeps areas; `most` is the angle at the centre.
Vec2d swirled(double u, double v, double most) {
  const double du = u - 0.5, dv = v - 0.5;
  const double s = 1 - 4 * (du * du + dv * dv);
  if (s <= 0) return {u, v};
  const double turns = most * s * s;
  const double c = cos_turns(turns), n = sin_turns(turns);
  return {0.5 + (c * du - n * dv), 0.5 + (n * du + c * dv)};
}

Vec3d rainbow(double turn) {
  return {0.5 + 0.5 * cos_turns(turn), 0.5 + 0.5 * cos_turns(turn - 1.0 / 3), 0.5 + 0.5 * cos_turns(turn - 2.0 / 3)};
}

/// Vertical bands of all hues between white and dark lines, crossed by faint ones: what the mesh swirls, the eye can follow.
Vec3d swirl_color(double u, double v) {
  constexpr double kBands = 16;
  const double band = std::floor(u * kBands);
  const double in_band = u * kBands - band;
  const double hue = (band + 0.5) / kBands * 0.9375 + 0.02;
  const bool even = static_cast<int>(band) % 2 == 0;
  Vec3d color = rainbow(hue);
  color = mix(color, even ? Vec3d(1, 1, 1) : Vec3d(0.05, 0.05, 0.2), even ? 0.30 : 0.22);
  color *= 0.86 + 0.14 * cos_turns(v * 8);
  const double cross = std::fabs(v * 16 - std::floor(v * 16 + 0.5)) / 16;
  color = mix(color, Vec3d(1, 1, 1), 0.45 * (1 - smooth_step(0.0012, 0.0026, cross)));
  const double line = std::fmin(in_band, 1 - in_band) / kBands;
  color = mix(color, Vec3d(0.99, 0.99, 0.96), 1 - smooth_step(0.0030, 0.0046, line));
  const double frame = std::fmin(std::fmin(u, 1 - u), std::fmin(v, 1 - v));
  return mix(Vec3d(0.08, 0.08, 0.12), color, smooth_step(0.004, 0.0065, frame));
}

}  // namespace

Model make_swirl(const SwirlOptions& options) {
  if (options.faces < 2 || options.faces > 2'000'000)
    throw InputError(fmt::format("swirl: faces: expected 2 to 2000000, got {}", options.faces));
  if (options.texture_size < 16 || options.texture_size > 8192)
    throw InputError(fmt::format("swirl: texture size: expected 16 to 8192, got {}", options.texture_size));
  const auto n = static_cast<std::uint32_t>(std::fmax(1, std::floor(std::sqrt(options.faces * 0.5) + 0.5)));

  const double most_turns = n < kFinest ? kTurns * n / kFinest : kTurns;

  Model model;
  model.name = "swirl";
  Mesh& mesh = model.mesh;
  mesh.has_uv = true;
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i) {
      const double u = static_cast<double>(i) / n, v = static_cast<double>(j) / n;
      const double x = 2 * u - 1, y = 2 * v - 1;
      const Vec2d uv = swirled(u, v, most_turns);
      mesh.wedges.push_back({VertexId(mesh.positions.size()), Vec2f(uv)});
      mesh.positions.push_back(Vec3f(Vec3d(x, y, height(x, y))));
    }
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 2, d = a + n + 1;
      mesh.faces.push_back({WedgeId(a), WedgeId(b), WedgeId(c)});
      mesh.faces.push_back({WedgeId(a), WedgeId(c), WedgeId(d)});
    }

  const int size = options.texture_size;
  model.texture = Image(size, size, kRgb8);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) store_rgb8(model.texture, x, y, swirl_color((x + 0.5) / size, (y + 0.5) / size));
  return model;
}

}  // namespace etalon::procedural
