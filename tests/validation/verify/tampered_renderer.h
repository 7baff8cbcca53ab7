// A device of our own making, for defects that a job must see.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "raster/cpu_renderer.h"

namespace etalon::test {

/// The exact renderer, which draws something else.
class TamperedRenderer : public Renderer {
 public:
  explicit TamperedRenderer(std::function<void(DrawList&)> tamper = {}) : tamper_(std::move(tamper)) {}
  [[nodiscard]] std::string name() const override { return "tampered"; }
  [[nodiscard]] RasterState supported_state(const RasterState& wanted) const override { return wanted; }
  [[nodiscard]] bool supports(const TargetSpec&) const override { return true; }
  [[nodiscard]] std::vector<Image> render(const DrawList& list, const Frame& frame) override {
    DrawList other = list;
    if (tamper_) tamper_(other);
    return exact_.render(other, frame);
  }

 private:
  std::function<void(DrawList&)> tamper_;
  raster::CpuRenderer exact_;
};

}  // namespace etalon::test
