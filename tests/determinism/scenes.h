// A fixed set of drawings that together visit every decision and every storage format of the rasterizer.
#pragma once

#include <string>
#include <vector>

#include "core/draw/draw_list.h"

namespace etalon::test {

struct NamedScene {
  std::string name;
  DrawList list;
  Frame frame;
};

/// The same scenes on every machine: seeded triangles (affine and perspective, slivers, shared edges, exact ties) through all filters, wraps,
/// sub-texel bits, fill rules and target formats, and the procedural models through camera, clip and snap.
[[nodiscard]] std::vector<NamedScene> determinism_scenes();

}  // namespace etalon::test
