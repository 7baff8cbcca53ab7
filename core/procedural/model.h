// A procedural input: a mesh and the image its texture coordinates refer to.
#pragma once

#include <string>

#include "core/image/image.h"
#include "core/mesh/mesh.h"

namespace etalon::procedural {

struct Model {
  Mesh mesh;         ///< float32 positions and uv in [0, 1]; has_uv is set; one material
  Image texture;     ///< RGB unorm8, row 0 is v = 0
  std::string name;  ///< "swirl", "head": what `etalon make` calls it
};

}  // namespace etalon::procedural
