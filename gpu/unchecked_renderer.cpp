#include "gpu/unchecked_renderer.h"

#include <fmt/core.h>

#include "core/base/error.h"

namespace etalon::gpu {

UncheckedRenderer::UncheckedRenderer(const ContextOptions& options) : context_(make_context(options)) {
  pipeline_ = std::make_unique<GlPipeline>(*context_);
  device_ = probe(*context_, *pipeline_);
}

UncheckedRenderer::~UncheckedRenderer() = default;

bool UncheckedRenderer::supports(const TargetSpec& target) const {
  return target.content != TargetContent::margins && target.content != TargetContent::bound_terms &&
         target.format.type != ChannelType::srgb8;
}

std::vector<Image> UncheckedRenderer::render(const DrawList& list, const Frame& frame) {
  validate(list, frame);
  for (const TargetSpec& target : frame.targets)
    if (!supports(target))
      throw UnavailableError(fmt::format("{} does not draw {} into {}", name(), to_string(target.content), to_string(target.format)));
  return pipeline_->draw(list, frame);
}

}  // namespace etalon::gpu
