#include "validation/studies/kim_report.h"

#include <fmt/format.h>

#include "validation/report/json_report.h"
#include "validation/studies/kim_drawings.h"
#include "validation/verify/pictures.h"

namespace etalon::validation {

namespace {

StudyCell word(const std::string& text) { return {text, {}}; }

std::optional<double> ratio(double above, double below) { return below > 0 ? std::optional<double>(above / below) : std::nullopt; }

const KimPaperRow* paper_of(const KimSubjectResult& subject) { return subject.paper_row ? &kim_paper_rows()[*subject.paper_row] : nullptr; }

std::optional<double> paper_ratio(const KimSubjectResult& subject, double KimPaperRow::*kim, double KimPaperRow::*qem6) {
  const KimPaperRow* row = paper_of(subject);
  return row == nullptr ? std::nullopt : std::optional<double>(row->*kim / row->*qem6);
}

StudyTable size_table(const KimStudyResult& result) {
  StudyTable table{
      .name = "table1-sizes",
      .title = "Table 1: sizes",
      .note =
          "Vertices and faces of the model and of the simplified meshes: all methods stop at the same number of vertices. bytes: of the "
          "errors, a vertex, measured.",
      .columns = {"model", "of the paper", "vertices", "faces", "less", "method", "vertices left", "faces left", "bytes a vertex"},
      .rows = {}};
  for (const KimSubjectResult& s : result.subjects)
    for (const KimOutcome& o : s.outcomes)
      table.rows.push_back({word(s.name), word(paper_of(s) != nullptr ? paper_of(s)->model : "–"), count_cell(s.vertices),
                            count_cell(s.faces), number_cell(100 * s.reduction, 0),
                            word(std::string(to_string(o.method)) + (o.reached ? "" : " (nothing legal left)")), count_cell(o.vertices),
                            count_cell(o.faces), count_cell(o.state_bytes_per_vertex)});
  return table;
}

StudyTable time_table(const KimStudyResult& result) {
  StudyTable table{.name = "table1-times",
                   .title = "Table 1: times",
                   .note =
                       "CPU seconds of the library call, one thread, reading and measuring left out; least of the repeated runs. The "
                       "paper's: Pentium 4, "
                       "3.5 GHz.",
                   .columns = {"model", "qem6", "qem6 full-edge", "kim", "qem", "kim/qem6", "kim/qem6 full-edge", "paper: kim/qem6"},
                   .rows = {},
                   .timed = true};
  for (const KimSubjectResult& s : result.subjects) {
    const double kim = s.of(KimMethod::kim).seconds, half = s.of(KimMethod::qem6).seconds, full = s.of(KimMethod::qem6_full).seconds;
    table.rows.push_back({word(s.name), number_cell(half, 2), number_cell(full, 2), number_cell(kim, 2),
                          number_cell(s.of(KimMethod::qem).seconds, 2), number_cell(ratio(kim, half), 2), number_cell(ratio(kim, full), 2),
                          number_cell(paper_ratio(s, &KimPaperRow::kim_seconds, &KimPaperRow::qem6_seconds), 2)});
  }
  return table;
}

StudyTable geometry_table(const KimStudyResult& result) {
  StudyTable table{
      .name = "table2",
      .title = "Table 2: distance of surfaces",
      .note = fmt::format(
          "Metro, about {} samples in each direction, the larger of the two; in % of the diagonal of the model's box. Colour: RMS "
          "distance of RGB in [0, 1]³ at the nearest points (not in the paper).",
          grouped(result.metro_samples)),
      .columns = {"model", "method", "mean %", "RMS %", "max %", "colour RMS", "kim/this: mean", "kim/this: RMS", "paper: mean",
                  "paper: RMS"},
      .rows = {}};
  for (const KimSubjectResult& s : result.subjects) {
    const KimOutcome& kim = s.of(KimMethod::kim);
    for (const KimOutcome& o : s.outcomes) {
      const bool rival = o.method == KimMethod::qem6 || o.method == KimMethod::qem6_full;
      const auto paper = [&](double KimPaperRow::*a, double KimPaperRow::*b) { return rival ? paper_ratio(s, a, b) : std::nullopt; };
      const bool other = o.method != KimMethod::kim;
      table.rows.push_back({word(s.name), word(to_string(o.method)), number_cell(o.mean, 4), number_cell(o.rms, 4), number_cell(o.max, 3),
                            number_cell(o.color_rms, 4), number_cell(other ? ratio(kim.mean, o.mean) : std::nullopt, 2),
                            number_cell(other ? ratio(kim.rms, o.rms) : std::nullopt, 2),
                            number_cell(paper(&KimPaperRow::kim_mean, &KimPaperRow::qem6_mean), 2),
                            number_cell(paper(&KimPaperRow::kim_rms, &KimPaperRow::qem6_rms), 2)});
    }
  }
  return table;
}

StudyTable image_table(const KimStudyResult& result) {
  const bool device = !result.device_name.empty();
  StudyTable table{
      .name = "table3",
      .title = "Table 3: difference of pictures",
      .note = fmt::format(
          "RMS over all pixels of the Euclidean distance of RGB, in steps of 1/255, vertex colours without light on black: the view "
          "\"fit\" at {0}×{0}, and the mean of {1} views at {2}×{2}. {3} inside: the one view where both pictures show the surface; "
          "outline: share of the squared error where only one does.",
          result.picture_px, result.view_count, result.views_px,
          device ? "OpenGL: the same from pictures that the device drew." : "OpenGL was not available."),
      .columns = {"model", "method", "one view", "mean of the views", "OpenGL, one view", "inside", "outline %", "kim/this: one view",
                  "kim/this: views", "kim/this: inside", "paper"},
      .rows = {}};
  for (const KimSubjectResult& s : result.subjects) {
    const KimOutcome& kim = s.of(KimMethod::kim);
    for (const KimOutcome& o : s.outcomes) {
      const bool rival = o.method == KimMethod::qem6 || o.method == KimMethod::qem6_full, other = o.method != KimMethod::kim;
      table.rows.push_back({word(s.name), word(to_string(o.method)), number_cell(o.image_rms, 3), number_cell(o.image_rms_views, 3),
                            number_cell(o.device_image_rms, 3), number_cell(o.inside_rms, 3), number_cell(100 * o.outline_share, 0),
                            number_cell(other ? ratio(kim.image_rms, o.image_rms) : std::nullopt, 2),
                            number_cell(other ? ratio(kim.image_rms_views, o.image_rms_views) : std::nullopt, 2),
                            number_cell(other ? ratio(kim.inside_rms, o.inside_rms) : std::nullopt, 2),
                            number_cell(rival ? paper_ratio(s, &KimPaperRow::kim_image, &KimPaperRow::qem6_image) : std::nullopt, 2)});
    }
  }
  return table;
}

StudyTable device_table(const KimStudyResult& result) {
  StudyTable table{
      .name = "crosscheck",
      .title = "Exact rasterizer and OpenGL",
      .note = fmt::format(
          "Every texel of the one view, drawn by {} and by {}, by class (docs/testing.md). A single unexplained one would be a defect.",
          result.exact_name, result.device_name),
      .columns = {"model", "mesh", "texels", "identical", "rounding", "tie", "unbounded", "unexplained"},
      .rows = {}};
  const auto add = [&](const std::string& model, const std::string& mesh, const std::optional<ClassCounts>& counts) {
    if (!counts) return;
    table.rows.push_back({word(model), word(mesh), count_cell(counts->total()), count_cell((*counts)[TexelClass::identical]),
                          count_cell((*counts)[TexelClass::rounding]), count_cell((*counts)[TexelClass::tie]),
                          count_cell((*counts)[TexelClass::unbounded]), count_cell((*counts)[TexelClass::unexplained])});
  };
  for (const KimSubjectResult& s : result.subjects) {
    add(s.name, "original", s.device_classes);
    for (const KimOutcome& o : s.outcomes) add(s.name, to_string(o.method), o.device_classes);
  }
  return table;
}

StudyTable sweep_table(const KimStudyResult& result) {
  StudyTable table{
      .name = "unit-sweep",
      .title = "kim by unit of length",
      .note = fmt::format("unit: as a share of the diagonal D; the default is D/8000. Metro with about {} samples, % of D; one view.",
                          grouped(result.sweep_samples)),
      .columns = {"model", "unit / D", "D / unit", "mean %", "RMS %", "image RMS", "mean / qem6", "RMS / qem6", "image RMS / qem6"},
      .rows = {},
      .folded = true};
  for (const KimSubjectResult& s : result.subjects) {
    const KimOutcome& base = s.of(KimMethod::qem6);
    for (const KimSweepPoint& p : s.sweep)
      table.rows.push_back({word(s.name),
                            {fmt::format("{:.3g}", p.unit_of_diagonal), p.unit_of_diagonal},
                            {fmt::format("{:.4g}", 1 / p.unit_of_diagonal), 1 / p.unit_of_diagonal},
                            number_cell(p.mean, 4),
                            number_cell(p.rms, 4),
                            number_cell(p.image_rms, 3),
                            number_cell(ratio(p.mean, base.mean), 2),
                            number_cell(ratio(p.rms, base.rms), 2),
                            number_cell(ratio(p.image_rms, base.image_rms), 2)});
  }
  return table;
}

std::string slug(KimMethod method) {
  std::string text = to_string(method);
  for (char& c : text)
    if (c == ' ') c = '-';
  return text;
}

/// Differences 0, 1, 2, 4, … 128, 255 as error_picture() shows them: the legend is made by what it explains.
StudyPicture error_legend() {
  constexpr int kCell = 36, kSteps[] = {0, 1, 2, 4, 8, 16, 32, 64, 128, 255};
  const int count = static_cast<int>(std::size(kSteps));
  Image black(kCell * count, kCell / 2, kRgb8), shifted(kCell * count, kCell / 2, kRgb8);
  for (int y = 0; y < black.height(); ++y)
    for (int x = 0; x < black.width(); ++x)
      for (int k = 0; k < 3; ++k) {
        black.channels<std::uint8_t>(x, y)[k] = 0;
        shifted.channels<std::uint8_t>(x, y)[k] = static_cast<std::uint8_t>(kSteps[x / kCell]);
      }
  return {"legend.png", "legend: largest difference of a channel, 0, 1, 2, 4, 8, 16, 32, 64, 128, 255 steps of 255 from left to right",
          error_picture(black, shifted, 0)};
}

void add_pictures(StudyReport& report, const KimSubjectResult& s) {
  constexpr KimMethod kShown[] = {KimMethod::qem6, KimMethod::qem6_full, KimMethod::kim};
  const auto named = [&](const KimOutcome& o, double rms) { return fmt::format("{}, image RMS {:.2f}", to_string(o.method), rms); };
  StudyFigure whole{.id = "fig5-" + s.name,
                    .title = fmt::format("Figure 5: {}", s.name),
                    .caption = fmt::format("The original of {} vertices and what is left of it at {} vertices.", grouped(s.vertices),
                                           grouped(s.target_vertices)),
                    .svg = "",
                    .pictures = {{s.name + "-original.png", "original", s.picture}},
                    .columns = 4};
  StudyFigure near{
      .id = "closeup-" + s.name,
      .title = fmt::format("Figure 5, close: {}", s.name),
      .caption =
          "The window in which kim differs most from the original, four times enlarged; below, each one's difference from the original.",
      .svg = "",
      .pictures = {{s.name + "-original-close.png", "original", s.closeup}},
      .columns = 4};
  for (const KimMethod method : kShown) {
    const KimOutcome& o = s.of(method);
    whole.pictures.push_back({fmt::format("{}-{}.png", s.name, slug(method)), named(o, o.image_rms), o.picture});
    near.pictures.push_back({fmt::format("{}-{}-close.png", s.name, slug(method)), to_string(method), o.closeup});
  }
  near.pictures.push_back(error_legend());
  whole.pictures.push_back(error_legend());
  for (const KimMethod method : kShown) {
    const KimOutcome& o = s.of(method);
    whole.pictures.push_back(
        {fmt::format("{}-{}-difference.png", s.name, slug(method)), std::string("difference: ") + to_string(method), o.error});
    near.pictures.push_back({fmt::format("{}-{}-close-difference.png", s.name, slug(method)),
                             std::string("difference: ") + to_string(method), o.closeup_error});
  }
  if (!s.attribution.empty()) {
    whole.caption += " The model is " + s.attribution + ".";
    near.caption += " The model is " + s.attribution + ".";
  }
  report.figures.push_back(std::move(whole));
  report.figures.push_back(std::move(near));
}

std::vector<std::string> notes_of(const KimStudyResult& result) {
  std::vector<std::string> notes{
      "The paper's models are not public. monkey, duck and statue are procedural ones of exactly its sizes; the numbers of its tables have "
      "no unit, so only ratios "
      "are compared.",
      "Equation 16's last factor is read as ‖v1 − vi‖. The unit of length that equation 17 leaves open is the diagonal / 8000, fixed "
      "before any comparison "
      "(docs/decisions/0004-kim-unit.md); claims are judged there.",
      "The paper does not say whether its colour quadric collapses half or full edges: each claim is judged against both.",
      "The paper draws one view that it does not name, on a background that it does not name: here the three-quarter view that fills the "
      "frame, on black, and beside "
      "it the mean over the 24 views."};
  if (!result.device_name.empty())
    notes.push_back(fmt::format("Pictures of the one view were drawn by OpenGL too ({}): {} texels unexplained.", result.device_name,
                                grouped(result.unexplained())));
  else
    notes.push_back("OpenGL was not available: pictures are the exact rasterizer's only.");
  return notes;
}

}  // namespace

StudyReport kim_report(const KimStudyResult& result) {
  StudyReport report;
  report.name = "kim";
  report.title = "Mesh simplification with vertex colour: the study";
  report.paper = "H. S. Kim, H. K. Choi, K. H. Lee, Mesh Simplification with Vertex Color, Geometric Modeling and Processing 2008.";
  report.lede =
      "The paper simplifies coloured meshes by half-edge collapses of least (1 + Q)(1 + I)(1 + C) and compares with the colour quadric of "
      "Garland & Heckbert. "
      "Both run here in one engine, on the models of table 1.";
  report.inputs = result.inputs;
  report.claims = kim_claims(result);
  report.tables = {size_table(result), time_table(result), geometry_table(result), image_table(result)};
  StudyTable sweep = sweep_table(result);
  if (!sweep.rows.empty()) report.tables.push_back(std::move(sweep));
  if (!result.device_name.empty()) report.tables.push_back(device_table(result));
  report.figures.push_back({.id = "ratios",
                            .title = "kim / qem6, ours and the paper's",
                            .caption = "Below 1 kim is better.",
                            .svg = ratio_drawing(result.subjects),
                            .pictures = {}});
  const std::string curves = sweep_drawing(result.subjects);
  if (!curves.empty())
    report.figures.push_back({.id = "sweep",
                              .title = "The unit of length over eight decades",
                              .caption = "To the right units grow: Q, a length to the fourth, and C, a length, vanish beside 1, and the "
                                         "importances alone decide. To the left the ones vanish beside Q "
                                         "and C: the order is that of Q (1 + I) C, which no unit changes any more. The dashed line is the "
                                         "default, at which claims are judged. Curves are cut "
                                         "off at 8.",
                              .svg = curves,
                              .pictures = {}});
  report.figures.push_back({.id = "fig3",
                            .title = "Figure 3: visual importance",
                            .caption = "Computed by the metric (equation 14): how far a colour differs from its neighbours' does not "
                                       "count, only how many do, and how evenly.",
                            .svg = importance_drawing(),
                            .pictures = {}});
  report.figures.push_back(
      {.id = "fig4",
       .title = "Figure 4: the area of colour change",
       .caption = "Computed by the engine: grey faces vanish or change a corner by the collapse v0 → v1; no other face changes.",
       .svg = collapse_drawing(),
       .pictures = {}});
  for (const KimSubjectResult& subject : result.subjects) add_pictures(report, subject);
  report.notes = notes_of(result);
  return report;
}

}  // namespace etalon::validation
