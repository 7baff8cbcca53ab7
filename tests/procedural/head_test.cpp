#include "core/procedural/head.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/mesh/mesh_validation.h"
#include "core/procedural/smooth_math.h"
#include "tests/procedural/mesh_sha256.h"

using namespace etalon;
using namespace etalon::procedural;

namespace {

const Model& default_head() {
  static const Model head = make_head();
  return head;
}

void check_sound(const Mesh& mesh) {
  const MeshReport report = validate_mesh(mesh);
  CHECK(report.closed());
  CHECK(report.manifold());
  CHECK(report.oriented());
  CHECK(report.component_count == 1);
  CHECK(report.genus == 0);
  CHECK(report.euler_characteristic == 2);
  CHECK(report.duplicate_faces.count == 0);
  CHECK(report.degenerate_faces.count == 0);
  CHECK(report.unreferenced_vertices.count == 0);
  CHECK(report.negative_uv_faces == 0);
  CHECK(report.degenerate_uv_faces.count == 0);
  CHECK(report.uv_outside.count == 0);
  CHECK(report.uv_overlaps.count == 0);
  CHECK(report.seam_vertex_count > 0);
}

double volume(const Mesh& mesh) {
  double sum = 0;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
    sum += dot(Vec3d(mesh.position(FaceId(f), 0)), cross(Vec3d(mesh.position(FaceId(f), 1)), Vec3d(mesh.position(FaceId(f), 2)))) / 6;
  return sum;
}

}  // namespace

TEST_CASE("the head has the class of the paper's, closed, of genus 0, with seams and without faults") {
  const Model& head = default_head();
  CHECK(head.name == "head");
  CHECK(head.mesh.face_count() == 7684);
  CHECK(head.mesh.vertex_count() == 3844);
  CHECK(head.texture.width() == 1024);
  CHECK(head.texture.format() == kRgb8);
  check_sound(head.mesh);
  const MeshReport report = validate_mesh(head.mesh);
  CHECK(report.chart_count == 5);
  CHECK(report.mirrored_charts.count == 0);
  CHECK(report.tiny_charts.count == 0);
}

TEST_CASE("the head is wound outward, upright, and looks toward +Z") {
  const Mesh& mesh = default_head().mesh;
  CHECK(volume(mesh) > 1);
  const BoundingBox box = bounding_box(mesh);
  CHECK(box.hi.z > -box.lo.z);  // the bill reaches farther than the crest
  CHECK(box.hi.y - box.lo.y > box.hi.x - box.lo.x);
}

TEST_CASE("the head is its own mirror image") {
  const Mesh& mesh = default_head().mesh;
  std::set<std::array<float, 3>> places;
  for (const Vec3f& p : mesh.positions) places.insert({p.x, p.y, p.z});
  CHECK(places.size() == mesh.vertex_count());
  for (const Vec3f& p : mesh.positions) REQUIRE(places.count({-p.x, p.y, p.z}) == 1);
}

TEST_CASE("charts keep four texels of distance at 1024") {
  const Mesh& mesh = default_head().mesh;
  const Charts charts = find_charts(mesh);
  constexpr int kSize = 1024, kDistance = 4;
  // The texels whose centre a chart covers, one mark per chart.
  std::vector<std::uint32_t> owner(static_cast<std::size_t>(kSize) * kSize, 0);
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    Vec2d c[3];
    for (int k = 0; k < 3; ++k) c[k] = Vec2d(mesh.wedge(FaceId(f), k).uv) * 1024.0;
    const auto area = [](const Vec2d& a, const Vec2d& b, const Vec2d& p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); };
    for (int y = static_cast<int>(std::min({c[0].y, c[1].y, c[2].y})); y <= static_cast<int>(std::max({c[0].y, c[1].y, c[2].y})); ++y)
      for (int x = static_cast<int>(std::min({c[0].x, c[1].x, c[2].x})); x <= static_cast<int>(std::max({c[0].x, c[1].x, c[2].x})); ++x) {
        const Vec2d p(x + 0.5, y + 0.5);
        if (area(c[0], c[1], p) >= 0 && area(c[1], c[2], p) >= 0 && area(c[2], c[0], p) >= 0)
          owner[static_cast<std::size_t>(y) * kSize + static_cast<std::size_t>(x)] = charts.of_face[f] + 1;
      }
  }
  int touching = 0;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const std::uint32_t own = owner[static_cast<std::size_t>(y) * kSize + static_cast<std::size_t>(x)];
      if (own == 0) continue;
      for (int dy = 0; dy <= kDistance && y + dy < kSize; ++dy)
        for (int dx = -kDistance; dx <= kDistance; ++dx) {
          if (x + dx < 0 || x + dx >= kSize) continue;
          const std::uint32_t other = owner[static_cast<std::size_t>(y + dy) * kSize + static_cast<std::size_t>(x + dx)];
          touching += other != 0 && other != own;
        }
    }
  CHECK(touching == 0);
}

TEST_CASE("the head in other sizes is as sound") {
  for (const int faces : {72, 75, 130, 500, 1000, 2000, 30000}) {
    CAPTURE(faces);
    const Model head = make_head({.faces = faces, .texture_size = 64});
    CHECK(head.mesh.face_count() == static_cast<std::size_t>(faces / 4 * 4));
    check_sound(head.mesh);
    CHECK(volume(head.mesh) > 1);
  }
}

TEST_CASE("the head's bytes, on one thread and on all") {
  CHECK(default_head().texture.sha256() == "602c771623bd91251624768635e6b01125faf3a7ee8bffc81597b4568a46c53e");
  CHECK(test::mesh_sha256(default_head().mesh) == "f77817eeb7b0d53f88598c4689c48fc2164787b59e33c6bc85d350181e92ec2c");
  const Model all = make_head({.faces = 1000, .texture_size = 128});
  set_thread_count(1);
  const Model one = make_head({.faces = 1000, .texture_size = 128});
  set_thread_count(0);
  CHECK(one.mesh == all.mesh);
  CHECK(one.texture == all.texture);
}

TEST_CASE("the head refuses sizes out of range") {
  CHECK_THROWS_WITH_AS((void)make_head({.faces = 71}), "head: faces: expected 72 to 2000000, got 71", InputError);
  CHECK_THROWS_AS((void)make_head({.faces = 2'000'001}), InputError);
  CHECK_THROWS_WITH_AS((void)make_head({.texture_size = 63}), "head: texture size: expected 64 to 8192, got 63", InputError);
  CHECK_THROWS_AS((void)make_head({.texture_size = 8193}), InputError);
}
