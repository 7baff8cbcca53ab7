#include "core/procedural/monkey.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/procedural/colored_mesh.h"
#include "core/procedural/monkey_paint.h"
#include "core/procedural/monkey_shape.h"

namespace etalon::procedural {

Mesh make_monkey(const MonkeyOptions& options) {
  if (options.faces < 20'000 || options.faces > 10'000'000 || options.faces % 2 != 0)
    throw InputError(fmt::format("monkey: faces: expected an even number, 20000 to 10000000, got {}", options.faces));
  IsoMeshOptions how;
  how.lattice = {.field = monkey_field, .lo = {-1.7, -1.5, -1.4}, .hi = {1.7, 1.5, 1.6}, .seed = {0, 0.1, 0}};
  how.faces = static_cast<std::size_t>(options.faces);
  how.progress = options.progress;
  const IsoTriangles surface = make_iso_mesh(how);
  return colored_mesh(surface.positions, surface.faces, monkey_color);
}

}  // namespace etalon::procedural
