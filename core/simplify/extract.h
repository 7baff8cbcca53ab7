// From the engine's triangles back to a mesh.
#pragma once

#include "core/simplify/simplify.h"

namespace etalon::simplify {

/// Fills mesh, source_vertex and source_face of the result: what is alive, in the order of the input.
void extract(const CollapseMesh& triangles, SimplifyResult& result);

}  // namespace etalon::simplify
