#include "core/procedural/range_scan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <string>

#include <doctest/doctest.h>

#include "core/base/parallel.h"
#include "core/base/sha256.h"
#include "core/mesh/mesh_validation.h"
#include "core/procedural/test_images.h"
#include "tests/procedural/mesh_sha256.h"

using namespace etalon;
using namespace etalon::procedural;

namespace {

/// The step of a sample as a file of 16 bits would hold it, 0 for none: NaNs have many bit patterns.
std::vector<std::uint16_t> steps_of(const RangeImage& range) {
  std::vector<std::uint16_t> steps;
  for (const float z : range.z) steps.push_back(std::isfinite(z) ? static_cast<std::uint16_t>(z / kRangeStep) : std::uint16_t{0});
  return steps;
}

std::string range_sha256(const RangeImage& range) {
  const std::vector<std::uint16_t> steps = steps_of(range);
  return sha256_hex(std::as_bytes(std::span(steps)));
}

const RangeImage& scan(RangeKind kind) {
  static std::map<RangeKind, RangeImage> made;
  const auto it = made.find(kind);
  return it != made.end() ? it->second : made.emplace(kind, make_range_scan(kind)).first->second;
}

/// Least and greatest row or column with a sample, in samples.
struct Extent {
  int lo = 256, hi = -1;
  void add(int i) {
    lo = std::min(lo, i);
    hi = std::max(hi, i);
  }
};

}  // namespace

TEST_CASE("five objects of 15 to 20 cm in 256 × 256 samples, none at the rim") {
  REQUIRE(range_kinds().size() == 5);
  for (const RangeKind kind : range_kinds()) {
    CAPTURE(range_name(kind));
    const RangeImage& range = scan(kind);
    CHECK(range.width == 256);
    CHECK(range.height == 256);
    REQUIRE(range.z.size() == 256 * 256);
    Extent x, y;
    for (int j = 0; j < 256; ++j)
      for (int i = 0; i < 256; ++i) {
        const float z = range.at(i, j);
        if (!std::isfinite(z)) continue;
        x.add(i);
        y.add(j);
        REQUIRE(z > 0);
        REQUIRE(z < 128);
        REQUIRE(std::fmod(z, kRangeStep) == 0);
      }
    const double longest = std::max(x.hi - x.lo + 1, y.hi - y.lo + 1) * range.spacing;
    CHECK(longest >= 150);
    CHECK(longest <= 200);
    CHECK(std::min(x.lo, y.lo) > 0);
    CHECK(std::max(x.hi, y.hi) < 255);
    CHECK(sample_count(range) > 256 * 256 / 8);
  }
}

TEST_CASE("a scan has what a scan of a thing has: jumps between parts, smooth parts, noise") {
  for (const RangeKind kind : range_kinds()) {
    CAPTURE(range_name(kind));
    const RangeImage& range = scan(kind);
    const Mesh cut = triangulate(range), joined = triangulate(range, {}, {.max_jump = std::numeric_limits<double>::infinity()});
    CHECK(joined.face_count() - cut.face_count() >= 200);  // jumps inside the silhouette
    CHECK(cut.face_count() > 20'000);
    const MeshReport report = validate_mesh(cut);
    CHECK(report.non_manifold_edges.count == 0);
    CHECK(report.oriented());
    CHECK(report.degenerate_faces.count == 0);
    // Second differences along rows: on a smooth part these are noise alone, of 0.03·√6 = 0.073 mm. The median of |normal| is 0.674 of its
    // deviation: 0.05 mm; curvature adds to it.
    std::vector<double> bends;
    for (int j = 0; j < 256; ++j)
      for (int i = 1; i < 255; ++i) {
        const double bend = double{range.at(i - 1, j)} - 2.0 * range.at(i, j) + range.at(i + 1, j);
        if (std::isfinite(bend)) bends.push_back(std::fabs(bend));
      }
    const auto middle = bends.begin() + static_cast<std::ptrdiff_t>(bends.size() / 2);
    std::nth_element(bends.begin(), middle, bends.end());
    CHECK(*middle > 0.04);
    CHECK(*middle < 4 * 0.073);  // half of it is smooth
  }
}

TEST_CASE("the scans' bytes, for any thread count") {
  const std::map<std::string_view, std::string> kGolden = {
      {"shuttle", "f04d55d4d33efaee8745a388c9c67493f0674e395b737cc78a5472c9be28afa1"},
      {"hand", "b0ee9e6ec316f63b42b90c628ccd9c84b5d43819ec9fec3f8a30512b68e44b5e"},
      {"soldier", "9d0550d45244a4fe35f47231c5617b45fd5a4a531f3530ac830176e4deab7a01"},
      {"teapot", "4980239ea2b7892f77ca3d18820ba99189149ef23c613d6f6774ba4ae56ac93b"},
      {"telephone", "1f5f0105d9a5725bf83c38bbed70cfc50ece74421b3f18a2e4d6063570b770e3"}};
  for (const RangeKind kind : range_kinds()) {
    CAPTURE(range_name(kind));
    CHECK(range_sha256(scan(kind)) == kGolden.at(range_name(kind)));
  }
  for (const int threads : {1, 3}) {
    set_thread_count(threads);
    CHECK(range_sha256(make_range_scan(RangeKind::shuttle)) == kGolden.at("shuttle"));
    set_thread_count(0);
  }
}

TEST_CASE("a scan's mesh in its bytes") {
  CHECK(test::mesh_sha256(triangulate(scan(RangeKind::telephone))) == "f91a608ca057a4426d79535fa4c6b558ae330a9ac41a1467daf157548a41f17a");
}

TEST_CASE("the chessboard: squares of 8 pixels, black first") {
  const Image board = make_chessboard();
  CHECK(board.format() == kRgb8);
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x)
      for (int k = 0; k < 3; ++k) REQUIRE(board.channels<std::uint8_t>(x, y)[k] == (((x >> 3) ^ (y >> 3)) & 1) * 255);
  CHECK(make_chessboard(9, 1).width() == 9);
}

TEST_CASE("the ramp: red is the column, green the row") {
  const Image ramp = make_ramp();
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x) {
      const auto* texel = ramp.channels<std::uint8_t>(x, y);
      REQUIRE(texel[0] == x);
      REQUIRE(texel[1] == y);
      REQUIRE(texel[2] == 0);
    }
  const Image narrow = make_ramp(3, 1);
  CHECK(narrow.channels<std::uint8_t>(1, 0)[0] == 128);  // 127.5, half up
  CHECK(narrow.channels<std::uint8_t>(2, 0)[0] == 255);
  CHECK(narrow.channels<std::uint8_t>(2, 0)[1] == 0);
}
