#include "validation/joint/terrain_views.h"

#include <algorithm>
#include <cmath>

#include "validation/joint/terrain_problem.h"

namespace etalon::validation {
namespace {

// Places in halves of the terrain's side from its middle, east and south; heights above the ground in the same unit.
struct Stand {
  const char* name;
  const char* title;
  double east, south, above;
  double target_east, target_south;
  double tan_half_fov_y;
};
constexpr Stand kValley{"valley", "a tenth of the terrain", -0.05, 0.55, 0.12, 0.1, -0.1, 0.4};
constexpr Stand kOverview{"overview", "the whole terrain from the south", 0, 1.9, 1.3, 0, 0.05, 0.5};
constexpr Stand kOthers[] = {{"above", "from above", 0.1, 0.16, 2.2, 0.1, 0.15, 0.5},
                             {"ridge", "over the land from its corner", -0.8, 0.8, 0.2, 0.3, -0.3, 0.5},
                             {"slope", "down from the other side", 0.5, -0.6, 0.2, 0.3, -0.2, 0.5}};

double ground(const terrain::HeightField& field, double east, double south) {
  const auto at = [&](double place) { return static_cast<int>(std::lround(std::clamp((place + 1) / 2, 0.0, 1.0) * field.steps())); };
  return field.height(at(east), at(-south)) * field.unit;
}

NamedTerrainView view_from(const Stand& stand, const terrain::HeightField& field, int width, int height) {
  const double half = field.steps() * field.spacing / 2;
  NamedTerrainView result{stand.name, stand.title, {}};
  terrain::TerrainView& view = result.view;
  view.eye = {stand.east * half, ground(field, stand.east, stand.south) + stand.above * half, stand.south * half};
  view.target = {stand.target_east * half, ground(field, stand.target_east, stand.target_south), stand.target_south * half};
  view.up = {0, 1, 0};
  view.tan_half_fov_y = stand.tan_half_fov_y;
  view.near = half / 128, view.far = 8 * half;
  view.width = width, view.height = height;
  return result;
}

}  // namespace

NamedTerrainView terrain_overview(const terrain::HeightField& field, int width, int height) {
  return view_from(kOverview, field, width, height);
}

std::vector<NamedTerrainView> terrain_views(Renderer& renderer, const terrain::HeightField& field, int width, int height) {
  constexpr int kHalvings = 10;
  std::vector<NamedTerrainView> views = {view_from(kValley, field, width, height), terrain_overview(field, width, height)};
  const Mesh mesh = full_mesh(field);
  Stand valley = kValley;
  double low = 0x1p-6, high = 4;
  for (int n = 0; n < kHalvings; ++n) {
    valley.above = (low + high) / 2;
    views.front() = view_from(valley, field, width, height);
    const std::size_t seen = visible_triangles(renderer, mesh, picture_frame(views.front().view));
    (10 * seen < mesh.faces.size() ? low : high) = valley.above;
  }
  for (const Stand& stand : kOthers) views.push_back(view_from(stand, field, width, height));
  return views;
}

}  // namespace etalon::validation
