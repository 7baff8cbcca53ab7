#include "validation/studies/vertex_color_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/draw/scene.h"
#include "validation/metrics/image_difference.h"

namespace etalon::validation {

StudyScene vertex_color_scene(const Mesh& mesh, const VertexColorView& view, const RasterState& state) {
  if (mesh.colors.empty()) throw InputError("expected a mesh with vertex colours, got one without");
  StudyScene scene;
  scene.frame.width = view.width;
  scene.frame.height = view.height;
  scene.frame.state = state;
  scene.frame.targets = {{TargetContent::color, kRgba8, {0, 0, 0, 1}}, {TargetContent::triangle_id, kR32ui, {}}};
  std::uint32_t materials = 1;
  for (const std::uint32_t m : mesh.face_materials) materials = std::max(materials, m + 1);
  scene.list = make_scene(mesh, std::vector<Material>(materials), view.camera, scene.frame);
  return scene;
}

DrawnView draw_view(Renderer& renderer, const Mesh& mesh, const VertexColorView& view) {
  const StudyScene scene = vertex_color_scene(mesh, view);
  std::vector<Image> images = renderer.render(scene.list, scene.frame);
  return {std::move(images[0]), std::move(images[1])};
}

Image draw_vertex_colors(Renderer& renderer, const Mesh& mesh, const VertexColorView& view) {
  return draw_view(renderer, mesh, view).color;
}

double rgb_rms(const Image& a, const Image& b) {
  if (a.format().type != ChannelType::unorm8 || a.format().channels < 3)
    throw InputError(fmt::format("image comparison: expected RGB or RGBA unorm8, got {}", to_string(a.format())));
  const ImageDifference difference = measure_difference(a, b);
  std::uint64_t sse = 0;
  for (std::size_t c = 0; c < 3; ++c) sse += difference.channels[c].sse;
  return std::sqrt(static_cast<double>(sse) / static_cast<double>(difference.texels));
}

PictureError picture_error(const DrawnView& a, const DrawnView& b) {
  PictureError error;
  error.rms = rgb_rms(a.color, b.color);
  std::uint64_t inside = 0, outline = 0, texels = 0;
  for (int y = 0; y < a.color.height(); ++y)
    for (int x = 0; x < a.color.width(); ++x) {
      const bool in_a = *a.id.channels<std::uint32_t>(x, y) != kNoTriangle, in_b = *b.id.channels<std::uint32_t>(x, y) != kNoTriangle;
      if (!in_a && !in_b) continue;
      const auto *p = a.color.channels<std::uint8_t>(x, y), *q = b.color.channels<std::uint8_t>(x, y);
      std::uint64_t square = 0;
      for (int k = 0; k < 3; ++k) square += static_cast<std::uint64_t>((p[k] - q[k]) * (p[k] - q[k]));
      (in_a && in_b ? inside : outline) += square;
      texels += in_a && in_b;
    }
  if (texels > 0) error.inside_rms = std::sqrt(static_cast<double>(inside) / static_cast<double>(texels));
  if (inside + outline > 0) error.outline_share = static_cast<double>(outline) / static_cast<double>(inside + outline);
  return error;
}

ShownSquare shown_square(const DrawnView& view) {
  constexpr int kMargin = 8;
  int x0 = view.id.width(), x1 = -1, y0 = view.id.height(), y1 = -1;
  for (int y = 0; y < view.id.height(); ++y)
    for (int x = 0; x < view.id.width(); ++x) {
      if (*view.id.channels<std::uint32_t>(x, y) == kNoTriangle) continue;
      x0 = std::min(x0, x), x1 = std::max(x1, x), y0 = std::min(y0, y), y1 = std::max(y1, y);
    }
  if (x1 < 0) return {view.id.width() / 2, view.id.height() / 2, std::max(view.id.width(), view.id.height())};
  return {(x0 + x1) / 2, (y0 + y1) / 2, std::max(x1 - x0, y1 - y0) + 1 + 2 * kMargin};
}

DeviceView draw_on_device(Renderer& exact, Renderer& device, const DeviceModel& model, const Mesh& mesh, const VertexColorView& view) {
  const StudyScene scene = vertex_color_scene(mesh, view, device.supported_state({}));
  const std::vector<Image> golden = exact.render(scene.list, scene.frame);
  std::vector<Image> candidate = device.render(scene.list, scene.frame);
  DeviceView result;
  result.diff = diff_images(scene.list, scene.frame, model, golden, candidate, {.worst_count = 1, .keep_class_image = false});
  result.color = std::move(candidate.front());
  return result;
}

VertexColorView close_up(const VertexColorView& view, double x, double y, double factor) {
  const Camera& c = view.camera;
  const auto unit = [](const Vec3d& a) { return a * (1 / std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z)); };
  const auto cross = [](const Vec3d& a, const Vec3d& b) {
    return Vec3d(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
  };
  const Vec3d forward = unit(c.target - c.eye), right = unit(cross(forward, c.up)), up = cross(right, forward);
  const double aspect = static_cast<double>(view.width) / view.height;
  const Vec3d way = forward + right * ((2 * x - 1) * c.tan_half_fov_y * aspect) + up * ((2 * y - 1) * c.tan_half_fov_y);
  VertexColorView near = view;
  const Vec3d to_target = c.target - c.eye;
  near.camera.target = c.eye + way * (to_target.x * forward.x + to_target.y * forward.y + to_target.z * forward.z);
  near.camera.tan_half_fov_y = c.tan_half_fov_y / factor;
  return near;
}

Vec2d worst_window(const Image& a, const Image& b, double factor) {
  const int step_x = std::max(1, static_cast<int>(a.width() / factor / 8)), step_y = std::max(1, static_cast<int>(a.height() / factor / 8));
  const int columns = a.width() / step_x, rows = a.height() / step_y;
  std::vector<std::uint64_t> cell(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0);
  for (int y = 0; y < rows * step_y; ++y)
    for (int x = 0; x < columns * step_x; ++x) {
      const auto *p = a.channels<std::uint8_t>(x, y), *q = b.channels<std::uint8_t>(x, y);
      for (int k = 0; k < 3; ++k) {
        const int d = p[k] - q[k];
        cell[static_cast<std::size_t>((y / step_y) * columns + x / step_x)] += static_cast<std::uint64_t>(d * d);
      }
    }
  std::uint64_t most = 0;
  Vec2d best(0.5, 0.5);
  for (int y = 0; y + 8 <= rows; ++y)
    for (int x = 0; x + 8 <= columns; ++x) {
      std::uint64_t sum = 0;
      for (int j = 0; j < 8; ++j)
        for (int i = 0; i < 8; ++i) sum += cell[static_cast<std::size_t>((y + j) * columns + x + i)];
      if (sum <= most) continue;
      most = sum;
      best = {(x + 4.0) * step_x / a.width(), (y + 4.0) * step_y / a.height()};
    }
  return best;
}

}  // namespace etalon::validation
