// The usual mistakes of a pipeline, each as the drawing that it would have made: what a diagnosis tries on unexplained texels.
// Does: fill rule, half-texel shifts of texture and geometry, flips, wrap, filter, mip levels, exchanged images, colour curves and channels,
// coarse texture coordinates, depth test, interpolation, storage. Does not: draw, or judge.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/draw/draw_list.h"
#include "validation/bounds.h"

namespace etalon::validation {

/// What would have been drawn, and by what.
struct SupposedDrawing {
  DrawList list;
  Frame frame;
  DeviceModel device;
};

/// How the candidate's texels are read under a supposition: as they are, from the highest row down, or with the first channel and the third exchanged.
enum class CandidateReading : std::uint8_t { plain, upside_down, red_blue_exchanged };

struct Mistake {
  std::string name;                                            ///< "wrap clamp", "v flipped", …
  std::vector<std::function<SupposedDrawing()>> alternatives;  ///< a texel that any of them explains is explained
  CandidateReading reading = CandidateReading::plain;
  bool touches_few = false;  ///< only samples near an edge: a handful of texels is what it leaves
  /// Allows more than the mistakes before it and names less: asked only where none of those explains nearly all.
  bool last_resort = false;
};

/// In the order in which they are asked. `list`, `frame` and `device` must outlive the result.
[[nodiscard]] std::vector<Mistake> usual_mistakes(const DrawList& list, const Frame& frame, const DeviceModel& device);

/// Row y of the result is row height − 1 − y; or the first and third channels exchanged.
[[nodiscard]] Image read_as(const Image& image, CandidateReading reading);

}  // namespace etalon::validation
