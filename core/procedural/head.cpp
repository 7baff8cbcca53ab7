#include "core/procedural/head.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/procedural/atlas_bake.h"
#include "core/procedural/head_atlas.h"
#include "core/procedural/head_paint.h"
#include "core/procedural/head_shape.h"

namespace etalon::procedural {

Model make_head(const HeadOptions& options) {
  if (options.faces < 72 || options.faces > 2'000'000)
    throw InputError(fmt::format("head: faces: expected 72 to 2000000, got {}", options.faces));
  if (options.texture_size < 64 || options.texture_size > 8192)
    throw InputError(fmt::format("head: texture size: expected 64 to 8192, got {}", options.texture_size));

  TubeOptions tube_options;
  tube_options.faces = static_cast<std::uint32_t>(options.faces);
  tube_options.field = head_field;
  tube_options.density = head_density;
  tube_options.spine = head_spine;
  const TubeMesh tube = wrap_tube(tube_options);

  Model model;
  model.name = "head";
  model.mesh = unwrapped_head(tube);
  std::vector<HeadLight> lights(tube.positions.size());
  parallel_for_blocks(lights.size(), 32, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) lights[v] = head_light_at(tube.positions[v]);
  });
  const Mesh& mesh = model.mesh;
  model.texture =
      bake_atlas(mesh, options.texture_size, 6 * options.texture_size / 1024 + 2, Vec3d(0.13, 0.16, 0.19), [&](const TexelOnFace& texel) {
        Vec3d p(0, 0, 0);
        HeadLight light{0, 0};
        for (int k = 0; k < 3; ++k) {
          const std::uint32_t v = mesh.vertex(texel.face, k).index;
          p += tube.positions[v] * texel.weight[k];
          light.sky += lights[v].sky * texel.weight[k];
          light.key += lights[v].key * texel.weight[k];
        }
        return head_color(p, light);
      });
  return model;
}

}  // namespace etalon::procedural
