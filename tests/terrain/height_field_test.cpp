#include "core/terrain/height_field.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/math/half.h"
#include "tests/support/skip.h"
#include "tests/terrain/terrain_fixture.h"

using namespace etalon;
using namespace etalon::terrain;

namespace {

// Heights 100 + 10x + y at column x, row y.
Image plane_dem(int width, int height) {
  Image dem(width, height, kR32f);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) *dem.channels<float>(x, y) = static_cast<float>(100 + 10 * x + y);
  return dem;
}

std::string error_of(const Image& dem, const DemOptions& options = {}) {
  try {
    (void)make_height_field(dem, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

bool contains(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("height field: 2^k+1 samples are kept as they are, in model space with +Y up and north at -Z") {
  const DemResult result = make_height_field(plane_dem(5, 5), {.dem_spacing = 4});
  const HeightField& field = result.field;
  CHECK(field.bits == 2);
  CHECK(field.spacing == 4);
  CHECK(result.notes.empty());
  CHECK(result.warnings.empty());
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 5; ++i) CHECK(field.height(i, j) == 64 * (100 + 10 * i + j));
  CHECK(field.position(0, 0) == Vec3d(-8, 100, 8));
  CHECK(field.position(4, 1) == Vec3d(8, 141, 4));
  // Sample c of 5 is at (c + ½)/5.
  CHECK(std::fabs(field.uv(1, 4).x - 1.5 / 5) < 1e-15);
  CHECK(std::fabs(field.uv(1, 4).y - 4.5 / 5) < 1e-15);
  validate(field);
}

TEST_CASE("height field: bilinear between samples, corners kept, a plane stays one; the notes say it") {
  const DemResult result = make_height_field(plane_dem(9, 7));  // the middle 7x7, to 5x5: 6 steps become 4
  const HeightField& field = result.field;
  CHECK(field.bits == 2);
  CHECK(field.spacing == 15);
  REQUIRE(result.notes.size() == 2);
  CHECK(contains(result.notes[0], "the 7x7 from column 1 and row 0"));
  CHECK(contains(result.notes[1], "7x7 heights are brought to 5x5 points, 15 m apart"));
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 5; ++i) CHECK(field.height(i, j) * field.unit == 100 + 10 * (1 + 1.5 * i) + 1.5 * j);
  CHECK(std::fabs(field.uv(4, 0).x - 6.5 / 7) < 1e-15);
  CHECK(std::fabs(field.uv(2, 0).x - 3.5 / 7) < 1e-15);
  const HeightField finer = make_height_field(plane_dem(9, 7), {.window = DemWindow{0, 2, 5}, .grid_bits = 4}).field;
  CHECK(finer.side() == 17);
  CHECK(finer.spacing == 2.5);
  CHECK(finer.height(16, 16) == 64 * (100 + 40 + 6));
  CHECK(finer.height(3, 1) == 64 * (100 + 7.5 + 2.25));
}

TEST_CASE("height field: half, 16 and 8 bit heights; those of 8 bits are warned of") {
  Image half(5, 5, {ChannelType::half, 1});
  Image wide(5, 5, {ChannelType::unorm16, 1});
  Image narrow(5, 5, {ChannelType::unorm8, 1});
  *half.channels<std::uint16_t>(4, 3) = half_nearest_even(-12.5);
  *wide.channels<std::uint16_t>(4, 3) = 4000;
  *narrow.channels<std::uint8_t>(4, 3) = 200;
  CHECK(make_height_field(half).field.height(4, 3) == -800);
  CHECK(make_height_field(wide, {.sample_scale = 0.125, .sample_offset = -100}).field.height(4, 3) == 64 * 400);
  CHECK(make_height_field(wide).warnings.empty());
  const DemResult terraces = make_height_field(narrow, {.sample_scale = 5});
  CHECK(terraces.field.height(4, 3) == 64000);
  REQUIRE(terraces.warnings.size() == 1);
  CHECK(contains(terraces.warnings[0], "heights of 8 bits: steps of 5 m"));
}

TEST_CASE("height field: holes, and what is no DEM, are refused with place and number") {
  Image dem = plane_dem(6, 5);
  *dem.channels<float>(2, 1) = std::numeric_limits<float>::quiet_NaN();
  CHECK(contains(error_of(dem), "1 of 25 heights are no number, or no data"));
  CHECK(contains(error_of(dem), "nan first at column 2, row 1"));
  for (const float hole : {-9999.0f, -32768.0f, 3.4e38f, -std::numeric_limits<float>::infinity()}) {
    *dem.channels<float>(2, 1) = hole;
    *dem.channels<float>(4, 4) = hole;
    CHECK(contains(error_of(dem), "2 of 25"));
    *dem.channels<float>(4, 4) = 0;
  }
  CHECK(error_of(dem, {.window = DemWindow{1, 0, 5}}) != "none");
  *dem.channels<float>(2, 1) = 0;
  *dem.channels<float>(0, 0) = -9999;  // outside the window
  CHECK(error_of(dem, {.window = DemWindow{1, 0, 5}}) == "none");

  CHECK(contains(error_of(Image()), "got none"));
  CHECK(contains(error_of(Image(9, 9, kRgb8)), "expected one channel"));
  CHECK(contains(error_of(Image(9, 9, kR32ui)), "expected one channel"));
  CHECK(contains(error_of(Image(4, 9, kR32f)), "at least 5x5"));
  CHECK(contains(error_of(Image(9, 9, kR32f), {.window = DemWindow{5, 0, 5}}), "expected inside 9x9"));
  CHECK(contains(error_of(Image(9, 9, kR32f), {.window = DemWindow{0, -1, 5}}), "expected inside 9x9"));
  CHECK(contains(error_of(Image(9, 9, kR32f), {.window = DemWindow{0, 0, 0}}), "expected inside 9x9"));
  CHECK(contains(error_of(Image(9, 9, kR32f), {.grid_bits = 13}), "k 2 to 12, got 13"));
  CHECK(contains(error_of(Image(9, 9, kR32f), {.grid_bits = 1}), "k 2 to 12, got 1"));
  CHECK(contains(error_of(Image(9, 9, kR32f), {.dem_spacing = 0}), "2^-20 to 2^20 m, got 0"));
  CHECK(contains(error_of(Image(9, 9, kR32f), {.unit = -1}), "2^-20 to 2^20 m"));
  CHECK(contains(error_of(Image(9, 9, kR32f), {.sample_scale = std::numeric_limits<double>::infinity()}), "finite scale"));
  CHECK(contains(error_of(plane_dem(5, 5), {.unit = 0x1p-20}), "less than 2^24 units"));
  CHECK(contains(error_of(plane_dem(9, 9), {.grid_bits = 12, .dem_spacing = 0x1p-20}), "points 2^-20 to 2^20 m apart"));
}

TEST_CASE("height field: validate convicts each broken number; with_unit rounds half to even") {
  HeightField good = test::random_field(2, 100, 1);
  validate(good);
  HeightField bad = good;
  bad.bits = 13;
  CHECK_THROWS_AS(validate(bad), InputError);
  bad = good, bad.heights.pop_back();
  CHECK_THROWS_AS(validate(bad), InputError);
  bad = good, bad.heights[3] = kMaxHeight;
  CHECK_THROWS_AS(validate(bad), InputError);
  bad = good, bad.spacing = 0;
  CHECK_THROWS_AS(validate(bad), InputError);
  bad = good, bad.unit = 0x1p21;
  CHECK_THROWS_AS(validate(bad), InputError);
  bad = good, bad.uv_step = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(validate(bad), InputError);

  good.heights[0] = 32, good.heights[1] = 96, good.heights[2] = 97;
  const HeightField coarse = with_unit(good, 1);
  CHECK(coarse.unit == 1);
  CHECK(coarse.heights[0] == 0);  // half a metre
  CHECK(coarse.heights[1] == 2);  // one and a half
  CHECK(coarse.heights[2] == 2);
  CHECK_THROWS_AS((void)with_unit(good, 0), InputError);
}

TEST_CASE("height field: davosdorf in the window of the studies") {
  const auto field = test::davosdorf();
  if (!field) return test::report_skip("davosdorf as a height field", "davosdorf/davosdorf.tif is not there");
  CHECK(field->side() == 257);
  CHECK(field->spacing == 4940.0 / 256);
  CHECK(std::fabs(field->uv(256, 0).x - 494.5 / 495) < 1e-12);
}
