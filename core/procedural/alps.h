// Alpine terrain with an orthophoto, for the joint compression of [Horbelt, Balmelli & Vetterli]: valleys that rivers have cut, a lake, meadows,
// forest, rock and snow. Nobody's real place.
#pragma once

#include "core/image/image.h"
#include "core/procedural/iso_mesh.h"

namespace etalon::procedural {

struct AlpsOptions {
  int size = 257;           ///< heights on a side: 2^k+1, k 5..12; the same place whatever the size
  int texture_size = 1024;  ///< texels on a side, 64..8192
  std::uint64_t seed = 1;   ///< another place
  ProcedureProgress progress;
};

struct Alps {
  Image dem;           ///< float32, metres; row 0 is v = 0, the south
  Image texture;       ///< RGB unorm8 of the same extent: texel and height samples are centres of equal squares of it
  double spacing = 0;  ///< metres between neighbouring heights: 5120/(size − 1)
};

/// 5.1 km on a side, about 900 m from the lake to the highest top. Equal bytes for any thread count. InputError where an option is out of range.
[[nodiscard]] Alps make_alps(const AlpsOptions& options = {});

}  // namespace etalon::procedural
