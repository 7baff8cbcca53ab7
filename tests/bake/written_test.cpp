// What a baked model promises, checked on its files as they are read again: rows, coordinates and colours of the written texture.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "core/bake/bake.h"
#include "core/io/mesh_file.h"
#include "core/procedural/duck.h"
#include "core/procedural/knot.h"
#include "core/procedural/monkey.h"
#include "core/procedural/statue.h"
#include "tests/bake/fill_fixture.h"
#include "tests/io/scratch.h"

using namespace etalon;
using namespace etalon::bake;

namespace {

using Place3 = std::array<float, 3>;
Place3 place_of(const Mesh& mesh, std::uint32_t f, int c) {
  const Vec3f p = mesh.position(FaceId(f), c);
  return {p.x, p.y, p.z};
}

struct Written {
  Mesh mesh;
  Image texture;
};

Written written(const BakeResult& result, const std::string& path) {
  io::write_mesh(path, result.mesh, {{.name = "baked", .texture_path = {}, .texture = result.texture}});
  const io::LoadedModel model = io::read_mesh(path);
  REQUIRE(model.mesh.face_count() == result.mesh.face_count());
  REQUIRE(model.materials.size() == 1);
  return {model.mesh, io::load_texture(model.materials[0])};
}

// The face each texel belongs to, or none.
std::vector<int> owners_of(const Atlas& atlas) {
  std::vector<int> owner(static_cast<std::size_t>(atlas.width) * static_cast<std::size_t>(atlas.height), -1);
  for (std::size_t f = 0; f < atlas.tiles.size(); ++f)
    for_each_texel(atlas.tiles[f].size, [&](int i, int j) {
      const auto [x, y] = atlas.tiles[f].place(i, j);
      REQUIRE((x >= 0 && y >= 0 && x < atlas.width && y < atlas.height));
      int& mine = owner[static_cast<std::size_t>(y) * static_cast<std::size_t>(atlas.width) + static_cast<std::size_t>(x)];
      REQUIRE(mine == -1);
      mine = static_cast<int>(f);
    });
  return owner;
}

// A point of a side, in texels: t from corner a to corner b.
Vec2d side_point(const Written& model, std::uint32_t f, int a, int b, double t) {
  const Vec2f p = model.mesh.wedge(FaceId(f), a).uv, q = model.mesh.wedge(FaceId(f), b).uv;
  return {(p.x + t * (static_cast<double>(q.x) - p.x)) * model.texture.width(),
          (p.y + t * (static_cast<double>(q.y) - p.y)) * model.texture.height()};
}

// Along all sides, each coordinate off by 0 and by 5 units of 2^-24: lookups in texels that are not the triangle's.
std::size_t foreign_lookups(const Written& model, const std::vector<int>& owner) {
  std::size_t foreign = 0;
  for (std::uint32_t f = 0; f < model.mesh.face_count(); ++f)
    for (int c = 0; c < 3; ++c)
      for (int n = 0; n <= 64; ++n)
        for (const double ex : {-5.0, 0.0, 5.0})
          for (const double ey : {-5.0, 0.0, 5.0}) {
            const Vec2d p = side_point(model, f, c, (c + 1) % 3, n / 64.0);
            const auto x = static_cast<int>(std::floor(p.x + ex * 0x1p-24 * model.texture.width()));
            const auto y = static_cast<int>(std::floor(p.y + ey * 0x1p-24 * model.texture.height()));
            const bool inside = x >= 0 && y >= 0 && x < model.texture.width() && y < model.texture.height();
            const std::size_t texel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(model.texture.width()) + static_cast<std::size_t>(x);
            foreign += !inside || owner[texel] != static_cast<int>(f) ? 1 : 0;
          }
  return foreign;
}

// The largest difference between what triangles show at one piece of an edge or one vertex, which are known by their places.
int residual(const Written& model, int largest) {
  struct Range {
    std::array<int, 3> low{255, 255, 255}, high{0, 0, 0};
  };
  std::map<std::pair<std::array<Place3, 2>, int>, Range> seen;
  const auto add = [&](const std::array<Place3, 2>& where, int step, const Vec2d& p) {
    const std::uint8_t* const color =
        model.texture.channels<std::uint8_t>(static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y)));
    Range& range = seen[{where, step}];
    for (std::size_t k = 0; k < 3; ++k) {
      range.low[k] = std::min(range.low[k], int{color[k]});
      range.high[k] = std::max(range.high[k], int{color[k]});
    }
  };
  for (std::uint32_t f = 0; f < model.mesh.face_count(); ++f)
    for (int c = 0; c < 3; ++c) {
      const Place3 from = place_of(model.mesh, f, c), to = place_of(model.mesh, f, (c + 1) % 3);
      add({from, from}, 0, side_point(model, f, c, c, 0));
      for (int step = 0; step < largest; ++step) {
        const double t = (step + 0.5) / largest;
        add({std::min(from, to), std::max(from, to)}, step, side_point(model, f, c, (c + 1) % 3, from < to ? t : 1 - t));
      }
    }
  int worst = 0;
  for (const auto& [where, range] : seen)
    for (std::size_t k = 0; k < 3; ++k) worst = std::max(worst, range.high[k] - range.low[k]);
  return worst;
}

Mesh colored(Mesh mesh) {
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    mesh.colors.emplace_back(static_cast<float>(v * 37 % 101) / 100, static_cast<float>(v * 71 % 97) / 96, static_cast<float>(v % 5) / 4,
                             1);
  return mesh;
}

struct Scan {
  const char* name;
  Mesh mesh;
};
const std::vector<Scan>& scans() {
  static const std::vector<Scan> kScans = [] {
    std::vector<Scan> all;
    all.push_back({"knot", procedural::make_knot({.rings = 120, .around = 24})});
    all.push_back({"duck", procedural::make_duck(procedural::duck_of_faces(10000, true))});
    all.push_back({"statue", procedural::make_statue({.faces = 40000})});
    all.push_back({"monkey", procedural::make_monkey({.faces = 20000})});
    all.push_back({"relief", colored(test::relief(24, 5))});
    all.push_back({"other relief", colored(test::relief(9, 8))});
    all.push_back({"flat", colored(test::relief(6, 1, true))});
    all.push_back({"triangle", colored(test::mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}))});
    all.push_back({"two triangles", colored(test::mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 3}}, {{0, 1, 2}, {2, 1, 3}}))});
    return all;
  }();
  return kScans;
}

struct Size {
  int width, height;
  Gutter gutter;
};

}  // namespace

TEST_CASE("written models: no seam, no lookup outside a triangle, every texel of it painted; many scans, maps and formats") {
  const test::ScratchFolder folder;
  for (const Scan& scan : scans())
    for (const Size& size : {Size{64, 64, {}}, {128, 50, {}}, {32, 200, {}}, {256, 257, {}}, {128, 128, 0}, {256, 136, 1}}) {
      CAPTURE(scan.name);
      CAPTURE(size.width);
      CAPTURE(size.height);
      const BakeResult result =
          bake_scan(scan.mesh, {.target_faces = 120, .width = size.width, .height = size.height, .gutter = size.gutter});
      int largest = 2;
      for (const Tile& tile : result.atlas.tiles) largest = std::max(largest, tile.size);
      const std::vector<int> owner = owners_of(result.atlas);
      for (const char* name : {"model.obj", "model.glb"}) {
        const Written model = written(result, (folder.path() / name).string());
        REQUIRE(model.texture.width() == size.width);
        REQUIRE(model.texture.height() == size.height);
        CHECK(residual(model, largest) == 0);
        // v is stored as 1 − v, which may cost another half unit, in GLB.
        CHECK(foreign_lookups(model, owner) == 0);
      }
      CHECK(result.seam_residual == 0);
      CHECK(result.texels.hit + result.texels.filled == result.texels.inside);
    }
}

TEST_CASE("written models: a texture upside down, or coordinates so, would be seen") {
  const test::ScratchFolder folder;
  BakeResult result = bake_scan(scans()[0].mesh, {.target_faces = 120, .width = 128, .height = 128});
  int largest = 2;
  for (const Tile& tile : result.atlas.tiles) largest = std::max(largest, tile.size);
  for (Wedge& wedge : result.mesh.wedges) wedge.uv.y = 1 - wedge.uv.y;
  const Written model = written(result, (folder.path() / "model.obj").string());
  CHECK(residual(model, largest) > 0);
  CHECK(foreign_lookups(model, owners_of(result.atlas)) > 0);
}
