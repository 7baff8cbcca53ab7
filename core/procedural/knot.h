// A displaced torus knot with vertex colours: as large as wanted, closed, of genus 1, full of detail in form and colour. For simplification
// and for benchmarks.
#pragma once

#include "core/mesh/mesh.h"

namespace etalon::procedural {

struct KnotOptions {
  int rings = 500;   ///< cross sections along the knot, 12..20,000
  int around = 100;  ///< vertices of a cross section, 3..4,000
};

/// The options whose mesh comes nearest to `faces` triangles with five times as many rings as vertices around: 250 to 10,000,000, else
/// InputError. 100,000 gives 500 × 100.
[[nodiscard]] KnotOptions knot_of_faces(int faces);

/// The (2, 3) torus knot ((2 + cos 3t) cos 2t, (2 + cos 3t) sin 2t, sin 3t), t in turns, as a tube of radius 0.45 that six octaves of value
/// noise (amplitude 0.06) and small ribs displace; rings·around vertices, 2·rings·around triangles, counter-clockwise seen from outside;
/// marbled and chequered vertex colours; no texture coordinates: wedge i is vertex i. Equal bytes for any thread count. InputError
/// where an option is out of range.
[[nodiscard]] Mesh make_knot(const KnotOptions& options = {});

}  // namespace etalon::procedural
