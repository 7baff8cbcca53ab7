// What both renderers implement, and a user's own may: a draw list in, images out. Whatever drives drawing takes a Renderer&.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/draw/draw_list.h"
#include "core/draw/resident_map.h"

namespace etalon {

class Renderer {
 public:
  virtual ~Renderer() = default;

  /// "etalon cpu", or the device's own words: "llvmpipe (LLVM 15.0.6, 256 bits), Mesa 22.3.6".
  [[nodiscard]] virtual std::string name() const = 0;

  /// The state this renderer actually draws with when asked for `wanted`: a device has its own sub-texel bits, fill rule and half rounding.
  [[nodiscard]] virtual RasterState supported_state(const RasterState& wanted) const = 0;

  [[nodiscard]] virtual bool supports(const TargetSpec& target) const = 0;

  /// Draws the whole list, once; returns one image per target of the frame, in order.
  /// InputError: validate() refuses. UnavailableError: a target or a state that this renderer does not support, or the device's memory is full.
  [[nodiscard]] virtual std::vector<Image> render(const DrawList& list, const Frame& frame) = 0;

  /// Takes a map of colours (any format but uint32) for passes over itself; what they leave is what render() of each pass's list would give.
  /// InputError, UnavailableError: as render().
  [[nodiscard]] virtual std::unique_ptr<ResidentMap> make_map(Image map, const MapState& state);
};

}  // namespace etalon
