#include "gpu/exact_pipeline.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include <fmt/core.h>

#include "core/base/error.h"
#include "gpu/exact_probe.h"
#include "gpu/exact_texture.h"
#include "gpu/guard_viewport.h"

namespace etalon::gpu {

namespace {

/// Triangles in one draw call: errors name a range, and 3 · 2^20 vertices stay far from what a call may take.
constexpr std::uint32_t kTrianglesPerCall = 1u << 20;

/// Texels settled in one draw: some 0.3 s of llvmpipe, and 1 MiB.
constexpr std::size_t kListLength = 64 * std::size_t{kListWidth};

ValueShader value_shader(const DrawList& list, const TargetSpec& target, const Draw& draw) {
  ValueShader shader{.content = target.content, .target = target.format};
  if (target.content != TargetContent::color) return shader;
  shader.shading = draw.shading;
  shader.filter = draw.sampler.filter;
  if (draw.shading == Shading::indexed) shader.map_filter = draw.map_sampler.filter;
  if (draw.shading != Shading::vertex_color) shader.image = list.images[draw.texture]->format();
  if (draw.shading == Shading::indexed) shader.map = list.images[draw.indexing_map]->format();
  return shader;
}

}  // namespace

ExactPipeline::ExactPipeline(Context& context, const DeviceLimits& limits, bool integers_only)
    : context_(context), gl_(context.gl()), limits_(limits), integers_only_(integers_only) {
  context_.make_current();
  gl::Int major = 0, minor = 0;
  gl_.get_integerv(gl::kMajorVersion, &major);
  gl_.get_integerv(gl::kMinorVersion, &minor);
  if (major < 4) {
    throw UnavailableError(
        fmt::format("OpenGL: the exact shader needs version 4.0, for doubles in shaders; {} gives {}.{}", context_.origin(), major, minor));
  }
  require_operations(gl_, ieee_operations(), limits_.max_texture_size_texel);
  vertex_array_ = make_vertex_array(gl_);
  srgb_tables_ = upload_srgb_tables(gl_, limits_.max_texture_size_texel);
}

ExactPipeline::~ExactPipeline() {
  try {
    context_.make_current();
  } catch (const Error&) {
    // Nothing can be deleted without the context; its own end frees the objects.
  }
}

gl::Uint ExactPipeline::use_program(const std::string& vertex_source, const std::string& fragment_source) {
  const auto found = programs_.find(fragment_source);
  if (found != programs_.end()) {
    gl_.use_program(found->second.id());
    return found->second.id();
  }
  GlHandle program = make_program(gl_, vertex_source, fragment_source);
  gl_.use_program(program.id());
  // A location of -1, of a name that the program does not use, is ignored by OpenGL; here and in the functions that follow.
  constexpr std::pair<const char*, int> kUnits[] = {{"vertices", kVerticesUnit}, {"triangles", kTrianglesUnit},   {"ids", kIdsUnit},
                                                    {"image", kExactImageUnit},  {"indexing_map", kExactMapUnit}, {"tables", kTablesUnit},
                                                    {"list", kListUnit}};
  for (const auto& [name, unit] : kUnits) gl_.uniform_1i(gl_.get_uniform_location(program.id(), name), unit);
  gl::check_error(gl_, "preparing an exact shader");
  return programs_.emplace(fragment_source, std::move(program)).first->second.id();
}

void ExactPipeline::set_value_uniforms(gl::Uint program, const Frame& frame, const TargetSpec& target, const Draw& draw,
                                       std::uint32_t group) const {
  const auto location = [&](const char* name) { return gl_.get_uniform_location(program, name); };
  const auto wraps = [&](const char* name, const Sampler& sampler) {
    gl_.uniform_2i(location(name), static_cast<gl::Int>(sampler.wrap_u), static_cast<gl::Int>(sampler.wrap_v));
  };
  gl_.uniform_1i(location("subtexel_bits"), frame.state.subtexel_bits);
  gl_.uniform_1i(location("toward_zero"), frame.state.half_rounding == HalfRounding::toward_zero ? 1 : 0);
  gl_.uniform_1i(location("channels"), target.format.channels);
  gl_.uniform_1ui(location("group"), group);
  wraps("image_wrap", draw.sampler);
  wraps("indexing_map_wrap", draw.map_sampler);
}

void ExactPipeline::bind(int unit, gl::Uint texture) const {
  gl_.active_texture(gl::kTexture0 + static_cast<gl::Enum>(unit));
  gl_.bind_texture(gl::kTexture2d, texture);
}

std::vector<Image> ExactPipeline::draw(const DrawList& list, const Frame& frame) {
  require_size(frame, limits_);
  counters_ = {};
  context_.make_current();
  if (!visibility_ || !visibility_->matches(frame)) {
    visibility_.reset();  // before the new one: both together might not fit into memory
    visibility_ = std::make_unique<VisibilityTarget>(gl_, frame.width, frame.height, limits_.max_texture_size_texel);
  }
  gl_.bind_vertex_array(vertex_array_.id());
  gl_.active_texture(gl::kTexture0 + kVerticesUnit);
  const ExactRecords records = upload_records(gl_, list, frame, limits_.max_texture_size_texel);
  bind(kVerticesUnit, records.vertices.id());
  bind(kTrianglesUnit, records.triangles.id());
  bind(kTablesUnit, srgb_tables_.id());
  bind(kIdsUnit, 0);  // drawn into, not read
  draw_visibility(list, frame);
  bind(kIdsUnit, visibility_->ids());

  std::vector<Image> images;
  ImageTextures textures;
  for (const TargetSpec& target : frame.targets) {
    if (target.content == TargetContent::triangle_id)
      images.push_back(visibility_->read_ids());
    else if (target.content == TargetContent::depth)
      images.push_back(visibility_->read_depth());
    else
      images.push_back(draw_values(records, list, frame, target, textures));
  }
  bind(kIdsUnit, 0);
  return images;
}

void ExactPipeline::draw_visibility(const DrawList& list, const Frame& frame) {
  gl_.disable(gl::kScissorTest);
  visibility_->bind_and_clear();
  set_raster_state(gl_, frame);
  const gl::Uint program = use_program(visibility_vertex_source(), visibility_fragment_source(integers_only_));
  // The viewport's halves are whole texels and powers of two: the shader's float32 arithmetic on them is exact (guard_viewport.h).
  const GuardViewport viewport = guard_viewport(frame);
  const int bits = frame.state.subtexel_bits;
  const auto center = [bits](int origin, int extent) { return (origin + extent / 2) * (1 << bits); };
  const auto inverse = [bits](int extent) { return 1.0f / static_cast<float>((extent / 2) << bits); };
  gl_.uniform_1i(gl_.get_uniform_location(program, "subtexel_bits"), bits);
  gl_.uniform_2i(gl_.get_uniform_location(program, "center"), center(viewport.x, viewport.width), center(viewport.y, viewport.height));
  gl_.uniform_2f(gl_.get_uniform_location(program, "inverse_extent"), inverse(viewport.width), inverse(viewport.height));
  const auto count = static_cast<std::uint32_t>(list.triangles.size());
  for (std::uint32_t first = 0; first < count; first += kTrianglesPerCall) {
    const std::uint32_t end = first + std::min(kTrianglesPerCall, count - first);
    gl_.draw_arrays(gl::kTriangles, static_cast<gl::Int>(3 * first), static_cast<gl::Sizei>(3 * (end - first)));
    gl::check_error(gl_, fmt::format("drawing triangles {} to {}", first, end - 1));
  }
  gl_.disable(gl::kDepthTest);
  gl_.disable(gl::kCullFace);
}

Image ExactPipeline::draw_values(const ExactRecords& records, const DrawList& list, const Frame& frame, const TargetSpec& target,
                                 ImageTextures& images) {
  const ValueTarget values(gl_, frame.width, frame.height, target.format, true);
  values.bind_and_clear(target, frame.state.half_rounding);
  gl_.viewport(0, 0, frame.width, frame.height);
  const bool colored = target.content == TargetContent::color;
  const std::size_t passes = colored ? records.groups.size() : std::min<std::size_t>(records.groups.size(), 1);
  for (std::size_t n = 0; n < passes; ++n) {
    const ShadingGroup& group = records.groups[n];
    const TexelBox box = colored ? group.box : TexelBox{0, 0, frame.width, frame.height};
    if (box.width <= 0 || box.height <= 0) continue;
    const gl::Uint program =
        use_program(value_vertex_source(), value_fragment_source(value_shader(list, target, group.draw), integers_only_));
    set_value_uniforms(program, frame, target, group.draw, static_cast<std::uint32_t>(n));
    bind_group(list, target, group.draw, images);
    gl_.enable(gl::kScissorTest);
    gl_.scissor(box.x, box.y, box.width, box.height);
    gl_.draw_arrays(gl::kTriangles, 0, 3);
    gl_.disable(gl::kScissorTest);
    gl::check_error(gl_, fmt::format("storing the values of {}", to_string(target.content)));
  }
  Image image = values.read();
  if (passes > 0) settle(records, list, frame, target, values.read_flags(), images, image);
  return image;
}

void ExactPipeline::settle(const ExactRecords& records, const DrawList& list, const Frame& frame, const TargetSpec& target,
                           const Image& flags, ImageTextures& images, Image& values) {
  std::vector<std::vector<std::uint32_t>> places(records.groups.size());
  const auto* flag = flags.channels<std::uint32_t>(0, 0);
  for (int y = 0; y < flags.height(); ++y) {
    for (int x = 0; x < flags.width(); ++x, ++flag) {
      if (*flag != 0) places[*flag - 1].push_back(static_cast<std::uint32_t>(x) | static_cast<std::uint32_t>(y) << 16);
    }
  }
  for (std::size_t n = 0; n < places.size(); ++n) {
    if (places[n].empty()) continue;
    const Draw& draw = records.groups[n].draw;
    const gl::Uint program = use_program(value_vertex_source(), exact_value_fragment_source(value_shader(list, target, draw)));
    set_value_uniforms(program, frame, target, draw, static_cast<std::uint32_t>(n));
    bind_group(list, target, draw, images);
    for (std::size_t first = 0; first < places[n].size(); first += kListLength) {
      settle_list(std::span(places[n]).subspan(first, std::min(kListLength, places[n].size() - first)), values);
    }
  }
}

void ExactPipeline::settle_list(std::span<const std::uint32_t> places, Image& values) {
  counters_.undecided += places.size();
  const auto rows = static_cast<int>((places.size() + kListWidth - 1) / kListWidth);
  std::vector<std::uint32_t> padded(places.begin(), places.end());
  padded.resize(static_cast<std::size_t>(rows) * kListWidth, kNoTexel);
  const std::string what = fmt::format("a list of {} texels", places.size());
  gl_.active_texture(gl::kTexture0 + kListUnit);
  const GlHandle texture = make_bits_texture(gl_, kR32ui, kListWidth, rows, padded.data(), limits_.max_texture_size_texel, what);
  const ValueTarget target(gl_, kListWidth, rows, {values.format().type, 4}, false);
  gl_.viewport(0, 0, kListWidth, rows);
  gl_.draw_arrays(gl::kTriangles, 0, 3);
  gl::check_error(gl_, "settling " + what);
  const Image settled = target.read();
  const auto texel_bytes = static_cast<std::size_t>(bytes_per_texel(values.format()));
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::byte* from = settled.texel(static_cast<int>(i % kListWidth), static_cast<int>(i / kListWidth));
    std::memcpy(values.texel(static_cast<int>(places[i] & 0xFFFF), static_cast<int>(places[i] >> 16)), from, texel_bytes);
  }
}

void ExactPipeline::bind_group(const DrawList& list, const TargetSpec& target, const Draw& draw, ImageTextures& images) const {
  if (target.content != TargetContent::color || draw.shading == Shading::vertex_color) return;
  bind_image(list, draw.texture, kExactImageUnit, images);
  if (draw.shading == Shading::indexed) bind_image(list, draw.indexing_map, kExactMapUnit, images);
}

void ExactPipeline::bind_image(const DrawList& list, std::uint32_t image, int unit, ImageTextures& images) const {
  gl_.active_texture(gl::kTexture0 + static_cast<gl::Enum>(unit));
  const auto found = images.find(image);
  if (found != images.end())
    gl_.bind_texture(gl::kTexture2d, found->second.id());
  else
    images.emplace(image, upload_bits(gl_, *list.images[image], limits_.max_texture_size_texel));
}

}  // namespace etalon::gpu
