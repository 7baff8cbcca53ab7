// Light baked into vertex colours, so that a model drawn without lighting looks solid, as a scan's photographs do.
#pragma once

#include "core/procedural/implicit.h"

namespace etalon::procedural {

struct VertexLightOptions {
  Vec3d to_key{0.4, 0.7, 0.6};  ///< direction to the key light; normalised here
  double size = 1;              ///< of the object: how far occluders are looked for
  double strength = 0.6;        ///< 0: none, 1: black where no light falls
};

/// Factor of a colour at a surface point with its unit normal: a share of ambient light that nearby surface takes away (five probes along the
/// normal [Quilez, "ambient occlusion"]), a key light with soft shadow, a weak cool fill from below. Near 1 in the open.
[[nodiscard]] Vec3d vertex_light(Field field, const Vec3d& p, const Vec3d& normal, const VertexLightOptions& options);

}  // namespace etalon::procedural
