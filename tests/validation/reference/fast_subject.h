// The fast path before the judge, at every SIMD level of this machine at once: the levels must agree before one of them is judged.
#pragma once

#include <string>
#include <vector>

#include "core/draw/renderer.h"
#include "tests/validation/reference/subject.h"

namespace etalon::validation::reference {

/// raster/fast, one row of eight texels of one triangle at a time, at every level. InternalError where two levels disagree.
[[nodiscard]] MakeSubject fast_subject();

/// CpuRenderer, vectorised, at every level; the images of the last. InternalError where two levels disagree.
class EveryLevelRenderer final : public Renderer {
 public:
  [[nodiscard]] std::string name() const override { return "etalon cpu, every SIMD level"; }
  [[nodiscard]] RasterState supported_state(const RasterState& wanted) const override { return wanted; }
  [[nodiscard]] bool supports(const TargetSpec&) const override { return true; }
  [[nodiscard]] std::vector<Image> render(const DrawList& list, const Frame& frame) override;
};

}  // namespace etalon::validation::reference
