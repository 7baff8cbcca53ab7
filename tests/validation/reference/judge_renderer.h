// The judge as a Renderer: slow, for small frames; whatever drives a renderer can be driven by it.
#pragma once

#include <cstring>

#include "core/draw/renderer.h"
#include "validation/reference/sample.h"

namespace etalon::validation::reference {

class JudgeRenderer final : public Renderer {
 public:
  explicit JudgeRenderer(Arithmetic arithmetic) : arithmetic_(arithmetic) {}

  [[nodiscard]] std::string name() const override { return "etalon judge"; }
  [[nodiscard]] RasterState supported_state(const RasterState& wanted) const override { return wanted; }
  [[nodiscard]] bool supports(const TargetSpec&) const override { return true; }

  [[nodiscard]] std::vector<Image> render(const DrawList& list, const Frame& frame) override {
    validate(list, frame);
    const Judge judge(list, frame, arithmetic_);
    std::vector<Image> images;
    for (const TargetSpec& target : frame.targets) images.emplace_back(frame.width, frame.height, target.format);
    for (int j = 0; j < frame.height; ++j)
      for (int i = 0; i < frame.width; ++i) {
        const std::vector<TexelBytes> bytes = judge.texel(i, j);
        for (std::size_t n = 0; n < images.size(); ++n)
          std::memcpy(images[n].texel(i, j), bytes[n].data(), static_cast<std::size_t>(bytes_per_texel(images[n].format())));
      }
    return images;
  }

 private:
  Arithmetic arithmetic_;
};

}  // namespace etalon::validation::reference
