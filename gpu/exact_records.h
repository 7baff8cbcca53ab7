// A draw list as the exact shaders read it: vertices, triangles and groups in integer textures.
#pragma once

#include <vector>

#include "core/draw/draw_list.h"
#include "gpu/gl_objects.h"

namespace etalon::gpu {

/// A rectangle of the frame, texels; empty where a size is not positive.
struct TexelBox {
  int x = 0, y = 0, width = 0, height = 0;
};

/// Triangles of equal shading, image and sampler: their values come from one program.
struct ShadingGroup {
  Draw draw;     ///< of any of them; its range of triangles means nothing
  TexelBox box;  ///< holds all their samples
};

struct ExactRecords {
  GlHandle vertices;   ///< three RGBA uint32 texels a vertex, rows of kRecordWidth (exact_shaders.h); attributes and z canonical
  GlHandle triangles;  ///< one RGBA uint32 texel a triangle: vertex indices and group
  std::vector<ShadingGroup> groups;
};

/// Uploads a valid list. UnavailableError where its textures exceed `max_size` rows, 2^31 bytes or the device's memory.
[[nodiscard]] ExactRecords upload_records(const gl::Api& gl, const DrawList& list, const Frame& frame, int max_size);

}  // namespace etalon::gpu
