#include "core/procedural/statue.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/procedural/colored_mesh.h"
#include "core/procedural/statue_paint.h"
#include "core/procedural/statue_shape.h"

namespace etalon::procedural {

Mesh make_statue(const StatueOptions& options) {
  if (options.faces < 40'000 || options.faces > 10'000'000 || options.faces % 2 != 0)
    throw InputError(fmt::format("statue: faces: expected an even number, 40000 to 10000000, got {}", options.faces));
  IsoMeshOptions how;
  how.lattice = {.field = statue_field, .lo = {-1.2, -1.0, -1.2}, .hi = {1.2, 3.9, 1.2}, .seed = {0, 1.0, 0}};
  how.faces = static_cast<std::size_t>(options.faces);
  how.progress = options.progress;
  const IsoTriangles surface = make_iso_mesh(how);
  return colored_mesh(surface.positions, surface.faces, statue_color);
}

}  // namespace etalon::procedural
