// The exact renderer: docs/contract.md, every texel, on CPU threads. Bytes do not depend on threads, compiler or evaluation.
#pragma once

#include "core/draw/renderer.h"
#include "raster/sample_values.h"

namespace etalon::raster {

/// Version of docs/contract.md that this renderer implements; goldens change only with it.
inline constexpr int kRasterContractVersion = 1;

class CpuRenderer : public Renderer {
 public:
  explicit CpuRenderer(Evaluation evaluation = Evaluation::vectorised) : evaluation_(evaluation) {}

  [[nodiscard]] std::string name() const override;
  [[nodiscard]] RasterState supported_state(const RasterState& wanted) const override { return wanted; }
  [[nodiscard]] bool supports(const TargetSpec&) const override { return true; }
  [[nodiscard]] std::vector<Image> render(const DrawList& list, const Frame& frame) override;

  [[nodiscard]] std::unique_ptr<ResidentMap> make_map(Image map, const MapState& state) override;

  /// render() into images of an earlier call: those of the right format and size keep their memory, which saves the system's work of
  /// making fresh pages. Their bytes are unspecified if it throws.
  void render_into(const DrawList& list, const Frame& frame, std::vector<Image>& images);

  /// Of the last render().
  [[nodiscard]] const EvaluationCounters& counters() const { return counters_; }

 private:
  Evaluation evaluation_;
  EvaluationCounters counters_;
};

}  // namespace etalon::raster
