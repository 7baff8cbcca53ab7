// A device whose every freedom is known: what the probe must find out. Snaps positions in double, covers and stores as the exact rasterizer
// does under its own state, interpolates with an error of known size, and looks textures up with coordinates and weights of its own.
#pragma once

#include "core/draw/renderer.h"
#include "raster/cpu_renderer.h"

namespace etalon::test {

struct SimulatedArithmetic {
  int subtexel_bits = 8;
  SnapRounding snap = SnapRounding::nearest_even;
  FillRule fill_rule = FillRule::left_ymin;
  HalfRounding half_rounding = HalfRounding::nearest_even;
  int coordinate_bits = 0;          ///< of a nearest lookup's coordinate, rounded to the nearest; 0: exact
  int weight_bits = 0;              ///< of the linear filter; 0: exact
  bool weights_rounded = true;      ///< or truncated
  bool byte_results = false;        ///< a filtered texture of bytes gives bytes
  double interpolation_error = 0;   ///< of coordinates, in units of the derived bound
  bool dropped_edge_texel = false;  ///< one texel of every frame is not drawn: no rule explains its coverage
  bool half_up_halves = false;      ///< halves rounded by neither rule
};

class SimulatedDevice : public Renderer {
 public:
  explicit SimulatedDevice(const SimulatedArithmetic& arithmetic) : arithmetic_(arithmetic) {}
  [[nodiscard]] std::string name() const override { return "simulated"; }
  [[nodiscard]] RasterState supported_state(const RasterState& wanted) const override { return wanted; }
  [[nodiscard]] bool supports(const TargetSpec&) const override { return true; }
  [[nodiscard]] std::vector<Image> render(const DrawList& list, const Frame& frame) override;

 private:
  [[nodiscard]] DrawList on_own_grid(DrawList list, int bits) const;
  [[nodiscard]] Image shaded(const DrawList& list, const Frame& frame, const TargetSpec& target);
  [[nodiscard]] double looked_up(const Image& image, const Sampler& sampler, double u, double v) const;
  void disturb(Image& coordinates, const Image& ids, const DrawList& list, const Frame& frame) const;

  SimulatedArithmetic arithmetic_;
  raster::CpuRenderer exact_;
};

}  // namespace etalon::test
