// A scan baked as a whole.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <tuple>

#include "core/bake/bake.h"
#include "core/bake/seams.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/io/image_file.h"
#include "core/procedural/duck.h"
#include "core/procedural/knot.h"
#include "tests/bake/fill_fixture.h"

using namespace etalon;
using namespace etalon::bake;

namespace {

const Mesh& knot() {
  static const Mesh mesh = procedural::make_knot({.rings = 200, .around = 40});
  return mesh;
}
const Mesh& duck() {
  static const Mesh mesh = procedural::make_duck(procedural::duck_of_faces(20000, true));
  return mesh;
}

// The residual from what is written: coordinates of corners as float32, the image as its PNG's bytes decode; nothing of the atlas.
int written_residual(const BakeResult& result) {
  const std::string png = io::encode_png(result.texture, "texture");
  const Image image = io::decode_image(std::as_bytes(std::span(png)), "texture");
  REQUIRE(image == result.texture);
  const Mesh& mesh = result.mesh;
  struct Side {
    std::uint32_t low, high, face;
    int corner;
  };
  std::vector<Side> sides;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t a = mesh.vertex(FaceId(f), c).index, b = mesh.vertex(FaceId(f), (c + 1) % 3).index;
      sides.push_back({std::min(a, b), std::max(a, b), f, c});
    }
  std::sort(sides.begin(), sides.end(),
            [](const Side& a, const Side& b) { return std::tuple(a.low, a.high, a.face) < std::tuple(b.low, b.high, b.face); });
  const auto look_up = [&](const Side& side, double t) {
    const int next = (side.corner + 1) % 3;
    const bool along = mesh.vertex(FaceId(side.face), side.corner).index == side.low;
    const Vec2f p = mesh.wedge(FaceId(side.face), along ? side.corner : next).uv,
                q = mesh.wedge(FaceId(side.face), along ? next : side.corner).uv;
    const auto x = static_cast<int>(std::floor((p.x + t * (static_cast<double>(q.x) - p.x)) * image.width()));
    const auto y = static_cast<int>(std::floor((p.y + t * (static_cast<double>(q.y) - p.y)) * image.height()));
    return image.channels<std::uint8_t>(x, y);
  };
  int residual = 0;
  std::size_t pairs = 0;
  for (std::size_t n = 0; n + 1 < sides.size(); ++n) {
    const Side &a = sides[n], &b = sides[n + 1];
    if (a.low != b.low || a.high != b.high) continue;
    ++pairs;
    // In the middle of pieces of 1/128, the finest here: drawn-in sides are shifted along themselves by less than half of that.
    for (int step = 0; step < 128; ++step) {
      const double t = (step + 0.5) / 128;
      for (int c = 0; c < 3; ++c) residual = std::max(residual, std::abs(look_up(a, t)[c] - look_up(b, t)[c]));
    }
  }
  CHECK(pairs > mesh.face_count());
  return residual;
}

}  // namespace

TEST_CASE("no seam anywhere: on the written texture, by either fill, for several models and sizes") {
  for (const Mesh* scan : {&knot(), &duck()})
    for (const std::size_t faces : {60, 400})
      for (const int width : {64, 256})
        for (const FillKind fill : {FillKind::iterative, FillKind::exact, FillKind::sampled}) {
          const BakeResult result = bake_scan(*scan, {.target_faces = faces, .width = width, .height = width - 10, .fill = fill});
          CHECK(result.mesh.face_count() <= faces);
          CHECK(result.seam_residual == 0);
          CHECK(written_residual(result) == 0);
          CHECK(result.texels.atlas == static_cast<std::uint64_t>(width * (width - 10)));
          CHECK(result.texels.inside == result.atlas.inside_count());
          CHECK(result.texels.hit + result.texels.filled == result.texels.inside);
          CHECK(result.texels.averaged <= result.texels.hit);
          CHECK(result.texels.hit >= 3 * result.mesh.face_count());
        }
}

TEST_CASE("a texel changed on a side is a seam; one inside is not") {
  BakeResult result = bake_scan(knot(), {.target_faces = 100, .width = 128, .height = 128});
  REQUIRE(result.seam_residual == 0);
  const auto found = std::find_if(result.atlas.tiles.begin(), result.atlas.tiles.end(), [](const Tile& tile) { return tile.size >= 8; });
  REQUIRE(found != result.atlas.tiles.end());
  const auto change = [&](int i, int j) {
    Image image = result.texture;
    const auto [x, y] = found->place(i, j);
    image.channels<std::uint8_t>(x, y)[1] ^= 7;
    return largest_seam_residual(result.simplified.mesh, result.atlas, image);
  };
  CHECK(change(3, 0) > 0);
  CHECK(change(0, 0) > 0);
  CHECK(change(0, found->size - 3) > 0);
  CHECK(change(2, found->size - 3) > 0);
  CHECK(change(1, 1) == 0);
}

TEST_CASE("within the tolerance; every colour of the texture is a mean of the scan's; the same for every thread count") {
  BakeOptions options{.tolerance = 0.02, .width = 256, .height = 256};
  for (const FillKind fill : {FillKind::iterative, FillKind::sampled}) {
    options.fill = fill;
    const BakeResult result = bake_scan(duck(), options);
    CHECK(*result.simplified.distance_audited <= 0.02);
    CHECK(result.mesh.face_count() < duck().face_count() / 2);
    for (const int threads : {1, 3}) {
      set_thread_count(threads);
      const BakeResult again = bake_scan(duck(), options);
      CHECK(again.mesh == result.mesh);
      CHECK(again.texture == result.texture);
    }
    set_thread_count(0);
  }
}

TEST_CASE("one colour stays one colour, and a scan that keeps all its triangles shows its own at their corners") {
  Mesh scan = knot();
  for (Vec4f& color : scan.colors) color = {0.2f, 0.4f, 0.6f, 1};
  for (const FillKind fill : {FillKind::iterative, FillKind::sampled}) {
    const BakeResult plain = bake_scan(scan, {.target_faces = 200, .width = 128, .height = 128, .fill = fill});
    for (std::uint32_t f = 0; f < plain.mesh.face_count(); ++f)
      for_each_texel(plain.atlas.tiles[f].size, [&](int i, int j) {
        const auto [x, y] = plain.atlas.tiles[f].place(i, j);
        const std::uint8_t* const c = plain.texture.channels<std::uint8_t>(x, y);
        REQUIRE((c[0] == 51 && c[1] == 102 && c[2] == 153));
      });
  }
  const Mesh small = procedural::make_knot({.rings = 24, .around = 8});
  const BakeResult whole = bake_scan(small, {.target_faces = small.face_count(), .width = 128, .height = 128});
  REQUIRE(whole.mesh.face_count() == small.face_count());
  CHECK(whole.texels.averaged == 0);
  for (std::uint32_t f = 0; f < small.face_count(); ++f)
    for (int corner = 0; corner < 3; ++corner) {
      const auto [i, j] = whole.atlas.tiles[f].corner_texel(corner);
      const auto [x, y] = whole.atlas.tiles[f].place(i, j);
      for (int c = 0; c < 3; ++c)
        REQUIRE(whole.texture.channels<std::uint8_t>(x, y)[c] == color_byte(small.colors[small.vertex(FaceId(f), corner).index][c]));
    }
}

TEST_CASE("coordinates drawn in, or the paper's") {
  const BakeResult inset = bake_scan(knot(), {.target_faces = 100, .width = 128, .height = 128});
  const BakeResult exact = bake_scan(knot(), {.target_faces = 100, .width = 128, .height = 128, .corners = Corners::exact});
  CHECK(inset.share == 1.0 / 8192);
  CHECK(exact.share == 0);
  CHECK(inset.texture == exact.texture);
  for (const Wedge& wedge : exact.mesh.wedges) {
    REQUIRE(wedge.uv.x * 128 == std::floor(wedge.uv.x * 128));
    REQUIRE(wedge.uv.y * 128 == std::floor(wedge.uv.y * 128));
  }
  double largest = 0;
  for (std::size_t w = 0; w < inset.mesh.wedges.size(); ++w)
    largest = std::max(largest, std::abs(static_cast<double>(inset.mesh.wedges[w].uv.x) - exact.mesh.wedges[w].uv.x) * 128);
  CHECK(largest > 0);
  CHECK(largest <= 64 * 2.5 / 8192);
}

TEST_CASE("what cannot be baked is refused with the reason") {
  const BakeOptions usual{.target_faces = 100, .width = 64, .height = 64};
  Mesh bare = knot();
  bare.colors.clear();
  CHECK_THROWS_WITH_AS((void)bake_scan(bare, usual), "expected vertex colours, got none: there is nothing to bake", InputError);
  Mesh broken = knot();
  broken.colors[7].y = std::numeric_limits<float>::quiet_NaN();
  CHECK_THROWS_WITH_AS((void)bake_scan(broken, usual), "vertex 7: expected a finite colour, got nan", InputError);
  for (const double tolerance : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    BakeOptions options = usual;
    options.tolerance = tolerance;
    CHECK_THROWS_AS((void)bake_scan(knot(), options), InputError);
  }
  BakeOptions options = usual;
  options.width = 100;
  CHECK_THROWS_WITH_AS((void)bake_scan(knot(), options), "a texture map of 100x64: expected a width that is a power of two, 2 to 16384",
                       InputError);
  options = {.target_faces = 1000, .width = 32, .height = 32};
  CHECK_THROWS_WITH_AS(
      (void)bake_scan(knot(), options),
      "1000 triangles do not fit in a texture map of 32x32: the smallest of this width is 32x96, the smallest square 64x64", InputError);
  Mesh point = test::mesh_of({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}, {{0, 1, 2}});
  point.colors = {{0, 0, 0, 1}, {0, 1, 0, 1}, {1, 0, 0, 1}};
  CHECK_THROWS_WITH_AS((void)bake_scan(point, usual), "expected a surface, got edges that all have length 0", InputError);
}

TEST_CASE("scans that are no manifold, with loose vertices and triangles without area, are baked, and what was met is said") {
  Mesh scan = test::fins();
  scan.positions.push_back({9, 9, 9});
  scan.wedges.push_back({.vertex = VertexId(8u)});
  for (std::size_t v = 0; v < scan.positions.size(); ++v) scan.colors.emplace_back(static_cast<float>(v) / 8, 0.5f, 0.25f, 1);
  const BakeResult result = bake_scan(scan, {.target_faces = 1, .width = 32, .height = 32});
  CHECK(result.simplified.repair.non_manifold_edges.count == 1);
  CHECK(result.without_face == 1);
  CHECK(result.mesh.face_count() >= 3);
  CHECK(result.seam_residual == 0);
  // The face (1, 7, 5) has its corners on a line.
  Mesh flat = test::relief(3, 1, true);
  for (Vec3f& p : flat.positions) p.y = 0;
  flat.colors.assign(flat.positions.size(), {1, 0, 0, 1});
  const BakeResult line = bake_scan(flat, {.target_faces = 4, .width = 32, .height = 32, .fill = FillKind::exact});
  CHECK(line.seam_residual == 0);
}
