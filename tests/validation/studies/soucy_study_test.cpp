#include "validation/studies/soucy_study.h"

#include <doctest/doctest.h>

#include <numeric>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/mesh/range_image.h"
#include "core/procedural/duck.h"
#include "raster/cpu_renderer.h"
#include "validation/report/study_page.h"
#include "validation/studies/soucy_report.h"

using namespace etalon;
using namespace etalon::validation;

namespace {

/// A roof of 32 × 24 samples with a step in it: two slopes that a few triangles hold exactly, up to a little relief.
SoucyScan roof() {
  RangeImage range{.width = 32, .height = 24, .spacing = 0.5, .z = {}};
  for (int j = 0; j < range.height; ++j)
    for (int i = 0; i < range.width; ++i)
      range.z.push_back(20 - 0.25f * static_cast<float>(i < 16 ? 16 - i : i - 16) + 0.01f * static_cast<float>((i * 7 + j * 5) % 4));
  SoucyScan scan{.name = "roof", .mesh = triangulate(range), .grid = {32, 24, 0.5}, .tolerances = {0.02, 0.4}, .unit = "mm", .inputs = {}};
  scan.inputs = {{.name = "roof", .sha256 = std::string(64, '1'), .path = "", .role = "model", .attribution = ""}};
  return scan;
}

SoucyModel duck() {
  SoucyModel model{.name = "duck",
                   .mesh = procedural::make_duck(procedural::duck_of_faces(3'000, false)),
                   .target_faces = 300,
                   .pictured = true,
                   .inputs = {}};
  model.inputs = {{.name = "duck", .sha256 = std::string(64, '2'), .path = "", .role = "model", .attribution = "somebody"}};
  return model;
}

SoucyStudyOptions small() {
  SoucyStudyOptions options;
  options.map_sizes = {64, 32};
  options.model_maps = {64, 128};
  options.views_px = 32, options.view_count = 2, options.picture_px = 48;
  return options;
}

}  // namespace

TEST_CASE("errors against a pattern: only what both cover, own channels, colour edges, both signs") {
  // Two pictures of 18 × 10 texels around 16 × 8 samples; column 8 begins the white square.
  const Image pattern = soucy_pattern(SoucyPattern::chessboard, 16, 8);
  DrawnView original{Image(18, 10, kRgba8), Image(18, 10, kR32ui)}, baked = original;
  for (int y = 0; y < 10; ++y)
    for (int x = 0; x < 18; ++x) *original.id.channels<std::uint32_t>(x, y) = *baked.id.channels<std::uint32_t>(x, y) = kNoTriangle;
  const auto put = [&](int x, int y, std::uint8_t grey) {
    *original.id.channels<std::uint32_t>(x + 1, y + 1) = *baked.id.channels<std::uint32_t>(x + 1, y + 1) = 0;
    for (int c = 0; c < 3; ++c) baked.color.channels<std::uint8_t>(x + 1, y + 1)[c] = grey;
  };
  put(7, 0, 10);                                   // black, touches white
  put(8, 0, 252);                                  // white, touches black
  put(3, 3, 2);                                    // black, inside
  put(0, 0, 0);                                    // exact, at the image's corner: no colour edge
  *original.id.channels<std::uint32_t>(5, 5) = 0;  // covered by one only
  const SoucyError error = measure_pattern_error(original, baked, pattern, SoucyPattern::chessboard);
  CHECK(error.texels == 4);
  CHECK(error.channels == 1);
  CHECK(error.sse == 100 + 9 + 4);
  CHECK(error.edge_texels == 2);
  CHECK(error.edge_sse == 109);
  CHECK(error.mse() == 113.0 / 4);
  CHECK(error.mean_magnitude() == 15.0 / 4);
  CHECK(error.histogram[255 + 10] == 1);
  CHECK(error.histogram[255 - 3] == 1);
  CHECK(error.histogram[255] == 1);
  // The ramp has two channels, and no colour edges.
  const SoucyError ramp = measure_pattern_error(original, baked, soucy_pattern(SoucyPattern::ramp, 16, 8), SoucyPattern::ramp);
  CHECK(ramp.channels == 2);
  CHECK(ramp.edge_texels == 0);
  CHECK(std::accumulate(ramp.histogram.begin(), ramp.histogram.end(), std::uint64_t{0}) == 8);
  CHECK(SoucyError{}.mse() == 0);
}

TEST_CASE("the chessboard of the paper: 44 % of its pixels touch a colour edge") {
  const Image pattern = soucy_pattern(SoucyPattern::chessboard, 256, 256);
  DrawnView all{Image(258, 258, kRgba8), Image(258, 258, kR32ui)};
  const SoucyError error = measure_pattern_error(all, all, pattern, SoucyPattern::chessboard);
  CHECK(error.texels == 65536);
  // A pixel does not where its column is inside its square, or the image's first or last, 194 of 256, and its row likewise.
  CHECK(error.edge_texels == 65536 - 194 * 194);
}

TEST_CASE("range images: every map, means recounted, the undecimated surface shows its samples; the same for any thread count") {
  raster::CpuRenderer exact;
  SoucyStudyOptions options = small();
  int calls = 0, total = 0;
  options.progress = [&](const std::string& label, int done, int all) {
    CHECK(!label.empty());
    CHECK(done == calls++);
    total = all;
  };
  const SoucyStudyResult one = run_soucy_study({roof()}, {duck()}, exact, options);
  CHECK(calls == total);
  REQUIRE(one.scans.size() == 1);
  const SoucyScanResult& scan = one.scans.front();
  CHECK(scan.off_pattern == 0);
  REQUIRE(scan.levels.size() == 2);
  REQUIRE(scan.mappings.size() == 8);
  CHECK(scan.levels[0].faces < scan.faces);
  CHECK(scan.levels[1].faces < scan.levels[0].faces);
  for (const SoucyLevel& level : scan.levels) CHECK(level.distance_max <= level.tolerance);
  for (const SoucyMapping& m : scan.mappings) {
    CAPTURE(to_string(m.pattern));
    CAPTURE(m.map_size);
    CHECK(m.wrong_means == 0);
    CHECK(m.seam_residual == 0);
    // Nearly all samples: those on the rim may be covered by one surface only.
    CHECK(m.error.texels > 31 * 23 - 120);
    CHECK(m.texels.atlas == static_cast<std::uint64_t>(m.map_size * m.map_size));
    CHECK(m.picture.width() == 32);
    CHECK(m.error_picture.height() == 24);
  }
  CHECK(one.models.front().maps.size() == 2);
  CHECK(one.models.front().figure11[5].width() <= 48 + 8);  // cut to what is shown, a margin of eight texels at twice the size
  CHECK(one.models.front().atlas.width() == 64);

  options.progress = {};
  set_thread_count(3);
  const SoucyStudyResult three = run_soucy_study({roof()}, {duck()}, exact, options);
  set_thread_count(0);
  auto a = study_document(soucy_report(one, exact), {}), b = study_document(soucy_report(three, exact), {});
  a.erase("run");
  b.erase("run");
  CHECK(a == b);
}

TEST_CASE("a model: bytes by the formula, vertex colours beside, a wrong texel is noticed") {
  raster::CpuRenderer exact;
  const SoucyStudyResult result = run_soucy_study({}, {duck()}, exact, small());
  const SoucyModelResult& model = result.models.front();
  CHECK(model.bytes == 15 * model.vertices + 13 * model.faces);
  CHECK(model.plain_bytes == 15 * model.baked_vertices + 13 * model.baked_faces);
  for (const SoucyModelMap& map : model.maps) {
    CHECK(map.bytes == 12 * model.baked_vertices + 42 * model.baked_faces + map.png_bytes);
    CHECK(map.sums.texels == 2 * 32 * 32);
    CHECK(map.wrong_means == 0);
    CHECK(map.smallest <= map.largest);
  }
  CHECK(model.maps[1].bytes > model.maps[0].bytes);

  const Mesh mesh = duck().mesh;
  bake::BakeResult baked = bake::bake_scan(mesh, {.target_faces = 300, .width = 64, .height = 64});
  CHECK(wrong_mean_count(mesh, baked) == 0);
  // The corner texel of the first face holds the colour of a vertex that stayed.
  const auto [i, j] = baked.atlas.tiles[0].corner_texel(0);
  const auto [x, y] = baked.atlas.tiles[0].place(i, j);
  baked.texture.channels<std::uint8_t>(x, y)[1] ^= 1;
  CHECK(wrong_mean_count(mesh, baked) == 1);
}

TEST_CASE("the study refuses what it cannot study, and can be stopped") {
  raster::CpuRenderer exact;
  SoucyScan scan = roof();
  scan.tolerances = {0.4, 0.1};
  CHECK_THROWS_WITH_AS((void)run_soucy_study({scan}, {}, exact, small()),
                       "roof: expected tolerances above 0, each larger than the one before, got 0.1", InputError);
  scan.tolerances = {};
  CHECK_THROWS_WITH_AS((void)run_soucy_study({scan}, {}, exact, small()), "roof: expected a tolerance, got none", InputError);
  SoucyModel plain = duck();
  plain.mesh.colors.clear();
  CHECK_THROWS_WITH_AS((void)run_soucy_study({}, {plain}, exact, small()), "duck: expected vertex colours, got none", InputError);
  SoucyStudyOptions tiny = small();
  tiny.map_sizes = {4, 2};
  scan.tolerances = {0.01};
  CHECK_THROWS_AS((void)run_soucy_study({scan}, {}, exact, tiny), InputError);  // bake_scan's own refusal, named
  SoucyStudyOptions stopped = small();
  stopped.progress = [](const std::string&, int done, int) {
    if (done == 2) throw InputError("stopped");
  };
  CHECK_THROWS_AS((void)run_soucy_study({roof()}, {}, exact, stopped), InputError);
}
