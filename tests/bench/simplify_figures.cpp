#include "tests/bench/simplify_figures.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "tests/bench/timing.h"

namespace etalon::bench {
namespace {

constexpr const char* kOurs = "ours-qem";
constexpr const char* kOursFull = "ours-qem-full";

/// One figure from two ways; nothing where the scene does not have both.
template <class Values>
void add(std::vector<Figure>& figures, const SimplifySceneResult& result, Figure figure, const char* a, const char* b,
         const Values& values) {
  const WayResult *first = result.way(a), *second = result.way(b);
  if (first == nullptr || second == nullptr) return;
  figure.skipped = !first->skipped.empty() ? first->skipped : second->skipped;
  if (figure.skipped.empty()) figure.values = values(*first, *second);
  figures.push_back(std::move(figure));
}

std::vector<double> times(const WayResult& a, const WayResult& b) { return ratios(a.seconds, b.seconds); }
std::vector<double> peaks(const WayResult& a, const WayResult& b) { return {median(a.peak_bytes) / median(b.peak_bytes)}; }
/// Coordinates are float32: what is below half a unit of the last place of the diagonal is their rounding, and counts as that.
std::vector<double> distances(const WayResult& a, const WayResult& b) { return {std::max(a.rms, 0x1p-24) / std::max(b.rms, 0x1p-24)}; }

}  // namespace

const std::vector<MetroRow>& metro_rows() {
  static const std::vector<MetroRow> rows{{"meshopt", "meshoptimizer 0.18", 0.0689, 0.0527},
                                          {"cgal-gh", "CGAL 5.5", 0.0562, 0.0436},
                                          {"openmesh", "OpenMesh 9", 0.0700, 0.0528}};
  return rows;
}

const std::vector<ColourRow>& published_colour_rows() {
  static const std::vector<ColourRow> rows{
      {"meshoptimizer, colour of the kept vertex", 0.0731, 0.0822}, {"meshopt_simplifyWithAttributes, weight 0.5", 0.0779, 0.0591},
      {"meshopt_simplifyWithAttributes, weight 1", 0.0865, 0.0475}, {"meshopt_simplifyWithAttributes, weight 2", 0.1049, 0.0412},
      {"meshopt_simplifyWithUpdate, weight 0.1", 0.0593, 0.0639},   {"meshopt_simplifyWithUpdate, weight 0.5", 0.0646, 0.0475},
      {"meshopt_simplifyWithUpdate, weight 1", 0.0736, 0.0380},     {"meshopt_simplifyWithUpdate, weight 2", 0.0874, 0.0330},
      {"Hoppe's MeshSimplify -minqem -colfac 0.1", 0.0844, 0.0315}, {"Hoppe's MeshSimplify -minqem -colfac 0.3", 0.1087, 0.0303}};
  return rows;
}

std::size_t rows_better_in_both(double rms, double colour_rms) {
  return static_cast<std::size_t>(std::ranges::count_if(
      published_colour_rows(), [&](const ColourRow& row) { return row.rms_percent < 100 * rms && row.colour_rms < colour_rms; }));
}

std::vector<Figure> figures_of(const SimplifySceneResult& result) {
  std::vector<Figure> figures;
  const bool large = result.faces_in > 1'000'000;
  add(figures, result, {.title = "time: CGAL ÷ ours", .goal = large ? 6.0 : 5.0, .sense = Sense::at_least}, "cgal-gh", kOurs, times);
  add(figures, result, {.title = "time: OpenMesh ÷ ours", .goal = 10, .sense = Sense::at_least}, "openmesh", kOurs, times);
  if (large) add(figures, result, {.title = "peak memory: ours ÷ CGAL", .goal = 1.3, .sense = Sense::at_most}, kOurs, "cgal-gh", peaks);
  add(figures, result, {.title = "RMS: ours ÷ OpenMesh, half-edge", .goal = 1, .sense = Sense::at_most}, kOurs, "openmesh", distances);
  add(figures, result, {.title = "RMS: ours ÷ CGAL, full-edge", .goal = 1, .sense = Sense::at_most}, kOursFull, "cgal-gh", distances);
  add(figures, result, {.title = "time: kim ÷ qem6, half-edge", .goal = 1.3, .sense = Sense::at_most}, "ours-kim", "ours-qem6", times);
  add(figures, result, {.title = "time: kim ÷ qem6, full-edge", .goal = 1.3, .sense = Sense::at_most}, "ours-kim", "ours-qem6-full", times);
  if (result.name == kPublishedScene)
    for (const MetroRow& row : metro_rows())
      add(figures, result,
          {.title = fmt::format("distance of {}'s result: off Metro's figures by", row.title), .goal = 0.01, .sense = Sense::at_most},
          row.way, row.way, [&](const WayResult& way, const WayResult&) {
            const auto off = [&](double ours, double metro) { return std::fabs(100 * ours / result.metro_diagonal / metro - 1); };
            return std::vector<double>{std::max(off(way.rms, row.rms_percent), off(way.mean, row.mean_percent))};
          });
  const char* weighted = "ours-qem6-full-weighted";
  if (result.name == kPublishedScene)
    add(figures, result, {.title = "published rows that are better in form and in colour", .goal = 0, .sense = Sense::at_most}, weighted,
        weighted, [](const WayResult& way, const WayResult&) {
          return std::vector<double>{static_cast<double>(rows_better_in_both(way.rms, way.colour_rms.value_or(1)))};
        });
  return figures;
}

}  // namespace etalon::bench
