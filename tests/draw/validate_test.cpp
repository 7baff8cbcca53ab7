#include <doctest/doctest.h>

#include <functional>
#include <limits>

#include "core/base/error.h"
#include "core/draw/draw_list.h"

using namespace etalon;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

struct Scene {
  DrawList list;
  Frame frame;
};

Scene good() {
  Scene s;
  s.frame.width = s.frame.height = 64, s.frame.guard = 16;
  s.frame.targets = {{TargetContent::color, kRgba8}};
  s.list.vertices.resize(3);
  s.list.triangles = {{0, 1, 2}};
  auto image = std::make_shared<Image>(4, 4, kRg32f);
  s.list.images = {image};
  Draw draw;
  draw.triangle_count = 1, draw.shading = Shading::texture, draw.texture = 0;
  s.list.draws = {draw};
  return s;
}

void refuses(const char* expected_words, const std::function<void(Scene&)>& spoil) {
  Scene s = good();
  spoil(s);
  try {
    validate(s.list, s.frame);
    FAIL("accepted: " << expected_words);
  } catch (const InputError& e) {
    CHECK(std::string(e.what()).find(expected_words) != std::string::npos);
  }
}

void spoil_texel(Scene& s, float value) {
  auto image = std::make_shared<Image>(4, 4, kRg32f);
  image->channels<float>(2, 3)[1] = value;
  s.list.images[0] = image;
}

}  // namespace

TEST_CASE("a good list passes") {
  Scene s = good();
  validate(s.list, s.frame);
  s.list.vertices[0].x = -(16 << 8);
  s.list.vertices[1].x = 80 << 8;
  s.list.vertices[2].w = 0x1p-20f;
  s.list.vertices[2].uv.x = 0x1p27f;
  validate(s.list, s.frame);
}

TEST_CASE("every range of the contract has its refusal, naming the primitive") {
  refuses("vertex 1: expected a position", [](Scene& s) { s.list.vertices[1].x = (80 << 8) + 1; });
  refuses("vertex 1: expected a position", [](Scene& s) { s.list.vertices[1].y = -(16 << 8) - 1; });
  refuses("vertex 2: expected z", [](Scene& s) { s.list.vertices[2].z = 1.5f; });
  refuses("vertex 2: expected z", [](Scene& s) { s.list.vertices[2].z = kNan; });
  refuses("vertex 0: expected w", [](Scene& s) { s.list.vertices[0].w = 0; });
  refuses("vertex 0: expected w", [](Scene& s) { s.list.vertices[0].w = 0x1p21f; });
  refuses("vertex 0: expected finite uv", [](Scene& s) { s.list.vertices[0].uv.y = kNan; });
  refuses("vertex 0: expected a finite colour", [](Scene& s) { s.list.vertices[0].color.a = std::numeric_limits<float>::infinity(); });
  refuses("triangle 0: expected vertex indices below 3", [](Scene& s) { s.list.triangles[0][2] = 3; });
  refuses("triangle 0: expected |uv| times", [](Scene& s) { s.list.vertices[0].uv.x = 0x1p28f; });
  refuses("sub-texel bits", [](Scene& s) { s.frame.state.subtexel_bits = 17; });
  refuses("frame", [](Scene& s) { s.frame.width = 0; });
  refuses("frame", [](Scene& s) { s.frame.width = 16384; });
  refuses("finite clear", [](Scene& s) { s.frame.targets[0].clear[0] = kNan; });
}

TEST_CASE("draws and images") {
  refuses("expected to begin at triangle 0", [](Scene& s) { s.list.draws[0].first_triangle = 1; });
  refuses("ends at triangle 2 of 1", [](Scene& s) { s.list.draws[0].triangle_count = 2; });
  refuses("the draws end at triangle 0", [](Scene& s) { s.list.draws.clear(); });
  refuses("expected an image as texture, got none", [](Scene& s) { s.list.draws[0].texture = 7; });
  refuses("expected an image as indexing map", [](Scene& s) { s.list.draws[0].shading = Shading::indexed; });
  refuses("expected indexing map with at least 2 channels", [](Scene& s) {
    s.list.images.push_back(std::make_shared<Image>(4, 4, kR32f));
    s.list.draws[0].shading = Shading::indexed, s.list.draws[0].indexing_map = 1;
  });
  refuses("uint32, which cannot be looked up", [](Scene& s) { s.list.images[0] = std::make_shared<Image>(4, 4, kR32ui); });
  refuses("image 0, texel (2, 3): expected a finite number", [](Scene& s) { spoil_texel(s, kNan); });
  refuses("image 0, texel (2, 3)", [](Scene& s) {
    spoil_texel(s, 0x1p41f);
    s.list.draws[0].sampler.filter = Filter::linear;
  });
  refuses("source faces", [](Scene& s) { s.list.source_faces = {0, 1}; });
}

TEST_CASE("an indexing map is bounded by the texture's own sides, its other channels only by being finite") {
  Scene s = good();
  auto map = std::make_shared<Image>(2, 2, kRgba32f);
  map->channels<float>(1, 1)[0] = 0x1p25f;  // times a width of 1
  map->channels<float>(1, 1)[3] = 0x1p100f;
  s.list.images = {std::make_shared<Image>(1, 1024, kRgba8), map};
  s.list.draws[0].shading = Shading::indexed, s.list.draws[0].indexing_map = 1;
  validate(s.list, s.frame);
  map->channels<float>(1, 1)[1] = 0x1p25f;  // times a height of 1024
  CHECK_THROWS_AS(validate(s.list, s.frame), InputError);
}

TEST_CASE("targets take only their formats") {
  refuses("target 0 (color)", [](Scene& s) { s.frame.targets = {{TargetContent::color, kR32ui}}; });
  refuses("target 0 (triangle_id)", [](Scene& s) { s.frame.targets = {{TargetContent::triangle_id, kR32f}}; });
  refuses("target 0 (depth)", [](Scene& s) { s.frame.targets = {{TargetContent::depth, kRgba8}}; });
  refuses("target 0 (margins)", [](Scene& s) { s.frame.targets = {{TargetContent::margins, kRg32f}}; });
  refuses("target 0 (bound_terms)", [](Scene& s) { s.frame.targets = {{TargetContent::bound_terms, kRgba8}}; });
  refuses("target 0 (coordinate)", [](Scene& s) { s.frame.targets = {{TargetContent::coordinate, kRgba8}}; });
  refuses("target 0 (barycentrics)", [](Scene& s) { s.frame.targets = {{TargetContent::barycentrics, kRgba8}}; });
}
