#include "validation/studies/chen_levels.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/adapt/adapt_map.h"
#include "core/adapt/analytic_map.h"
#include "core/adapt/rebake.h"
#include "core/adapt/resolve_texture.h"
#include "core/simplify/simplify.h"

namespace etalon::validation {
namespace {

simplify::SimplifyOptions how(simplify::MetricName metric, std::size_t faces) {
  simplify::SimplifyOptions options;
  options.metric = metric;
  options.target_faces = faces;
  return options;
}

}  // namespace

ChenLevels make_chen_levels(Renderer& renderer, const Mesh& mesh, const std::vector<const Image*>& textures,
                            const std::vector<std::size_t>& levels, int map_size, const std::function<void(const std::string&)>& step) {
  step("collapses and cells");
  progressive::ProgressiveMesh made(progressive::make_progressive(mesh, how(simplify::MetricName::qem5, levels.back())).data);
  adapt::AdaptSequence sequence(made);
  adapt::ChartBorders borders(made);
  ChenLevels result{std::move(made), std::move(sequence), std::move(borders), {}};
  Image map = adapt::identity_map(map_size, map_size);
  adapt::Gutter map_gutter(result.borders, map_size, map_size);
  std::vector<Image> adapted;
  std::vector<adapt::Gutter> gutters;
  for (const Image* texture : textures)
    adapted.push_back(*texture), gutters.emplace_back(result.borders, texture->width(), texture->height());
  const TriangleTree tree(mesh);
  std::size_t from = result.sequence.size();
  for (const std::size_t faces : levels) {
    ChenLevel level;
    result.mesh.go_to_faces(faces);
    level.level = result.mesh.level();
    level.mesh = result.mesh.mesh();
    step(fmt::format("{} faces: adaptation", level.mesh.face_count()));
    (void)adapt::adapt_map(renderer, result.sequence, from, level.level, map, {.gutter = &map_gutter});
    level.map = std::make_shared<const Image>(map);
    for (std::size_t t = 0; t < textures.size(); ++t) {
      (void)adapt::adapt_map(renderer, result.sequence, from, level.level, adapted[t], {.gutter = &gutters[t]});
      level.adapted.push_back(std::make_shared<const Image>(adapted[t]));
    }
    from = level.level;
    step(fmt::format("{} faces: rivals", level.mesh.face_count()));
    level.analytic = std::make_shared<const Image>(adapt::analytic_with_gutter(result.sequence, level.level, map, map_gutter));
    level.by_deviation = simplify::simplify_mesh(mesh, how(simplify::MetricName::aps, level.mesh.face_count())).mesh;
    std::vector<Image> rebakes;  // one a size
    for (const Image* texture : textures) {
      const auto same_size = [&](const Image& map_of_size) {
        return map_of_size.width() == texture->width() && map_of_size.height() == texture->height();
      };
      if (std::none_of(rebakes.begin(), rebakes.end(), same_size))
        rebakes.push_back(adapt::rebake_map(renderer, mesh, tree, level.mesh, {.width = texture->width(), .height = texture->height()}));
      const Image& rebake = *std::find_if(rebakes.begin(), rebakes.end(), same_size);
      level.rebaked.push_back(std::make_shared<const Image>(adapt::resolve_texture(renderer, *texture, rebake, Filter::nearest)));
    }
    result.levels.push_back(std::move(level));
  }
  return result;
}

}  // namespace etalon::validation
