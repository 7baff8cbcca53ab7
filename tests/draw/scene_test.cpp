#include "core/draw/scene.h"

#include <doctest/doctest.h>

#include <limits>

#include "core/base/error.h"

using namespace etalon;

namespace {

Mesh quad(float size) {
  Mesh mesh;
  mesh.positions = {{-size, -size, 0}, {size, -size, 0}, {size, size, 0}, {-size, size, 0}};
  for (std::uint32_t n = 0; n < 4; ++n) mesh.wedges.push_back({VertexId(n), {n == 1 || n == 2 ? 1.0f : 0.0f, n >= 2 ? 1.0f : 0.0f}});
  mesh.faces = {{WedgeId(0u), WedgeId(1u), WedgeId(2u)}, {WedgeId(0u), WedgeId(2u), WedgeId(3u)}};
  mesh.has_uv = true;
  return mesh;
}

Camera camera_at(double z) {
  Camera camera;
  camera.eye = {0, 0, z}, camera.near = z / 16, camera.far = z * 16;
  return camera;
}

}  // namespace

TEST_CASE("each snap rounding, at and around ties") {
  RasterState state;
  state.subtexel_bits = 1;
  const auto snapped = [&](SnapRounding r, double x) {
    state.snap = r;
    return snap(x, state);
  };
  // In half texels: 0.75 is 1.5, −0.75 is −1.5, 0.25 is 0.5.
  const std::array<double, 6> x = {0.75, -0.75, 0.25, -0.25, 0.3, -0.3};
  const auto row = [&](SnapRounding r) {
    std::array<int, 6> result{};
    for (std::size_t n = 0; n < x.size(); ++n) result[n] = snapped(r, x[n]);
    return result;
  };
  CHECK(row(SnapRounding::nearest_even) == std::array<int, 6>{2, -2, 0, 0, 1, -1});
  CHECK(row(SnapRounding::half_up) == std::array<int, 6>{2, -1, 1, 0, 1, -1});
  CHECK(row(SnapRounding::half_away) == std::array<int, 6>{2, -2, 1, -1, 1, -1});
  CHECK(row(SnapRounding::toward_zero) == std::array<int, 6>{1, -1, 0, 0, 0, 0});
  CHECK(row(SnapRounding::floor) == std::array<int, 6>{1, -2, 0, -1, 0, -1});
  // One double short of a tie is no tie: −0x1.fffffffffffffp-2 half texels.
  for (const SnapRounding r : {SnapRounding::nearest_even, SnapRounding::half_up, SnapRounding::half_away, SnapRounding::toward_zero}) {
    CHECK(snapped(r, 0x1.fffffffffffffp-3) == 0);
    CHECK(snapped(r, -0x1.fffffffffffffp-3) == 0);
  }
  state.subtexel_bits = 40;
  CHECK_THROWS_AS((void)snap(0.5, state), InputError);
  state.subtexel_bits = 1;
  CHECK_THROWS_AS((void)snap(1e12, state), InputError);
  CHECK_THROWS_AS((void)snap(std::numeric_limits<double>::quiet_NaN(), state), InputError);
}

TEST_CASE("wedges become vertices once; faces keep their order and ids") {
  Frame frame;
  frame.width = frame.height = 256;
  const DrawList list = make_scene(quad(1), {Material{}}, camera_at(4), frame);
  CHECK(list.vertices.size() == 4);
  CHECK(list.triangles.size() == 2);
  CHECK(list.source_faces == std::vector<std::uint32_t>{0, 1});
  // eye 4, tan ½: the quad of half size 1 covers half of the frame.
  CHECK(list.vertices[0].x == 64 * 256);
  CHECK(list.vertices[2].y == 192 * 256);
  CHECK(list.vertices[0].w == 4);
  validate(list, frame);
}

TEST_CASE("a mesh that leaves the frame by far is cut to the guard and stays valid") {
  Frame frame;
  frame.width = 320, frame.height = 200, frame.guard = 64;
  const DrawList list = make_scene(quad(1000), {Material{}}, camera_at(4), frame);
  CHECK(list.triangles.size() > 2);
  validate(list, frame);
  CHECK(make_scene(
            quad(1), {Material{}},
            [] {
              Camera c = camera_at(4);
              c.target = {0, 0, 8};
              return c;
            }(),
            frame)
            .triangles.empty());
}

TEST_CASE("a far plane 10^7 times the near one leaves no vertex out of the range of w") {
  Mesh mesh;
  mesh.positions = {{-1000, -1, -1}, {1000, -1, -1}, {0, -1, -3e6f}};
  for (std::uint32_t n = 0; n < 3; ++n) mesh.wedges.push_back({VertexId(n), {0, 0}});
  mesh.faces = {{WedgeId(0u), WedgeId(1u), WedgeId(2u)}};
  Camera camera;
  camera.eye = {0, 0, 0}, camera.target = {0, 0, -1}, camera.near = 0.1, camera.far = 1e6;
  Frame frame;
  const DrawList list = make_scene(mesh, {Material{}}, camera, frame);
  CHECK(!list.triangles.empty());
  validate(list, frame);
}

TEST_CASE("in texture space the uv are the positions") {
  Frame frame;
  frame.width = 64, frame.height = 32;
  const DrawList list = make_uv_scene(quad(1), {Material{}}, frame);
  CHECK(list.vertices[2].x == 64 * 256);
  CHECK(list.vertices[2].y == 32 * 256);
  CHECK(list.vertices[2].w == 1);
  validate(list, frame);
}

TEST_CASE("what a scene refuses") {
  Frame frame;
  Mesh mesh = quad(1);
  CHECK_THROWS_AS((void)make_scene(mesh, {}, camera_at(4), frame), InputError);
  mesh.face_materials = {0, 5};
  CHECK_THROWS_AS((void)make_scene(mesh, {Material{}}, camera_at(4), frame), InputError);
  mesh = quad(1);
  mesh.faces[0][0] = WedgeId(99u);
  CHECK_THROWS_AS((void)make_scene(mesh, {Material{}}, camera_at(4), frame), InputError);
  mesh = quad(1);
  mesh.face_materials = {0};
  CHECK_THROWS_AS((void)make_scene(mesh, {Material{}}, camera_at(4), frame), InputError);
  mesh = quad(1);
  frame.width = 0;
  CHECK_THROWS_AS((void)make_scene(mesh, {Material{}}, camera_at(4), frame), InputError);
  CHECK_THROWS_AS((void)make_uv_scene(mesh, {Material{}}, frame), InputError);
  frame.width = 64;
  mesh.colors.resize(1);
  CHECK_THROWS_AS((void)make_scene(mesh, {Material{}}, camera_at(4), frame), InputError);
}
