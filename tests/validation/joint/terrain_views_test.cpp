#include "validation/joint/terrain_views.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "core/base/error.h"
#include "core/io/image_file.h"
#include "core/joint/marginal_analysis.h"
#include "core/procedural/alps.h"
#include "raster/cpu_renderer.h"
#include "tests/support/skip.h"
#include "validation/joint/path_gaps.h"
#include "validation/joint/terrain_problem.h"

using namespace etalon;
using namespace etalon::validation;

namespace {

struct Terrain {
  terrain::HeightField field;
  Image image;
};

Terrain alps(int texture_size) {
  procedural::Alps made = procedural::make_alps({.size = 257, .texture_size = texture_size});
  terrain::DemOptions options;
  options.dem_spacing = made.spacing;
  return {terrain::make_height_field(made.dem, options).field, std::move(made.texture)};
}

/// Columns 32 to 526 of all rows, 257² heights; the image as it is.
std::optional<Terrain> davosdorf() {
  const auto dem = test::data_file("davosdorf/davosdorf.tif"), color = test::data_file("davosdorf/davosdorf_color.tif");
  if (!dem || !color) return std::nullopt;
  terrain::DemOptions options;
  options.window = terrain::DemWindow{32, 0, 495};
  options.grid_bits = 8;
  const Image whole = io::read_image(*color);
  Image image(495, 495, kRgb8);
  for (int y = 0; y < 495; ++y)
    for (int x = 0; x < 495; ++x) std::copy_n(whole.texel(x + 32, y), 3, image.texel(x, y));
  return Terrain{terrain::make_height_field(io::read_image(*dem), options).field, std::move(image)};
}

double visible_percent(Renderer& renderer, const terrain::HeightField& field, const terrain::TerrainView& view) {
  const Mesh mesh = full_mesh(field);
  return 100.0 * static_cast<double>(visible_triangles(renderer, mesh, picture_frame(view))) / static_cast<double>(mesh.faces.size());
}

void check_goals(const Terrain& terrain) {
  raster::CpuRenderer exact;
  int near = 0;
  for (const NamedTerrainView& named : terrain_views(exact, terrain.field, 640, 480)) {
    TerrainProblem problem(exact, terrain.field, terrain.image, named.view, {});
    const joint::Problem pairs = problem.problem();
    CHECK(pairs.mesh_bits.size() == 60);
    CHECK(pairs.texture_bits.size() == 32);
    const joint::Path path = joint::marginal_analysis(pairs);
    const joint::AllPairs all = joint::evaluate_all(pairs);
    const PathGaps gaps = path_gaps(path, all, joint::Staircase(pairs, all));
    CAPTURE(named.name);
    CHECK(path.evaluations <= 2 * (60 + 32));
    CHECK(gaps.mean_db <= 0.3);
    CHECK(gaps.max_db <= 1.5);
    near += gaps.max_db <= 1.0;
  }
  CHECK(near >= 4);
}

bool full_suite() { return std::getenv("ETALON_FULL") != nullptr && *std::getenv("ETALON_FULL") != '\0'; }

}  // namespace

TEST_CASE("of the valley's view 8 to 12 % of the triangles reach a pixel, of the overview's most") {
  raster::CpuRenderer exact;
  const terrain::HeightField made = alps(64).field;
  const std::vector<NamedTerrainView> views = terrain_views(exact, made, 640, 480);
  REQUIRE(views.size() == 5);
  CHECK(views[0].name == "valley");
  CHECK(visible_percent(exact, made, views[0].view) >= 8);
  CHECK(visible_percent(exact, made, views[0].view) <= 12);
  CHECK(visible_percent(exact, made, views[1].view) >= 40);
  CHECK(views[1].view == terrain_overview(made, 640, 480).view);
  const std::optional<Terrain> real = davosdorf();
  if (!real) return test::report_skip("the valley's view of davosdorf", "davosdorf is not in $ETALON_DATA");
  const double percent = visible_percent(exact, real->field, terrain_views(exact, real->field, 640, 480)[0].view);
  CHECK(percent >= 8);
  CHECK(percent <= 12);
}

TEST_CASE("a view of nothing is refused") {
  raster::CpuRenderer exact;
  const Terrain made = alps(64);
  terrain::TerrainView away = terrain_overview(made.field, 64, 48).view;
  away.target = {away.eye.x, away.eye.y + 100, away.eye.z + 1000};
  CHECK_THROWS_AS(TerrainProblem(exact, made.field, made.image, away, {}), InputError);
}

TEST_CASE("marginal analysis by slope stays within 0.3 dB in the mean and 1 dB at worst, on five views of two terrains") {
  if (!full_suite()) return test::report_skip("the goals of marginal analysis", "minutes; set ETALON_FULL=1");
  check_goals(alps(1024));
  const std::optional<Terrain> real = davosdorf();
  if (!real) return test::report_skip("the goals of marginal analysis on davosdorf", "davosdorf is not in $ETALON_DATA");
  check_goals(*real);
}
