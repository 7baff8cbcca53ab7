// Triangles in clip space into a draw list: clip, then snap (docs/contract.md#clip-then-snap). The one place where that is done, for meshes
// and for draws that come from outside.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/draw/clip.h"
#include "core/draw/draw_list.h"

namespace etalon {

/// A vertex that no triangle has to be cut at enters the list once, when first used; where a triangle is cut, its polygon's vertices are new.
class ClipPlacer {
 public:
  /// All three must outlive this. `frame` is valid; coordinates of the vertices are finite, and `order` is set: it decides from which
  /// end an edge is cut.
  ClipPlacer(std::span<const ClipVertex> vertices, const Frame& frame, DrawList& list);

  /// Appends the triangle of these vertices, as the 0 to 9 triangles that are left of it, in its orientation; the caller keeps the draws. InputError as snap().
  void add(const std::array<std::uint32_t, 3>& corners);

 private:
  [[nodiscard]] std::uint32_t add_vertex(const ClipVertex& v);
  std::span<const ClipVertex> vertices_;
  const Frame& frame_;
  DrawList& list_;
  std::array<ClipPlane, 8> planes_;
  std::vector<std::uint32_t> placed_;  // index in the list of each vertex, or none yet
};

}  // namespace etalon
