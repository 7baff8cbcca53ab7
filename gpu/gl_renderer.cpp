#include "gpu/gl_renderer.h"

#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "core/base/error.h"
#include "gpu/gl_format.h"
#include "gpu/gl_map.h"

namespace etalon::gpu {

namespace {

bool is_real_target(PixelFormat format, bool srgb) {
  return (srgb || format.type != ChannelType::srgb8) && format.type != ChannelType::uint32 && format.channels >= 1 && format.channels <= 4;
}

}  // namespace

std::string to_string(ShaderMode mode) { return mode == ShaderMode::exact ? "exact" : "native"; }

GlRenderer::GlRenderer(std::unique_ptr<Context> context, ShaderMode mode) : context_(std::move(context)) {
  pipeline_ = std::make_unique<GlPipeline>(*context_);
  device_ = probe(*context_, *pipeline_);
  if (mode == ShaderMode::exact) exact_ = std::make_unique<ExactPipeline>(*context_, device_.limits);
}

GlRenderer::GlRenderer(const ContextOptions& options, ShaderMode mode) : GlRenderer(make_context(options), mode) {}

GlRenderer::~GlRenderer() = default;

std::string GlRenderer::name() const { return exact_ ? device_.name() + ", exact shader" : device_.name(); }

RasterState GlRenderer::supported_state(const RasterState& wanted) const {
  RasterState state = wanted;
  state.subtexel_bits = std::min(wanted.subtexel_bits, device_.subtexel_bits);
  state.fill_rule = device_.fill_rule.value_or(wanted.fill_rule);
  if (exact_)
    state.subtexel_bits = std::min(state.subtexel_bits, kExactSubtexelBits);
  else
    state.half_rounding = device_.half_rounding;
  return state;
}

bool GlRenderer::supports(const TargetSpec& target) const {
  switch (target.content) {
    case TargetContent::color: return is_real_target(target.format, exact_ != nullptr);
    case TargetContent::triangle_id: return target.format == kR32ui;
    case TargetContent::barycentrics: return is_real_target(target.format, exact_ != nullptr) && target.format.channels == 3;
    case TargetContent::coordinate: return is_real_target(target.format, exact_ != nullptr) && target.format.channels == 2;
    case TargetContent::depth: return target.format == kR32f;
    case TargetContent::margins:
    case TargetContent::bound_terms: return false;
  }
  return false;
}

std::vector<Image> GlRenderer::render(const DrawList& list, const Frame& frame) {
  validate(list, frame);
  require_support(frame);
  return exact_ ? exact_->draw(list, frame) : pipeline_->draw(list, frame);
}

std::unique_ptr<ResidentMap> GlRenderer::make_map(Image map, const MapState& state) {
  const PixelFormat format = map.format();
  require_support(map_frame(map.width(), map.height(), format, state));
  if (exact_ || format.type == ChannelType::srgb8 || stored_target_format(format) != format)
    return make_rendered_map(*this, std::move(map), state);
  return std::make_unique<GlMap>(*context_, device_.limits, map, state);
}

void GlRenderer::require_support(const Frame& frame) const {
  for (const TargetSpec& target : frame.targets) {
    if (!supports(target)) {
      throw UnavailableError(fmt::format("{} does not draw {} into {}", name(), to_string(target.content), to_string(target.format)));
    }
  }
  const RasterState state = supported_state(frame.state);
  if (state.subtexel_bits != frame.state.subtexel_bits) {
    throw UnavailableError(
        fmt::format("{} has {} sub-texel bits, the frame asks for {}", name(), state.subtexel_bits, frame.state.subtexel_bits));
  }
  if (!device_.fill_rule) throw UnavailableError(fmt::format("{} fills edges by none of the four rules", name()));
  if (state.fill_rule != frame.state.fill_rule) {
    throw UnavailableError(
        fmt::format("{} fills edges by {}, the frame asks for {}", name(), to_string(state.fill_rule), to_string(frame.state.fill_rule)));
  }
  const bool stores_half = std::any_of(frame.targets.begin(), frame.targets.end(),
                                       [](const TargetSpec& target) { return target.format.type == ChannelType::half; });
  if (stores_half && state.half_rounding != frame.state.half_rounding) {
    throw UnavailableError(fmt::format("{} rounds halves {}, the frame asks for {}", name(), to_string(state.half_rounding),
                                       to_string(frame.state.half_rounding)));
  }
}

}  // namespace etalon::gpu
