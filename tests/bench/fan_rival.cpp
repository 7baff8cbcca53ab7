#include <algorithm>
#include <cstring>

#include "gpu/gl_format.h"
#include "gpu/gl_texture.h"
#include "tests/bench/fan_scene.h"
#include "tests/bench/gl_rival.h"

namespace etalon::bench {
namespace {

namespace gl = gpu::gl;

/// Even fans, which keep to the left, then the odd ones.
BenchScene left_then_right(BenchScene scene) {
  auto& triangles = scene.list.triangles;
  const auto interleaved = triangles;
  std::size_t at = 0;
  for (std::size_t parity = 0; parity < 2; ++parity)
    for (std::size_t t = 0; t < interleaved.size(); ++t)
      if (t / kFanTriangles % 2 == parity) triangles[at++] = interleaved[t];
  return scene;
}

}  // namespace

FanRival::FanRival(gpu::Context& context, const BenchScene& scene)
    : content_(*scene.list.images.front()),
      fan_count_(static_cast<std::uint32_t>(scene.list.triangles.size() / kFanTriangles)),
      resident_(context, left_then_right(scene)),
      gl_(context.gl()) {
  reset();
  source_ = make_map(content_);
  target_ = make_map(content_);
}

void FanRival::reset() {
  a_ = make_map(content_);
  b_ = make_map(content_);
}

FanRival::Map FanRival::make_map(const Image& content) const {
  Map map;
  gl_.active_texture(gl::kTexture0);
  map.texture = gpu::upload_texture(gl_, content, {Filter::nearest, Wrap::clamp, Wrap::clamp}, content.width());
  map.framebuffer = gpu::make_framebuffer(gl_);
  gl_.bind_framebuffer(gl::kFramebuffer, map.framebuffer.id());
  gl_.framebuffer_texture_2d(gl::kFramebuffer, gl::kColorAttachment0, gl::kTexture2d, map.texture.id(), 0);
  gl_.read_buffer(gl::kColorAttachment0);
  gl::check_error(gl_, "making a map");
  return map;
}

void FanRival::draw_back_and_forth(std::uint32_t fans_per_bind) {
  resident_.bind();
  const std::uint32_t left_count = (fan_count_ + 1) / 2, right_count = fan_count_ / 2;
  for (std::uint32_t first = 0; first < left_count; first += fans_per_bind) {
    gl_.bind_framebuffer(gl::kFramebuffer, b_.framebuffer.id());
    gl_.bind_texture(gl::kTexture2d, a_.texture.id());
    resident_.draw(first * kFanTriangles, std::min(fans_per_bind, left_count - first) * kFanTriangles);
    if (first >= right_count) continue;
    gl_.bind_framebuffer(gl::kFramebuffer, a_.framebuffer.id());
    gl_.bind_texture(gl::kTexture2d, b_.texture.id());
    resident_.draw((left_count + first) * kFanTriangles, std::min(fans_per_bind, right_count - first) * kFanTriangles);
  }
  gl_.finish();
}

void FanRival::draw_at_once() {
  resident_.bind();
  gl_.bind_framebuffer(gl::kFramebuffer, target_.framebuffer.id());
  gl_.bind_texture(gl::kTexture2d, source_.texture.id());
  resident_.draw(0, fan_count_ * kFanTriangles);
  gl_.finish();
}

Image FanRival::read(const Map& map) const {
  Image image(resident_.width(), resident_.height(), kRg32f);
  gl_.bind_framebuffer(gl::kFramebuffer, map.framebuffer.id());
  const gpu::GlFormat format = gpu::target_format(kRg32f);
  gl_.read_pixels(0, 0, image.width(), image.height(), format.components, format.type, image.bytes().data());
  gl::check_error(gl_, "reading a map");
  return image;
}

Image FanRival::back_and_forth_map() const {
  Image left = read(b_);
  const Image right = read(a_);
  const int half = left.width() / 2;
  const auto row_bytes = static_cast<std::size_t>(half) * static_cast<std::size_t>(bytes_per_texel(kRg32f));
  for (int y = 0; y < left.height(); ++y) std::memcpy(left.texel(half, y), right.texel(half, y), row_bytes);
  return left;
}

Image FanRival::map_at_once() const { return read(target_); }

}  // namespace etalon::bench
