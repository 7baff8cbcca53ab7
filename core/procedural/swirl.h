// The curved grid with swirled texture coordinates of [Chen & Chuang 2006, fig. 15]: the hardest input of texture adaptation,
// since no simplified mesh can follow its swirl lines by interpolating texture coordinates.
#pragma once

#include "core/procedural/model.h"

namespace etalon::procedural {

struct SwirlOptions {
  int faces = 7688;  ///< approximate: the grid has n × n cells, n = √(faces/2) rounded; 2..2,000,000. 7,688 gives the paper's 62 × 62
  int texture_size = 1024;  ///< texels on a side, 16..8192
};

/// A height field over [-1, 1]² in x and y that looks toward +Z, (n+1)² vertices, one wedge each, 2n² counter-clockwise faces. Texture
/// coordinates: ((x+1)/2, (y+1)/2), turned about (½, ½) by 0.4·min(1, n/24)·(1 − 4r²)² turns at distance r < ½, unmoved outside: inside
/// [0, 1]² and, at every n tested (2..120), without folds. InputError where an option is out of range.
[[nodiscard]] Model make_swirl(const SwirlOptions& options = {});

}  // namespace etalon::procedural
