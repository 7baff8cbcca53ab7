#include "validation/studies/horbelt_report.h"

#include <fmt/format.h>

#include "validation/joint/terrain_problem.h"
#include "validation/report/json_report.h"
#include "validation/report/view_document.h"
#include "validation/studies/horbelt_drawings.h"
#include "validation/studies/horbelt_flight_figure.h"

namespace etalon::validation {
namespace {

StudyCell word(const std::string& text) { return {text, {}}; }
double kilobits(std::uint64_t bits) { return static_cast<double>(bits) / 1000; }
std::string db_text(const std::optional<double>& db) { return db ? fmt::format("{:.2f} dB", *db) : "the same"; }

template <class Body>
void for_each_view(const HorbeltStudyResult& result, const Body& body) {
  for (const HorbeltSubjectResult& subject : result.subjects)
    for (const HorbeltViewResult& view : subject.views) body(subject, view);
}

StudyTable gap_table(const HorbeltStudyResult& result) {
  StudyTable table{
      .name = "gaps",
      .title = "How far each method stays behind all pairs",
      .note =
          "dB of PSNR (RGB, whole frame) lost against the best pair of no more bits: mean and worst over the path's points; then over 200 "
          "budgets in geometric progression, a path's last point within each. Evaluations: pairs that the method asked for.",
      .columns = {"terrain", "view", "method", "mean", "worst", "worst at mesh", "texture", "budgets: mean", "worst", "evaluations"},
      .rows = {}};
  for_each_view(result, [&](const HorbeltSubjectResult& subject, const HorbeltViewResult& view) {
    for (const HorbeltOutcome& o : view.outcomes)
      table.rows.push_back({word(subject.name), word(view.view.name), word(to_string(o.method)), number_cell(o.gaps.mean_db, 3),
                            number_cell(o.gaps.max_db, 3), count_cell(o.gaps.worst.mesh), count_cell(o.gaps.worst.texture),
                            number_cell(o.gaps.budget_mean_db, 3), number_cell(o.gaps.budget_max_db, 3), count_cell(o.path.evaluations)});
  });
  return table;
}

StudyTable view_table(const HorbeltStudyResult& result) {
  StudyTable table{.name = "views",
                   .title = "Views and levels",
                   .note =
                       "Visible: triangles of the full mesh that reach a pixel. Bits a vertex: of the finest mesh, all heads included. "
                       "Coefficients: those that the "
                       "finest texture knows not to be 0. PSNR of the finest pair against the full one.",
                   .columns = {"terrain", "view", "visible %", "meshes", "textures", "vertices", "bits a vertex", "mesh kbit",
                               "coefficients", "texture kbit", "finest pair dB", "smallest pair dB"},
                   .rows = {}};
  for_each_view(result, [&](const HorbeltSubjectResult& subject, const HorbeltViewResult& v) {
    table.rows.push_back(
        {word(subject.name), word(v.view.name), number_cell(100.0 * static_cast<double>(v.visible_faces) / static_cast<double>(v.faces), 1),
         count_cell(v.mesh_bits.size()), count_cell(v.texture_bits.size()), count_cell(v.vertices.back()),
         number_cell(static_cast<double>(v.mesh_bits.back()) / v.vertices.back(), 2), number_cell(kilobits(v.mesh_bits.back()), 1),
         count_cell(v.significant.back()), number_cell(kilobits(v.texture_bits.back()), 1),
         number_cell(v.psnr_db({v.mesh_bits.size() - 1, v.texture_bits.size() - 1}), 2), number_cell(v.psnr_db({0, 0}), 2)});
  });
  return table;
}

StudyTable trade_table(const HorbeltStudyResult& result) {
  StudyTable table{.name = "figure6",
                   .title = "Figure 6: three pairs of the same bits",
                   .note =
                       "(b) is the best pair of a middle budget; (a) and (c), within 3 % of its bits, have the finest texture and the "
                       "finest mesh. Displaced: the share "
                       "of the error that stands with the finest texture; blurred: with the finest mesh.",
                   .columns = {"terrain", "view", "pair", "mesh", "texture", "kbit", "mesh %", "PSNR dB", "displaced", "blurred"},
                   .rows = {}};
  for_each_view(result, [&](const HorbeltSubjectResult& subject, const HorbeltViewResult& v) {
    for (std::size_t n = 0; n < v.trades.size(); ++n) {
      const HorbeltTrade& t = v.trades[n];
      const std::string letter(1, static_cast<char>('a' + n));
      table.rows.push_back({word(subject.name), word(v.view.name), word(letter), count_cell(t.pair.mesh), count_cell(t.pair.texture),
                            number_cell(kilobits(t.bits), 1),
                            number_cell(100.0 * static_cast<double>(v.mesh_bits[t.pair.mesh]) / static_cast<double>(t.bits), 1),
                            number_cell(t.psnr_db, 2), number_cell(t.mesh_share, 2), number_cell(t.texture_share, 2)});
    }
  });
  return table;
}

StudyTable device_table(const HorbeltStudyResult& result) {
  StudyTable table{.name = "device",
                   .title = "The same frames on OpenGL",
                   .note =
                       "Every frame of the path by slope: each mesh's coordinates and ids, each pair's lookup through the exact "
                       "coordinates. Texels by class.",
                   .columns = {"terrain", "view", "frames", "identical", "rounding", "tie", "unbounded", "unexplained"},
                   .rows = {}};
  for_each_view(result, [&](const HorbeltSubjectResult& subject, const HorbeltViewResult& v) {
    if (v.checked_frames == 0) return;
    const auto count = [&](TexelClass c) { return count_cell(v.checked[c]); };
    table.rows.push_back({word(subject.name), word(v.view.name), count_cell(v.checked_frames), count(TexelClass::identical),
                          count(TexelClass::rounding), count(TexelClass::tie), count(TexelClass::unbounded),
                          count(TexelClass::unexplained)});
  });
  return table;
}

StudyTable time_table(const HorbeltStudyResult& result) {
  StudyTable table{.name = "times",
                   .title = "Times",
                   .note =
                       "Wall-clock seconds: levels (pruning, coding and decoding of all of them, the full picture), marginal analysis with "
                       "its drawings, all pairs.",
                   .columns = {"terrain", "view", "levels s", "marginal analysis s", "all pairs s", "ratio"},
                   .rows = {},
                   .timed = true};
  for_each_view(result, [&](const HorbeltSubjectResult& subject, const HorbeltViewResult& v) {
    table.rows.push_back({word(subject.name), word(v.view.name), number_cell(v.level_seconds, 2), number_cell(v.search_seconds, 2),
                          number_cell(v.exhaustive_seconds, 2), number_cell(v.exhaustive_seconds / std::max(v.search_seconds, 1e-9), 1)});
  });
  return table;
}

StudyTable path_table(const HorbeltStudyResult& result) {
  StudyTable table{.name = "paths",
                   .title = "The paths by slope",
                   .note = "Every pair, smallest first; best: the least error over all pairs of no more bits.",
                   .columns = {"terrain", "view", "mesh", "texture", "bits", "SSE", "PSNR dB"},
                   .rows = {},
                   .folded = true};
  for_each_view(result, [&](const HorbeltSubjectResult& subject, const HorbeltViewResult& v) {
    for (const joint::PathPoint& p : v.of(HorbeltMethod::slope).path.points)
      table.rows.push_back({word(subject.name), word(v.view.name), count_cell(p.pair.mesh), count_cell(p.pair.texture), count_cell(p.bits),
                            count_cell(v.all.error(p.pair)), number_cell(v.psnr_db(p.pair), 3)});
  });
  return table;
}

StudyFile view_file(const HorbeltSubjectResult& subject, const HorbeltViewResult& v) {
  const std::string name = horbelt_view_file(subject.name, v.view.name);
  return {name, fmt::format("this view as a file; {} --view {} -o both looks from it too", subject.joint_command, name),
          view_document(picture_frame(v.view.view).camera, v.view.view.width, v.view.view.height)};
}

std::vector<StudyFigure> figures_of(const HorbeltSubjectResult& subject, const HorbeltViewResult& v) {
  const std::string stem = subject.name + "-" + v.view.name, where = subject.name + ", " + v.view.title;
  const auto file = [&](const char* what) { return fmt::format("{}-{}.png", stem, what); };
  std::vector<StudyFigure> figures;
  figures.push_back({.id = "figure4-" + stem,
                     .title = "Figure 4: " + where,
                     .caption = "Thin: each texture with all meshes. Red: the least error of all pairs of no more bits (a staircase). Dark "
                                "blue: the path of marginal analysis by slope.",
                     .svg = rate_drawing(v),
                     .pictures = {}});
  figures.push_back({.id = "figure5-" + stem,
                     .title = "Figure 5: " + where,
                     .caption = fmt::format("Lines of equal PSNR. Red: the best pairs of all {}. Blue: the path by slope, {} evaluations.",
                                            grouped(v.all.errors.size()), v.of(HorbeltMethod::slope).path.evaluations),
                     .svg = iso_drawing(v),
                     .pictures = {}});
  StudyFigure trades{.id = "figure6-" + stem,
                     .title = "Figure 6: " + where,
                     .caption = "Three pairs of the same bits: (a) the finest texture, (b) the least error, (c) the finest mesh.",
                     .svg = "",
                     .pictures = {}};
  for (std::size_t n = 0; n < v.trades.size(); ++n) {
    const HorbeltTrade& t = v.trades[n];
    trades.pictures.push_back({file(fmt::format("pair-{}", static_cast<char>('a' + n)).c_str()),
                               fmt::format("({}) mesh {} with texture {}: {:.1f} kbit, {}", static_cast<char>('a' + n), t.pair.mesh,
                                           t.pair.texture, kilobits(t.bits), db_text(t.psnr_db)),
                               t.picture});
  }
  figures.push_back(std::move(trades));
  figures.push_back(
      {.id = "figure12-" + stem,
       .title = "Figures 1 and 2: " + where,
       .caption = "The full pair and the finest of all levels, as seen; from above: a mesh and the finest "
                  "texture, with viewer (blue) and frustum (red).",
       .svg = "",
       .pictures = {{file("full"), "the full pair", v.full},
                    {file("finest"), "the finest levels: " + db_text(v.psnr_db({v.mesh_bits.size() - 1, v.texture_bits.size() - 1})),
                     v.finest},
                    {file("mesh"), fmt::format("Figure 2: mesh {}, {} triangles", v.mapped_mesh, grouped(v.mapped_faces)), v.mesh_map},
                    {file("texture"),
                     fmt::format("the finest texture, {}: {} coefficients", v.mapped_texture, grouped(v.significant[v.mapped_texture])),
                     v.texture_map}},
       .columns = 2,
       .files = {view_file(subject, v)}});
  StudyFigure distances{.id = "figure3-" + stem,
                        .title = "Figure 3: " + where,
                        .caption =
                            "The pyramid of textures by distance, T_i from d_i = d_0·2^(i/k): what can be told apart from the view's own "
                            "distance d_0, and from farther away, each level complete. Viewer blue, frustum red; what the frustum does "
                            "not reach is never sent.",
                        .svg = "",
                        .pictures = {}};
  for (std::size_t n = 0; n < v.distances.size(); ++n) {
    const HorbeltDistance& d = v.distances[n];
    distances.pictures.push_back(
        {file(fmt::format("distance-{}", n).c_str()),
         fmt::format("from {:.3g} d_0: {} coefficients, {:.1f} kbit", d.distance, grouped(d.significant), kilobits(d.bits)), d.map});
  }
  figures.push_back(std::move(distances));
  return figures;
}

}  // namespace

std::string horbelt_view_file(const std::string& subject, const std::string& view) { return fmt::format("{}-{}-view.json", subject, view); }

StudyReport horbelt_report(const HorbeltStudyResult& result) {
  StudyReport report;
  report.name = "horbelt";
  report.title = "Joint mesh and texture compression by marginal analysis";
  report.paper = "S. Horbelt, L. Balmelli, M. Vetterli, Joint Mesh and Texture Compression Using Marginal Analysis";
  report.lede =
      "A terrain's mesh and its texture share one budget of bits. Marginal analysis finds pairs of their levels in under two hundred "
      "pictures; all pairs, drawn too, "
      "say what that costs.";
  report.inputs = result.inputs;
  report.claims = horbelt_claims(result);
  report.tables = {gap_table(result), view_table(result), trade_table(result)};
  StudyTable device = device_table(result);
  if (!device.rows.empty()) report.tables.push_back(std::move(device));
  report.tables.push_back(time_table(result));
  StudyTable flights = flight_table(result);
  if (!flights.rows.empty()) report.tables.push_back(std::move(flights));
  report.tables.push_back(path_table(result));
  for_each_view(result, [&](const HorbeltSubjectResult& subject, const HorbeltViewResult& view) {
    for (StudyFigure& figure : figures_of(subject, view)) report.figures.push_back(std::move(figure));
  });
  for (const HorbeltSubjectResult& subject : result.subjects)
    if (!subject.flight.empty()) report.figures.push_back(flight_figure(subject));
  std::string titles;
  for (const HorbeltSubjectResult& subject : result.subjects) titles += (titles.empty() ? "" : "; ") + subject.title;
  report.notes = {
      "Bits are those of the streams' bytes, headers, checksums and flushes included; H(b) is the staircase of equation 3, never "
      "interpolated, no convex hull.",
      "A picture is the mesh drawn into its texture coordinates (float32, rounded once), then the texture looked up linearly through them; "
      "black where nothing is.",
      "Meshes: the 4-8 hierarchy pruned by merging domains, weights by screen displacement; textures: 9/7 wavelets, coefficients outside "
      "the frustum never sent.",
      "The paper's terrain has 257² heights and 1024² texels. Here: " + titles + ".",
      "Drawn by " + result.exact_name + (result.device_name.empty() ? "." : ", compared with " + result.device_name + ".")};
  for (const HorbeltSubjectResult& subject : result.subjects) {
    for (const std::string& warning : subject.warnings) report.notes.push_back(fmt::format("Warning: {}: {}.", subject.name, warning));
    for (const std::string& note : subject.notes) report.notes.push_back(fmt::format("{}: {}.", subject.name, note));
  }
  return report;
}

}  // namespace etalon::validation
