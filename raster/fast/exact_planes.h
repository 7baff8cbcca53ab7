// The cheap way through true ties: where a triangle maps texels to texels by short dyadic numbers (shifts, scalings by powers of two,
// turns by quarters), its planes are exact in double, and a sample on a border between texels is decided like any other.
#pragma once

#include "core/draw/draw_list.h"
#include "raster/fast/planes.h"

namespace etalon::raster::fast {

/// Makes the planes of u and v exact where their numbers allow it: then value, and value times any image size, have no rounding at any
/// sample of the tile, fused or not, and the plane's error is negative, of no size. Returns whether some plane became exact.
bool make_uv_planes_exact(const DrawList& list, std::uint32_t t, const Frame& frame, const Tile& tile, const PlaneLayout& layout,
                          double* planes);

}  // namespace etalon::raster::fast
