#include "validation/verify/vertex_lookups.h"

#include <limits>
#include <memory>

#include <doctest/doctest.h>

#include "core/base/error.h"
#include "raster/cpu_renderer.h"

using namespace etalon;
using validation::texture_at_vertices;

namespace {

/// width × 1, texel i is {10 · i + first, 0, 7}.
Material strip(int width, int first, Wrap wrap) {
  Image image(width, 1, kRgb8);
  for (int i = 0; i < width; ++i) {
    auto* const rgb = image.channels<std::uint8_t>(i, 0);
    rgb[0] = static_cast<std::uint8_t>(10 * i + first), rgb[2] = 7;
  }
  Material material;
  material.texture = std::make_shared<const Image>(std::move(image));
  material.sampler = {Filter::linear, wrap, wrap};
  return material;
}

/// `count` vertices, one wedge each at u = us[v mod size], and faces of three consecutive ones.
Mesh fan(std::size_t count, const std::vector<float>& us) {
  Mesh mesh;
  mesh.has_uv = true;
  for (std::uint32_t v = 0; v < count; ++v) {
    mesh.positions.push_back({static_cast<float>(v), static_cast<float>(v % 2), 0});
    mesh.wedges.push_back({VertexId(v), {us[v % us.size()], 0.5f}});
  }
  for (std::uint32_t v = 0; v + 2 < count; ++v) mesh.faces.push_back({WedgeId(v), WedgeId(v + 1), WedgeId(v + 2)});
  return mesh;
}

int red(const Vec4f& color) { return static_cast<int>(color[0] * 255 + 0.5f); }

}  // namespace

TEST_CASE("texture at vertices: the texel that holds the coordinate, whatever the material's filter, wrapped as it says") {
  raster::CpuRenderer exact;
  const Mesh mesh = fan(4, {0.25f, 0.249f, 1.5f, -0.125f});
  const std::vector<Vec4f> clamped = texture_at_vertices(mesh, {strip(4, 3, Wrap::clamp)}, exact);
  REQUIRE(clamped.size() == 4);
  CHECK(red(clamped[0]) == 13);  // on the border: the upper texel
  CHECK(red(clamped[1]) == 3);
  CHECK(red(clamped[2]) == 33);
  CHECK(red(clamped[3]) == 3);
  CHECK(clamped[0][1] == 0.0f);
  CHECK(clamped[0][2] == 7.0f / 255);
  CHECK(clamped[0][3] == 1.0f);
  const std::vector<Vec4f> repeated = texture_at_vertices(mesh, {strip(4, 3, Wrap::repeat)}, exact);
  CHECK(red(repeated[2]) == 23);
  CHECK(red(repeated[3]) == 33);
}

TEST_CASE("texture at vertices: the first face at a vertex counts; without a texture, or a face, it is mid grey") {
  raster::CpuRenderer exact;
  Mesh mesh = fan(5, {0.1f});
  mesh.positions.push_back({9, 9, 9});                                // in no face
  mesh.wedges.push_back({VertexId(std::uint32_t{2}), {0.9f, 0.5f}});  // a seam at vertex 2, seen by the last face only
  mesh.faces[2][0] = WedgeId(std::uint32_t{5});
  mesh.face_materials = {1, 0, 2};
  const std::vector<Vec4f> colors = texture_at_vertices(mesh, {strip(2, 50, Wrap::clamp), strip(2, 90, Wrap::clamp), {}}, exact);
  REQUIRE(colors.size() == 6);
  for (int v = 0; v < 3; ++v) CHECK(red(colors[v]) == 90);
  CHECK(red(colors[3]) == 50);
  CHECK(red(colors[4]) == 128);
  CHECK(red(colors[5]) == 128);
  CHECK(texture_at_vertices(Mesh{}, {{}}, exact).empty());
}

TEST_CASE("texture at vertices: more of them than a row of the frame holds") {
  raster::CpuRenderer exact;
  const std::vector<float> us{0.1f, 0.3f, 0.6f, 0.8f, 0.35f};  // five: another phase in every row
  const Mesh mesh = fan(2 * 16384 + 77, us);
  const std::vector<Vec4f> colors = texture_at_vertices(mesh, {strip(4, 3, Wrap::clamp)}, exact);
  const int expected[] = {3, 13, 23, 33, 13};
  std::size_t wrong = 0;
  for (std::size_t v = 0; v < colors.size(); ++v) wrong += red(colors[v]) != expected[v % 5];
  CHECK(wrong == 0);
}

TEST_CASE("texture at vertices: a coordinate out of the contract's range is refused") {
  raster::CpuRenderer exact;
  CHECK_THROWS_AS((void)texture_at_vertices(fan(3, {std::numeric_limits<float>::quiet_NaN()}), {strip(4, 3, Wrap::clamp)}, exact),
                  InputError);
}
