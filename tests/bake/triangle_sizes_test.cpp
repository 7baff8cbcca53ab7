// Which size each triangle gets.
#include <doctest/doctest.h>

#include <limits>
#include <string>

#include "core/bake/triangle_sizes.h"
#include "core/base/error.h"
#include "core/base/rng.h"

using namespace etalon;
using namespace etalon::bake;

namespace {

// Two triangles of a square, its sides 3 and 4 model units long.
Mesh sheet() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {3, 0, 0}, {3, 4, 0}, {0, 4, 0}};
  for (std::uint32_t v = 0; v < 4; ++v) mesh.wedges.push_back({.vertex = VertexId(v)});
  const auto face = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) { mesh.faces.push_back({WedgeId(a), WedgeId(b), WedgeId(c)}); };
  face(0, 1, 2);
  face(0, 2, 3);
  return mesh;
}

}  // namespace

TEST_CASE("the spacing is the mean of the edges, a shared one counted once; a ratio is of the longest edge") {
  CHECK(mean_edge_length(sheet()) == (3 + 4 + 5 + 4 + 3) / 5.0);
  CHECK(size_ratios(sheet(), 0.5) == std::vector<double>{10, 10});
}

TEST_CASE("a size is the smallest power of two that is not below the ratio") {
  CHECK(wanted_size(0, 512) == 2);
  CHECK(wanted_size(2, 512) == 2);
  CHECK(wanted_size(2.001, 512) == 4);
  CHECK(wanted_size(16, 512) == 16);
  CHECK(wanted_size(17.5, 512) == 32);
  CHECK(wanted_size(11, 512) == 16);
  CHECK(wanted_size(1e9, 512) == 512);
}

TEST_CASE("section 3's example: 17.5 and 11") {
  CHECK(wanted_size(17.5, 32) == 32);
  CHECK(wanted_size(11, 32) == 16);
  // Eight triangles at 32 / 16 = 2 crowd them. The paper prints that 11 goes to 4 at 1.375: it goes to 8, and to 4 only at 11 / 4.
  std::vector<double> ratios{17.5, 11};
  ratios.resize(10, 32);
  std::vector<SizeStep> steps;
  (void)choose_sizes(ratios, 32, 33, [&](const SizeStep& step) { steps.push_back(step); });
  REQUIRE(steps.size() >= 12);
  const auto check = [&](std::size_t n, std::uint32_t face, int from, double proximity) {
    CHECK(steps[n].face == FaceId(face));
    CHECK(steps[n].from == from);
    CHECK(steps[n].proximity == proximity);
  };
  check(0, 0, 32, 1.09375);
  check(1, 1, 16, 1.375);
  for (std::uint32_t n = 2; n < 10; ++n) check(n, n, 32, 2);
  check(10, 0, 16, 2.1875);
  check(11, 1, 8, 2.75);
}

TEST_CASE("equal proximities go by the lower face") {
  std::vector<std::uint32_t> order;
  // Two rectangles of 4 x 5 need 10 rows; with two triangles smaller still 8; with three the fourth is handed down, and 3 rows do.
  const TriangleSizes sizes = choose_sizes({4, 4, 4, 4}, 4, 6, [&](const SizeStep& step) { order.push_back(step.face.index); });
  CHECK(order == std::vector<std::uint32_t>{0, 1, 2});
  CHECK(sizes.sizes == std::vector<int>{2, 2, 2, 2});
  CHECK(sizes.handed_down == 1);
}

TEST_CASE("the filtering stops at the first sizes that fit; every class but the lowest is even") {
  Rng rng(2);
  for (int n = 0; n < 300; ++n) {
    std::vector<double> ratios(1 + rng.below(60));
    for (double& ratio : ratios) ratio = rng.unit() * static_cast<double>(1u << rng.below(7));
    const int width = 1 << rng.between(3, 7), height = static_cast<int>(rng.between(12, 140));
    if (least_height(ratios.size(), width) > static_cast<std::uint64_t>(height)) continue;
    std::vector<SizeStep> steps;
    const TriangleSizes result = choose_sizes(ratios, width, height, [&](const SizeStep& step) { steps.push_back(step); });
    REQUIRE(result.reductions == steps.size());
    const int largest = largest_size(width, height);
    std::vector<int> replay;
    for (const double ratio : ratios) replay.push_back(wanted_size(ratio, largest));
    const auto counts_of = [](const std::vector<int>& sizes) {
      SizeCounts counts{};
      for (const int size : sizes)
        for (std::size_t k = 1; k < kSizeCount; ++k) counts[k] += size == 1 << k;
      return counts;
    };
    for (const SizeStep& step : steps) {
      REQUIRE(tiling_height(even_counts(counts_of(replay)), width) > static_cast<std::uint64_t>(height));
      // No triangle was nearer to its next class.
      for (std::uint32_t f = 0; f < ratios.size(); ++f)
        if (replay[f] > 2) REQUIRE(std::make_pair(ratios[f] / (replay[f] / 2), f) >= std::make_pair(step.proximity, step.face.index));
      replay[step.face.index] /= 2;
    }
    const SizeCounts counts = counts_of(result.sizes);
    REQUIRE(counts == even_counts(counts_of(replay)));
    REQUIRE(tiling_height(counts, width) <= static_cast<std::uint64_t>(height));
    std::size_t lowest = 1;
    while (counts[lowest] == 0) ++lowest;
    for (std::size_t k = lowest + 1; k < kSizeCount; ++k) REQUIRE(counts[k] % 2 == 0);
  }
}

TEST_CASE("three pairs that use 75 % of the map do not fit") {
  const TriangleSizes result = choose_sizes(std::vector<double>(6, 256), 512, 512);
  CHECK(result.reductions == 1);
  CHECK(result.sizes == std::vector<int>{128, 128, 256, 256, 256, 256});
}

TEST_CASE("maps that cannot be are refused, and the smallest that would do is named") {
  CHECK_THROWS_WITH_AS((void)choose_sizes({1}, 100, 100), "a texture map of 100x100: expected a width that is a power of two, 2 to 16384",
                       InputError);
  CHECK_THROWS_AS((void)choose_sizes({1}, 0, 100), InputError);
  CHECK_THROWS_AS((void)choose_sizes({1}, 65536, 100), InputError);
  CHECK_THROWS_WITH_AS((void)choose_sizes({1}, 64, 2), "a texture map of 64x2: expected a height of 3 to 16384", InputError);
  CHECK_THROWS_AS((void)choose_sizes({std::numeric_limits<double>::infinity()}, 64, 64), InputError);
  const std::vector<double> many(1001, 9);
  CHECK_THROWS_WITH_AS(
      (void)choose_sizes(many, 32, 95),
      "1001 triangles do not fit in a texture map of 32x95: the smallest of this width is 32x96, the smallest square 64x64", InputError);
  CHECK(choose_sizes(std::vector<double>(1024, 9), 32, 96).sizes == std::vector<int>(1024, 2));
}
