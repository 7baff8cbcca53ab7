#include "validation/studies/vertex_color_view.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/procedural/knot.h"
#include "raster/cpu_renderer.h"
#ifdef ETALON_HAVE_GPU
#include "tests/validation/llvmpipe.h"
#endif

using namespace etalon;
using namespace etalon::validation;

namespace {

Image rgba(int width, int height, const std::vector<std::array<std::uint8_t, 4>>& texels) {
  Image image(width, height, kRgba8);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (std::size_t k = 0; k < 4; ++k) image.channels<std::uint8_t>(x, y)[k] = texels[static_cast<std::size_t>(y * width + x)][k];
  return image;
}

Mesh small_knot() { return procedural::make_knot({.rings = 60, .around = 12}); }

VertexColorView view_of(const Mesh& mesh, int size) { return {named_view("fit", bounding_box(mesh), size, size), size, size}; }

}  // namespace

TEST_CASE("the image error is the RMS of Euclidean distances of RGB, over all pixels, alpha left out") {
  const Image a = rgba(2, 2, {{0, 0, 0, 255}, {10, 10, 10, 255}, {1, 2, 3, 255}, {200, 0, 0, 255}});
  const Image b = rgba(2, 2, {{3, 4, 0, 255}, {10, 10, 10, 0}, {1, 2, 3, 255}, {188, 0, 0, 255}});
  CHECK(rgb_rms(a, b) == std::sqrt((25 + 0 + 0 + 144) / 4.0));
  CHECK(rgb_rms(a, a) == 0);
  CHECK_THROWS_AS((void)rgb_rms(a, rgba(1, 1, {{0, 0, 0, 0}})), InputError);
  CHECK_THROWS_AS((void)rgb_rms(Image(2, 2, kRgba32f), Image(2, 2, kRgba32f)), InputError);
}

TEST_CASE("vertex colours are drawn as they are, on black") {
  Mesh mesh;
  mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  mesh.colors.assign(4, Vec4f(1, 0.2f, 0, 1));
  for (std::uint32_t v = 0; v < 4; ++v) mesh.wedges.push_back({VertexId(v), {0, 0}});
  mesh.faces = {{WedgeId(0u), WedgeId(1u), WedgeId(2u)}, {WedgeId(0u), WedgeId(2u), WedgeId(3u)}};
  raster::CpuRenderer exact;
  const VertexColorView view{{.eye = {0, 0, 4}, .tan_half_fov_y = 0.5}, 16, 16};  // the square fills the middle 8 × 8 texels
  const Image image = draw_vertex_colors(exact, mesh, view);
  const auto* inside = image.channels<std::uint8_t>(8, 8);
  CHECK(inside[0] == 255);
  CHECK(inside[1] == 51);
  CHECK(inside[2] == 0);
  const auto* outside = image.channels<std::uint8_t>(1, 1);
  CHECK(outside[0] + outside[1] + outside[2] == 0);
  CHECK(outside[3] == 255);
  mesh.colors.clear();
  CHECK_THROWS_WITH_AS((void)draw_vertex_colors(exact, mesh, view), "expected a mesh with vertex colours, got one without", InputError);
}

TEST_CASE("a picture's error taken apart: inside and outline") {
  // Texels: both show it (differs by 3), only a (by 4), only b (by 12), neither.
  DrawnView a{rgba(4, 1, {{3, 0, 0, 255}, {0, 4, 0, 255}, {0, 0, 0, 255}, {0, 0, 0, 255}}), Image(4, 1, kR32ui)};
  DrawnView b{rgba(4, 1, {{0, 0, 0, 255}, {0, 0, 0, 255}, {0, 0, 12, 255}, {0, 0, 0, 255}}), Image(4, 1, kR32ui)};
  const std::uint32_t ids[2][4] = {{0, 1, kNoTriangle, kNoTriangle}, {5, kNoTriangle, 6, kNoTriangle}};
  for (int x = 0; x < 4; ++x) {
    *a.id.channels<std::uint32_t>(x, 0) = ids[0][x];
    *b.id.channels<std::uint32_t>(x, 0) = ids[1][x];
  }
  const PictureError error = picture_error(a, b);
  CHECK(error.rms == std::sqrt(169 / 4.0));
  CHECK(error.inside_rms == 3);
  CHECK(error.outline_share == 160.0 / 169);
  CHECK(picture_error(a, a).outline_share == 0);
  const ShownSquare shown = shown_square(a);
  CHECK(shown.x == 0);
  CHECK(shown.side == 2 + 16);
  DrawnView nothing = a;
  for (int x = 0; x < 4; ++x) *nothing.id.channels<std::uint32_t>(x, 0) = kNoTriangle;
  CHECK(shown_square(nothing).side == 4);
}

TEST_CASE("the worst window is found, and the close-up looks there") {
  Image a(64, 64, kRgba8), b(64, 64, kRgba8);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      for (int k = 0; k < 4; ++k) {
        a.channels<std::uint8_t>(x, y)[k] = 0;
        b.channels<std::uint8_t>(x, y)[k] = x >= 40 && x < 56 && y >= 8 && y < 24 ? 9 : 0;
      }
  const Vec2d at = worst_window(a, b, 4);
  CHECK(at.x == 48.0 / 64);
  CHECK(at.y == 16.0 / 64);
  CHECK(worst_window(a, a, 4) == Vec2d(0.5, 0.5));

  // A close-up of the middle is the same view with a narrower angle.
  const Mesh mesh = small_knot();
  const VertexColorView view = view_of(mesh, 64);
  const VertexColorView near = close_up(view, 0.5, 0.5, 4);
  CHECK(near.camera.tan_half_fov_y == view.camera.tan_half_fov_y / 4);
  for (int k = 0; k < 3; ++k) CHECK(near.camera.target[k] == doctest::Approx(view.camera.target[k]).epsilon(1e-12));
  // The point that a close-up of the right edge looks at lies on the right edge of the view: clip x = w.
  const Camera right = close_up(view, 1, 0.5, 4).camera;
  const Matrix4 m = clip_from_object(view.camera, 64, 64);
  const auto row = [&](int r) { return m.m[r][0] * right.target.x + m.m[r][1] * right.target.y + m.m[r][2] * right.target.z + m.m[r][3]; };
  CHECK(row(0) / row(3) == doctest::Approx(1).epsilon(1e-12));
  CHECK(row(1) / row(3) == doctest::Approx(0));
}

TEST_CASE("a device of fewer sub-texel bits gets positions of its own") {
  struct Coarse : raster::CpuRenderer {
    [[nodiscard]] RasterState supported_state(const RasterState& wanted) const override {
      RasterState state = wanted;
      state.subtexel_bits = 4;
      return state;
    }
  } coarse;
  raster::CpuRenderer exact;
  const Mesh mesh = small_knot();
  const VertexColorView view = view_of(mesh, 200);
  const DeviceView drawn = draw_on_device(exact, coarse, DeviceModel{}, mesh, view);
  CHECK(drawn.diff.counts[TexelClass::identical] == 200 * 200);
  CHECK(rgb_rms(drawn.color, draw_vertex_colors(exact, mesh, view)) > 0);
}

#ifdef ETALON_HAVE_GPU
TEST_CASE("the same picture on OpenGL: every texel that differs is explained") {
  gpu::GlRenderer* device = test::llvmpipe_or_skip("the same picture on OpenGL");
  if (device == nullptr) return;
  raster::CpuRenderer exact;
  const Mesh mesh = small_knot();
  const VertexColorView view = view_of(mesh, 200);
  const DeviceModel model = llvmpipe_model();
  const DeviceView drawn = draw_on_device(exact, *device, model, mesh, view);
  CHECK(drawn.diff.agreed());
  CHECK(drawn.diff.counts.total() == 200 * 200);
  CHECK(rgb_rms(drawn.color, draw_vertex_colors(exact, mesh, view)) < 1);  // roundings: a step of a channel at most
}
#endif
