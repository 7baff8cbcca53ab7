#include <fmt/format.h>

#include "validation/report/json_report.h"
#include "validation/studies/soucy_drawings.h"
#include "validation/studies/soucy_report.h"

namespace etalon::validation {
namespace {

StudyFigure drawn(const std::string& id, const std::string& title, const std::string& caption, std::string svg) {
  return {.id = id, .title = title, .caption = caption, .svg = std::move(svg), .pictures = {}};
}

std::string file_of(const SoucyScanResult& s, const SoucyMapping& m, const char* what) {
  return fmt::format("{}-{}-{}-{}{}.png", s.name, m.level + 1, to_string(m.pattern), m.map_size, what);
}

std::string credited(const std::string& caption, const std::string& attribution) {
  return attribution.empty() ? caption : caption + " The scan is " + attribution + ".";
}

std::vector<StudyFigure> method_figures(Renderer& exact) {
  const FillExample example = fill_example();
  return {drawn("fig1", "Figure 1: nearest-texel rendering", "Pixels, coordinates and colours as the exact rasterizer gives them.",
                lookup_drawing(exact)),
          drawn("fig2", "Figure 2: two adjacent triangles",
                "Texels that the program makes one have one colour; three sides have as many texels as the triangle's size.",
                adjacent_drawing()),
          drawn("fig3", "Figure 3: vertices projected onto a texture triangle",
                "A triangle of the decimated duck with ten texels, eight of them hit. Hatched texels are empty.", projection_drawing()),
          drawn("fig4", "Figure 4: pairs", "The darker half of a rectangle is the turned one.", pairing_drawing()),
          drawn("fig5", "Figure 5: the tiling",
                "Rectangles from the largest to the smallest, each at the highest free place; numbers tell the order. Free texels are at "
                "the bottom.",
                tiling_drawing()),
          drawn("section3", "Section 3: reclassification",
                "Eight triangles, T1 and T2 those of the paper's example, in a map of 32 × 33. Circles: the classes that E_max / D_i asks "
                "for. Each step takes the triangle of "
                "least proximity, which is written beside it, one class down, until all fit; dashed: for the sake of even classes. T2 goes "
                "from 16 to 8 first, not to 4 as "
                "printed.",
                reclassification_drawing()),
          drawn("fig6-8", "Figures 6 to 8: the fill, stage by stage",
                fmt::format("Large dots are hit texels; each texel has the hue of the one whose colour it takes. On the edge t3 and t5 "
                            "find t2 and t1 on the other side; then t4 "
                            "goes over to t2, by way of t3. The fill of this pair ends after {} iterations.",
                            example.stages.size() / 2),
                fill_drawing(example))};
}

/// Figures 9 and 10, on the telephone where it is there.
std::vector<StudyFigure> chessboard_figures(const SoucyStudyResult& result) {
  const SoucyScanResult* subject = &result.scans.front();
  for (const SoucyScanResult& s : result.scans)
    if (s.name == "telephone") subject = &s;
  std::vector<StudyFigure> figures;
  for (std::size_t n = 0; n < 2; ++n) {
    const SoucyMapping& m = subject->of(0, SoucyPattern::chessboard, result.map_sizes[n]);
    const std::string label =
        fmt::format("{}, chessboard, {}, {}² map", subject->name, length_text(subject->levels[0].tolerance, subject->unit), m.map_size);
    figures.push_back(
        {.id = fmt::format("fig{}", 9 + n),
         .title = fmt::format("Figure {}: {}", 9 + n, label),
         .caption =
             credited("The decimated surface with its texture, the error's magnitude, and the histogram of errors.", subject->attribution),
         .svg = histogram_drawing(m.error, label),
         .pictures = {{file_of(*subject, m, ""), label, m.picture}, {file_of(*subject, m, "-error"), "error", m.error_picture}},
         .columns = 2});
  }
  return figures;
}

StudyFigure scan_figure(const SoucyScanResult& s) {
  StudyFigure figure{.id = "scan-" + s.name,
                     .title = fmt::format("{}: all maps", s.name),
                     .caption = credited(fmt::format("{} faces, decimated to {} tolerances: textured, and the error's magnitude (that of "
                                                     "the ramp 32 times; blue: not covered by both surfaces). Histograms by decades.",
                                                     grouped(s.faces), s.levels.size()),
                                         s.attribution),
                     .svg = "",
                     .pictures = {},
                     .columns = 6};
  std::vector<NamedError> errors;
  for (const SoucyMapping& m : s.mappings) {
    const std::string name = fmt::format("{}, {}, {}²", length_text(s.levels[m.level].tolerance, s.unit), to_string(m.pattern), m.map_size);
    figure.pictures.push_back({file_of(s, m, ""), name, m.picture});
    figure.pictures.push_back(
        {file_of(s, m, "-error"), (m.pattern == SoucyPattern::ramp ? "error × 32: " : "error: ") + name, m.error_picture});
    errors.push_back({name, &m.error});
  }
  figure.svg = histograms_drawing(errors, 4, s.name + ": histograms of errors");
  return figure;
}

StudyFigure surfaces_figure(const SoucyStudyResult& result) {
  StudyFigure figure{
      .id = "scans", .title = "The range images", .caption = "As surfaces, before decimation.", .svg = "", .pictures = {}, .columns = 5};
  for (const SoucyScanResult& s : result.scans)
    figure.pictures.push_back({s.name + ".png", fmt::format("{}, {} faces", s.name, grouped(s.faces)), s.shaded});
  return figure;
}

void add_model(std::vector<StudyFigure>& figures, const SoucyModelResult& s) {
  if (s.atlas.empty()) return;
  const SoucyModelMap& m = s.maps.front();
  const std::string whole = grouped(s.faces), few = grouped(s.baked_faces);
  const std::array<std::string, 6> labels{"a: " + whole + " triangles, grey",
                                          "b: " + few + " triangles, grey",
                                          "c: vertex colours",
                                          "d: texture",
                                          "e: vertex colours, from another side",
                                          "f: texture"};
  StudyFigure plate{.id = "fig11-" + s.name,
                    .title = "Figure 11: " + s.name,
                    .caption = credited(
                        fmt::format("Flat shading in grey, smooth shading in colours; nearest lookups in a map of {0} × {0}.", m.map_size),
                        s.attribution),
                    .svg = "",
                    .pictures = {},
                    .columns = 2};
  for (std::size_t n = 0; n < labels.size(); ++n)
    plate.pictures.push_back({fmt::format("{}-{}.png", s.name, static_cast<char>('a' + n)), labels[n], s.figure11[n]});
  figures.push_back(std::move(plate));
  figures.push_back({.id = "fig12-" + s.name,
                     .title = "Figure 12: the map of " + s.name,
                     .caption = fmt::format("Triangles of {} to {} texels, the largest on top.", m.smallest, m.largest),
                     .svg = "",
                     .pictures = {{s.name + "-map.png", fmt::format("{0} × {0} texels", m.map_size), s.atlas}},
                     .columns = 1});
}

}  // namespace

std::vector<StudyFigure> soucy_figures(const SoucyStudyResult& result, Renderer& exact) {
  std::vector<StudyFigure> figures = method_figures(exact);
  if (!result.scans.empty()) {
    for (StudyFigure& figure : chessboard_figures(result)) figures.push_back(std::move(figure));
    figures.push_back(surfaces_figure(result));
  }
  for (const SoucyModelResult& model : result.models) add_model(figures, model);
  for (const SoucyScanResult& scan : result.scans) figures.push_back(scan_figure(scan));
  return figures;
}

}  // namespace etalon::validation
