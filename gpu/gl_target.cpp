#include "gpu/gl_target.h"

#include <algorithm>
#include <array>
#include <cstring>

#include <fmt/core.h>

#include "core/base/error.h"
#include "gpu/gl_format.h"

namespace etalon::gpu {

namespace {

GlHandle allocate(const gl::Api& gl, gl::Enum internal_format, PixelFormat stored, int width, int height, const std::string& name) {
  const std::string what = fmt::format("a {} x {} {} target", width, height, name);
  require_addressable(width, height, stored, what);
  GlHandle buffer = make_renderbuffer(gl);
  gl.bind_renderbuffer(gl::kRenderbuffer, buffer.id());
  gl.renderbuffer_storage(gl::kRenderbuffer, internal_format, width, height);
  gl::check_error(gl, "allocating " + what);
  return buffer;
}

/// Keeps the first channels of each texel: what is left when three channels were stored as four.
void copy_channels(const std::vector<std::byte>& stored, std::size_t stored_texel_bytes, Image& image) {
  const auto texel_bytes = static_cast<std::size_t>(bytes_per_texel(image.format()));
  std::byte* out = image.bytes().data();
  for (std::size_t i = 0; i < image.texel_count(); ++i) {
    std::memcpy(out + i * texel_bytes, stored.data() + i * stored_texel_bytes, texel_bytes);
  }
}

}  // namespace

GlTargets::GlTargets(const gl::Api& gl, const Frame& frame)
    : gl_(gl), width_(frame.width), height_(frame.height), specs_(frame.targets), framebuffer_(make_framebuffer(gl)) {
  for (const TargetSpec& spec : specs_) {
    if (spec.content == TargetContent::depth) continue;
    const gl::Enum internal = target_format(spec.format).internal;
    colors_.push_back(allocate(gl, internal, stored_target_format(spec.format), width_, height_, to_string(spec.format)));
  }
  depth_ = allocate(gl, gl::kDepthComponent32f, kR32f, width_, height_, "depth");

  gl.bind_framebuffer(gl::kFramebuffer, framebuffer_.id());
  std::vector<gl::Enum> attachments;
  for (const GlHandle& color : colors_) {
    attachments.push_back(gl::kColorAttachment0 + static_cast<gl::Enum>(attachments.size()));
    gl.framebuffer_renderbuffer(gl::kFramebuffer, attachments.back(), gl::kRenderbuffer, color.id());
  }
  gl.framebuffer_renderbuffer(gl::kFramebuffer, gl::kDepthAttachment, gl::kRenderbuffer, depth_.id());
  if (attachments.empty()) attachments.push_back(gl::kNone);
  gl.draw_buffers(static_cast<gl::Sizei>(attachments.size()), attachments.data());
  gl.read_buffer(attachments.front());
  gl::check_error(gl, "attaching the targets");
  const gl::Enum status = gl.check_framebuffer_status(gl::kFramebuffer);
  if (status != gl::kFramebufferComplete) {
    throw UnavailableError(
        fmt::format("OpenGL: the framebuffer of {} targets, {} x {}, is incomplete (0x{:04x}): the device's memory may be full",
                    specs_.size(), width_, height_, status));
  }
}

bool GlTargets::matches(const Frame& frame) const {
  const auto same_storage = [](const TargetSpec& a, const TargetSpec& b) { return a.content == b.content && a.format == b.format; };
  return width_ == frame.width && height_ == frame.height &&
         std::equal(specs_.begin(), specs_.end(), frame.targets.begin(), frame.targets.end(), same_storage);
}

void GlTargets::bind_and_clear(const Frame& frame) const {
  gl_.bind_framebuffer(gl::kFramebuffer, framebuffer_.id());
  gl::Int attachment = 0;
  for (const TargetSpec& spec : frame.targets) {
    if (spec.content == TargetContent::depth) continue;
    if (spec.content == TargetContent::triangle_id) {
      const std::array<gl::Uint, 4> none{kNoTriangle, 0, 0, 0};
      gl_.clear_bufferuiv(gl::kColor, attachment, none.data());
    } else {
      gl_.clear_bufferfv(gl::kColor, attachment, spec.clear.data());
    }
    ++attachment;
  }
  const float far_depth = 1;
  gl_.clear_bufferfv(gl::kDepth, 0, &far_depth);
  gl::check_error(gl_, "clearing the targets");
}

std::vector<Image> GlTargets::read_back() const {
  std::vector<Image> images;
  int attachment = 0;
  for (const TargetSpec& spec : specs_) {
    images.push_back(read_target(spec, attachment));
    if (spec.content != TargetContent::depth) ++attachment;
  }
  return images;
}

Image GlTargets::read_target(const TargetSpec& spec, int attachment) const {
  Image image(width_, height_, spec.format);
  if (spec.content == TargetContent::depth) {
    gl_.read_pixels(0, 0, width_, height_, gl::kDepthComponent, gl::kFloat, image.bytes().data());
  } else {
    gl_.read_buffer(gl::kColorAttachment0 + static_cast<gl::Enum>(attachment));
    const GlFormat format = target_format(spec.format);
    const PixelFormat stored_format = stored_target_format(spec.format);
    if (stored_format == spec.format) {
      gl_.read_pixels(0, 0, width_, height_, format.components, format.type, image.bytes().data());
    } else {
      const auto texel_bytes = static_cast<std::size_t>(bytes_per_texel(stored_format));
      std::vector<std::byte> stored(image.texel_count() * texel_bytes);
      gl_.read_pixels(0, 0, width_, height_, format.components, format.type, stored.data());
      copy_channels(stored, texel_bytes, image);
    }
  }
  gl::check_error(gl_, fmt::format("reading back the {} target", to_string(spec.content)));
  return image;
}

}  // namespace etalon::gpu
