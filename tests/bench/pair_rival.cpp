#include "tests/bench/pair_rival.h"

#include <array>

#include "core/draw/scene.h"
#include "gpu/gl_format.h"
#include "gpu/gl_texture.h"
#include "tests/bench/gl_rival.h"

namespace etalon::bench {
namespace {

namespace gl = gpu::gl;

constexpr int kMaxTextureSize_texel = 16384;

class GlPairRival : public PairRival {
 public:
  GlPairRival(gpu::Context& context, const validation::TerrainProblem& terrain)
      : gl_(context.gl()),
        framebuffer_(gpu::make_framebuffer(gl_)),
        color_(gpu::make_renderbuffer(gl_)),
        depth_(gpu::make_renderbuffer(gl_)) {
    const Sampler linear{Filter::linear, Wrap::clamp, Wrap::clamp};
    std::shared_ptr<const Image> texture;
    for (const Image& image : terrain.textures()) {
      texture = std::make_shared<const Image>(validation::opaque_rgba(image));
      textures_.push_back(gpu::upload_texture(gl_, *texture, linear, kMaxTextureSize_texel));
    }
    // Clipped to the frame: what cannot be seen costs the device nothing.
    const Frame frame{.width = terrain.frame().width, .height = terrain.frame().height, .guard = 0, .state = {}, .targets = {{}}};
    for (std::size_t i = 0; i < terrain.levels().mesh_bits.size(); ++i) {
      const BenchScene scene{
          make_scene(terrain.mesh(i), {Material{.texture = texture, .sampler = linear}}, terrain.frame().camera, frame), frame, {}};
      triangles_.push_back(static_cast<std::uint32_t>(scene.list.triangles.size()));
      meshes_.push_back(std::make_unique<ResidentScene>(context, scene));
    }
    const auto attach = [&](const gpu::GlHandle& buffer, gl::Enum format, gl::Enum attachment) {
      gl_.bind_renderbuffer(gl::kRenderbuffer, buffer.id());
      gl_.renderbuffer_storage(gl::kRenderbuffer, format, frame.width, frame.height);
      gl_.framebuffer_renderbuffer(gl::kFramebuffer, attachment, gl::kRenderbuffer, buffer.id());
    };
    gl_.bind_framebuffer(gl::kFramebuffer, framebuffer_.id());
    attach(color_, gpu::target_format(kRgba8).internal, gl::kColorAttachment0);
    attach(depth_, gl::kDepthComponent32f, gl::kDepthAttachment);
    gl_.read_buffer(gl::kColorAttachment0);
    gpu::gl::check_error(gl_, "attaching a pair's target");
  }

  void draw_and_read_back(joint::Pair pair, Image& picture) override {
    meshes_[pair.mesh]->bind();
    gl_.bind_framebuffer(gl::kFramebuffer, framebuffer_.id());
    gl_.bind_texture(gl::kTexture2d, textures_[pair.texture].id());
    const std::array<float, 4> clear{0, 0, 0, 0};
    gl_.clear_bufferfv(gl::kColor, 0, clear.data());
    const float far_depth = 1;
    gl_.clear_bufferfv(gl::kDepth, 0, &far_depth);
    meshes_[pair.mesh]->draw(0, triangles_[pair.mesh]);
    gl_.finish();  // llvmpipe reads back a finished frame faster than one that it must finish first
    const gpu::GlFormat format = gpu::target_format(kRgba8);
    gl_.pixel_storei(gl::kPackAlignment, 1);
    gl_.read_pixels(0, 0, picture.width(), picture.height(), format.components, format.type, picture.bytes().data());
  }

 private:
  const gl::Api& gl_;
  std::vector<gpu::GlHandle> textures_;
  std::vector<std::unique_ptr<ResidentScene>> meshes_;
  std::vector<std::uint32_t> triangles_;
  gpu::GlHandle framebuffer_, color_, depth_;
};

}  // namespace

std::unique_ptr<PairRival> make_gl_pair_rival(gpu::Context& context, const validation::TerrainProblem& terrain) {
  return std::make_unique<GlPairRival>(context, terrain);
}

}  // namespace etalon::bench
