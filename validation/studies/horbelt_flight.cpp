#include "validation/studies/horbelt_flight.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/joint/exhaustive_search.h"
#include "core/joint/marginal_analysis.h"
#include "validation/joint/terrain_problem.h"
#include "validation/metrics/decibel.h"

namespace etalon::validation {
namespace {

// East and south of the terrain's middle, in halves of its side.
struct Place {
  double east, south;
};
constexpr Place kEyes[] = {{-1.0, 1.1}, {0.6, 1.2}, {0.9, -0.3}};
constexpr Place kTargets[] = {{0.1, 0.1}, {-0.1, -0.1}, {-0.3, -0.6}};
constexpr double kAbove = 0.35;  // the highest point

// A quadratic Bézier curve.
Place on_curve(const Place (&p)[3], double t) {
  const auto at = [t](double a, double b, double c) { return (1 - t) * (1 - t) * a + 2 * t * (1 - t) * b + t * t * c; };
  return {at(p[0].east, p[1].east, p[2].east), at(p[0].south, p[1].south, p[2].south)};
}

FlightFrame frame_of(Renderer& renderer, const terrain::HeightField& field, const Image& image, const terrain::TerrainView& view,
                     const FlightOptions& options) {
  TerrainProblem terrain(renderer, field, image, view, options.levels);
  const joint::Problem problem = terrain.problem();
  const joint::Path path = joint::marginal_analysis(problem);
  FlightFrame frame{.view = view};
  const joint::PathPoint* chosen = joint::point_within(path, options.budget_bits);
  frame.is_over_budget = chosen == nullptr;
  frame.pair = frame.is_over_budget ? path.points.front().pair : chosen->pair;
  frame.mesh_bits = problem.mesh_bits[frame.pair.mesh], frame.texture_bits = problem.texture_bits[frame.pair.texture];
  frame.evaluations = path.evaluations;
  // Along the border a path has no errors of its own.
  const std::uint64_t error = terrain.errors().sse(frame.pair.mesh, frame.pair.texture);
  frame.psnr_db = psnr_db(static_cast<double>(error), terrain.errors().samples(), 255);
  frame.picture = without_alpha(terrain.errors().picture(frame.pair.mesh, frame.pair.texture));
  return frame;
}

}  // namespace

std::vector<terrain::TerrainView> flight_views(const terrain::HeightField& field, std::size_t frames, int width, int height) {
  const auto [lowest, highest] = std::ranges::minmax(field.heights);
  const double half = field.steps() * field.spacing / 2;
  std::vector<terrain::TerrainView> views;
  for (std::size_t n = 0; n < frames; ++n) {
    const double t = frames == 1 ? 0.5 : static_cast<double>(n) / static_cast<double>(frames - 1);
    const Place eye = on_curve(kEyes, t), target = on_curve(kTargets, t);
    terrain::TerrainView view;
    view.eye = {eye.east * half, highest * field.unit + kAbove * half, eye.south * half};
    view.target = {target.east * half, (lowest + highest) / 2.0 * field.unit, target.south * half};
    view.tan_half_fov_y = 0.5;
    view.near = half / 128, view.far = 8 * half;
    view.width = width, view.height = height;
    views.push_back(view);
  }
  return views;
}

std::vector<FlightFrame> fly_over(Renderer& renderer, const terrain::HeightField& field, const Image& image, const FlightOptions& options) {
  std::vector<FlightFrame> frames;
  for (const terrain::TerrainView& view : flight_views(field, options.frames, options.width, options.height)) {
    if (options.before_frame) options.before_frame(frames.size());
    frames.push_back(frame_of(renderer, field, image, view, options));
  }
  return frames;
}

Image contact_sheet(const std::vector<FlightFrame>& frames) {
  constexpr int kColumns = 4, kBorder = 2;
  ETALON_CHECK(!frames.empty(), "frames");
  const int count = static_cast<int>(frames.size()), columns = std::min(kColumns, count), rows = (count + kColumns - 1) / kColumns;
  const int width = frames.front().picture.width(), height = frames.front().picture.height();
  Image sheet(columns * (width + kBorder) + kBorder, rows * (height + kBorder) + kBorder, kRgb8);
  for (int y = 0; y < sheet.height(); ++y) std::fill_n(sheet.texel(0, y), sheet.width() * 3, std::byte{255});
  for (int n = 0; n < count; ++n) {
    const Image& picture = frames[static_cast<std::size_t>(n)].picture;
    ETALON_CHECK(picture.width() == width && picture.height() == height, fmt::to_string(n));
    const int x0 = kBorder + n % kColumns * (width + kBorder);
    const int top = kBorder + n / kColumns * (height + kBorder);  // rows of texels from above; row 0 of an image is the lowest
    for (int y = 0; y < height; ++y)
      std::copy_n(picture.texel(0, height - 1 - y), 3 * width, sheet.texel(x0, sheet.height() - 1 - (top + y)));
  }
  return sheet;
}

}  // namespace etalon::validation
