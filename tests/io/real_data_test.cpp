// The real inputs, where they are on this machine: what their README states must come out of the readers.
#include <doctest/doctest.h>

#include "core/io/image_file.h"
#include "core/io/mesh_file.h"
#include "tests/support/skip.h"

namespace etalon::io {
namespace {

using test::data_file;
using test::report_skip;

TEST_CASE("the head scan: vertices welded over its seams, triangles, one material without texture") {
  const auto path = data_file("lee_perry_smith/LeePerrySmith.glb");
  if (!path) return report_skip("LeePerrySmith.glb", "no $ETALON_DATA/lee_perry_smith");
  const LoadedModel model = read_mesh(*path);
  CHECK(model.mesh.vertex_count() == 8844);
  CHECK(model.mesh.face_count() == 17684);
  CHECK(model.mesh.has_uv);
  CHECK(model.mesh.wedge_count() > model.mesh.vertex_count());
  CHECK(model.mesh.colors.empty());
  REQUIRE(model.materials.size() == 1);
  CHECK(model.materials[0].name == "Material.002");
  CHECK(load_texture(model.materials[0]).empty());
  CHECK(model.notes.empty());
}

TEST_CASE("spot: a seam vertex is one vertex with several wedges; its missing material library is a note") {
  const auto path = data_file("spot/spot_triangulated.obj");
  if (!path) return report_skip("spot", "no $ETALON_DATA/spot");
  const LoadedModel model = read_mesh(*path);
  CHECK(model.mesh.vertex_count() == 2930);
  CHECK(model.mesh.face_count() == 5856);
  CHECK(model.mesh.has_uv);
  CHECK(model.mesh.wedge_count() > model.mesh.vertex_count());
  REQUIRE(model.materials.size() == 1);
  CHECK(model.materials[0].name == "material_1");
  REQUIRE(model.notes.size() == 1);
  CHECK(model.notes[0] == "spot_triangulated.obj:4: material library 'spot_triangulated.mtl' not found");
}

void check_colored_ply(const char* relative, std::size_t vertex_count, std::size_t face_count) {
  const auto path = data_file(relative);
  if (!path) return report_skip(relative, "not in $ETALON_DATA");
  const LoadedModel model = read_mesh(*path);
  CHECK(model.mesh.vertex_count() == vertex_count);
  CHECK(model.mesh.face_count() == face_count);
  CHECK(model.mesh.colors.size() == vertex_count);
  CHECK_FALSE(model.mesh.has_uv);
  CHECK(model.notes.empty());
}

TEST_CASE("the coloured scans") {
  check_colored_ply("lee_perry_smith/lee_perry_smith_283k.ply", 141474, 282944);
  check_colored_ply("milk_carton/milk_carton_grid.ply", 241389, 475306);
  check_colored_ply("knot/knot100k.ply", 50000, 100000);
}

void check_image(const char* relative, int width, int height, PixelFormat format) {
  const auto path = data_file(relative);
  if (!path) return report_skip(relative, "not in $ETALON_DATA");
  const Image image = read_image(*path);
  CHECK(image.width() == width);
  CHECK(image.height() == height);
  CHECK(to_string(image.format()) == to_string(format));
}

TEST_CASE("the real images: sizes and formats") {
  check_image("lee_perry_smith/Map-COL.jpg", 1024, 1024, kRgb8);
  check_image("lee_perry_smith/Infinite-Level_02_Tangent_SmoothUV.jpg", 1024, 1024, kRgb8);
  check_image("spot/spot_texture.png", 1024, 1024, kRgb8);
  check_image("davosdorf/davosdorf.tif", 559, 495, kR32f);
  check_image("davosdorf/davosdorf_color.tif", 559, 495, kRgba8);
}

TEST_CASE("the elevation model: metres between the stated lowest and highest") {
  const auto path = data_file("davosdorf/davosdorf.tif");
  if (!path) return report_skip("davosdorf.tif", "no $ETALON_DATA/davosdorf");
  const Image image = read_image(*path);
  float lo = 1e9f, hi = -1e9f;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const float h = image.channels<float>(x, y)[0];
      lo = h < lo ? h : lo;
      hi = h > hi ? h : hi;
    }
  // 1,535.9 to 2,843.1 m, stated to one decimal.
  CHECK(lo >= 1535.85f);
  CHECK(lo < 1535.95f);
  CHECK(hi >= 2843.05f);
  CHECK(hi < 2843.15f);
}

}  // namespace
}  // namespace etalon::io
