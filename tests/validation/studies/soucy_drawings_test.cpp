// What the figures show is what the program computes: counted in the drawings, or checked on the data behind them.
#include "validation/studies/soucy_drawings.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "raster/cpu_renderer.h"
#include "validation/studies/orthographic_view.h"
#include "validation/studies/surface_shading.h"

using namespace etalon;
using namespace etalon::validation;

namespace {

std::size_t occurrences(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

Mesh triangle_mesh() {
  Mesh mesh;
  mesh.positions = {{0.5f, 0.5f, 0}, {2.5f, 0.5f, 0}, {0.5f, 2.5f, 0}};
  mesh.wedges = {{VertexId(0u), {0, 0}}, {VertexId(1u), {1, 0}}, {VertexId(2u), {0, 1}}};
  mesh.faces = {{WedgeId(0u), WedgeId(1u), WedgeId(2u)}};
  mesh.colors = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}};
  return mesh;
}

}  // namespace

TEST_CASE("figures 6 to 8: the edge's texels change by propagation, the inner one by the second transform, and by way of the edge") {
  const FillExample e = fill_example();
  REQUIRE(e.stages.size() >= 3);
  const auto [t1, t2, t3, t4, t5, t6] = e.named;
  for (const std::uint32_t hit : {t1, t2, t6}) CHECK(std::find(e.hits.begin(), e.hits.end(), hit) != e.hits.end());
  const bake::TexelNodes nodes(e.mesh, e.atlas);
  for (const std::uint32_t edge : {t3, t5}) {
    CHECK(nodes.group_of(edge) != bake::kNoGroup);
    CHECK(e.stages[0].source[edge] >= nodes.first(1));  // alone: a texel of its own triangle
  }
  CHECK(e.stages[1].source[t3] == t2);
  CHECK(e.stages[1].source[t5] == t1);
  CHECK(nodes.group_of(t4) == bake::kNoGroup);
  CHECK(e.stages[0].source[t4] == t6);
  CHECK(e.stages[1].source[t4] == t6);
  CHECK(e.stages[2].source[t4] == t2);
  CHECK(e.stages[2].feature[t4] == t3);
  CHECK(e.stages[2].distance[t4] < e.stages[1].distance[t4]);
  const std::string svg = fill_drawing(e);
  for (const char* name : {">t1<", ">t6<", "6: after", "8: after"}) CHECK(svg.find(name) != std::string::npos);
}

TEST_CASE("figures 1 to 5 and the example of section 3") {
  raster::CpuRenderer exact;
  CHECK(lookup_drawing(exact).find("looked up at (") != std::string::npos);
  const std::string adjacent = adjacent_drawing();
  for (const char* name : {">ta1<", ">ta4<", ">tb1<", ">tb2<", "size 4", "size 2"}) CHECK(adjacent.find(name) != std::string::npos);
  // ta1, ta2, tb1 have one colour, ta3, ta4, tb2 another.
  CHECK(occurrences(adjacent, "fill=\"#0072b2\" fill-opacity=\"0.6\"") == 3);
  CHECK(occurrences(adjacent, "fill=\"#e69f00\" fill-opacity=\"0.6\"") == 3);
  const std::string projection = projection_drawing();
  CHECK(projection.find("8 hit, 2 empty") != std::string::npos);
  CHECK(occurrences(projection, "url(#hatch)") == 2);
  CHECK(pairing_drawing().find("4 × 5") != std::string::npos);
  // 10 + 2 + 6 + 23 triangles in rectangles of two.
  CHECK(tiling_drawing().find(">21<") != std::string::npos);
  CHECK(tiling_drawing().find(">22<") == std::string::npos);
  const std::string steps = reclassification_drawing();
  CHECK(steps.find("1: 1.094") != std::string::npos);  // 17.5 / 16
  CHECK(steps.find("2: 1.375") != std::string::npos);  // 11 / 8
}

TEST_CASE("histograms: one stroke for each value that occurs") {
  SoucyError error;
  error.histogram[255] = 1000, error.histogram[0] = 1, error.histogram[510] = 10;
  const std::string svg = histogram_drawing(error, "label");
  const std::size_t path = svg.find("<path d=\"");
  const std::string strokes = svg.substr(path, svg.find('"', path + 9) - path);
  CHECK(occurrences(strokes, "V") == 3);
  CHECK(occurrences(histograms_drawing({{"a", &error}, {"b", &error}, {"c", &error}}, 2, "three"), "<path d=") == 3);
}

TEST_CASE("orthographic: samples on texel centres, one texel around; higher is nearer; nearest lookups") {
  raster::CpuRenderer exact;
  const StudyScene scene = orthographic_scene(triangle_mesh(), nullptr, {3, 3, 1}, {});
  CHECK(scene.frame.width == 5);
  CHECK(scene.list.vertices[1].x == 3 * 256 + 128);
  const std::vector<Image> drawn = exact.render(scene.list, scene.frame);
  // The sample at the corner of the fill rule's own side shows its vertex exactly.
  CHECK(*drawn[1].channels<std::uint32_t>(1, 1) == 0);
  CHECK(drawn[0].channels<std::uint8_t>(1, 1)[0] == 255);
  CHECK(drawn[0].channels<std::uint8_t>(1, 1)[1] == 0);
  CHECK(*drawn[1].channels<std::uint32_t>(0, 0) == kNoTriangle);
  Mesh two = triangle_mesh();
  for (int k = 0; k < 3; ++k) {
    two.positions.push_back(two.positions[static_cast<std::size_t>(k)] + Vec3f(0, 0, 5));
    two.colors.push_back({1, 1, 1, 1});
    two.wedges.push_back({VertexId(static_cast<std::uint32_t>(3 + k)), {0, 0}});
  }
  two.faces.push_back({WedgeId(3u), WedgeId(4u), WedgeId(5u)});
  const StudyScene both = orthographic_scene(two, nullptr, {3, 3, 1}, {});
  CHECK(*exact.render(both.list, both.frame)[1].channels<std::uint32_t>(1, 1) == 1);
}

TEST_CASE("light: full towards the lamp, a quarter away from it; smooth is the mean of faces; products are rounded") {
  const Mesh mesh = triangle_mesh();  // faces +z
  CHECK(flat_shaded(mesh, {0, 0, 2}).colors[0].x == 1);
  CHECK(flat_shaded(mesh, {0, 0, -2}).colors[0].x == 0.25f);
  CHECK(flat_shaded(mesh, {0, 3, 4}).colors[2].y == doctest::Approx(0.25 + 0.75 * 0.8));
  CHECK(smooth_shaded(mesh, {0, 0, 1}).colors[1].z == 1);
  CHECK(flat_shaded(mesh, {0, 0, 1}).positions.size() == 3);
  Mesh flat = mesh;
  flat.positions[2] = flat.positions[1];
  CHECK(flat_shaded(flat, {0, 0, 1}).colors[0].x == 0.25f);
  Image a(1, 1, kRgb8), b(1, 1, kRgb8);
  for (int c = 0; c < 3; ++c) a.channels<std::uint8_t>(0, 0)[c] = 255, b.channels<std::uint8_t>(0, 0)[c] = 77;
  CHECK(multiplied(a, b).channels<std::uint8_t>(0, 0)[0] == 77);
  a.channels<std::uint8_t>(0, 0)[0] = 128;
  CHECK(multiplied(a, b).channels<std::uint8_t>(0, 0)[0] == 39);  // 38.65
}
