// Owners of OpenGL objects: each deletes what it names. The context they were made in must be current when they die.
#pragma once

#include <string>
#include <utility>

#include "gpu/gl_api.h"

namespace etalon::gpu {

/// One OpenGL name with its deleter; move-only. id() is 0 for an empty handle.
class GlHandle {
 public:
  using Deleter = void (*)(const gl::Api&, gl::Uint);

  GlHandle() = default;
  GlHandle(const gl::Api& api, gl::Uint id, Deleter deleter) : api_(&api), id_(id), deleter_(deleter) {}
  GlHandle(GlHandle&& other) noexcept { swap(other); }
  GlHandle& operator=(GlHandle&& other) noexcept {
    GlHandle(std::move(other)).swap(*this);
    return *this;
  }
  GlHandle(const GlHandle&) = delete;
  GlHandle& operator=(const GlHandle&) = delete;
  ~GlHandle() {
    if (id_ != 0) deleter_(*api_, id_);
  }

  [[nodiscard]] gl::Uint id() const { return id_; }

 private:
  void swap(GlHandle& other) noexcept {
    std::swap(api_, other.api_);
    std::swap(id_, other.id_);
    std::swap(deleter_, other.deleter_);
  }
  const gl::Api* api_ = nullptr;
  gl::Uint id_ = 0;
  Deleter deleter_ = nullptr;
};

[[nodiscard]] GlHandle make_buffer(const gl::Api& gl);
[[nodiscard]] GlHandle make_vertex_array(const gl::Api& gl);
[[nodiscard]] GlHandle make_renderbuffer(const gl::Api& gl);
[[nodiscard]] GlHandle make_framebuffer(const gl::Api& gl);
[[nodiscard]] GlHandle make_texture(const gl::Api& gl);

/// Compiles and links; UnavailableError with the compiler's log where the driver refuses.
[[nodiscard]] GlHandle make_program(const gl::Api& gl, const std::string& vertex_source, const std::string& fragment_source);

}  // namespace etalon::gpu
