#include "tests/terrain/terrain_fixture.h"

#include <cmath>

#include "core/base/rng.h"
#include "core/io/image_file.h"
#include "core/procedural/noise.h"
#include "tests/support/skip.h"

namespace etalon::test {

using terrain::HeightField;

namespace {

HeightField empty_field(int bits) {
  HeightField field;
  field.bits = bits;
  field.spacing = 20;
  field.uv_start = 0.5 / field.side();
  field.uv_step = 1.0 / field.side();
  field.heights.resize(field.point_count());
  return field;
}

}  // namespace

HeightField rough_field(int bits, std::uint64_t seed) {
  HeightField field = empty_field(bits);
  for (int j = 0; j < field.side(); ++j)
    for (int i = 0; i < field.side(); ++i) {
      const Vec3d p{3.0 * i / field.steps(), 3.0 * j / field.steps(), 0};
      const double ridge = 1 - std::fabs(procedural::fractal_noise(p, 6, seed));
      const double calm = procedural::value_noise(p, seed + 1);
      field.heights[field.index(i, j)] = static_cast<std::int32_t>(std::nearbyint(300 * ridge * (1 + calm) / field.unit));
    }
  return field;
}

HeightField random_field(int bits, std::int32_t range, std::uint64_t seed) {
  HeightField field = empty_field(bits);
  Rng rng(seed);
  for (std::int32_t& h : field.heights) h = static_cast<std::int32_t>(rng.between(-range, range));
  return field;
}

terrain::TerrainView low_view(const HeightField& field) {
  const double half = field.steps() / 2 * field.spacing;
  terrain::TerrainView view;
  view.eye = {-half, 0.35 * half + 300, half};
  view.target = {-0.2 * half, 0, 0.2 * half};
  view.tan_half_fov_y = 0.3;
  view.near = field.spacing;
  view.far = 3 * half;
  return view;
}

std::optional<HeightField> davosdorf(int grid_bits) {
  const auto path = data_file("davosdorf/davosdorf.tif");
  if (!path) return std::nullopt;
  return terrain::make_height_field(io::read_image(*path), {.window = terrain::DemWindow{32, 0, 495}, .grid_bits = grid_bits}).field;
}

}  // namespace etalon::test
