#include "validation/studies/soucy_report.h"

#include <cmath>

#include <fmt/format.h>

#include "validation/metrics/decibel.h"
#include "validation/report/json_report.h"
#include "validation/studies/study_tables.h"

namespace etalon::validation {
namespace {

std::vector<StudyCell> key_of(const SoucyScanResult& s, const SoucyMapping& m) {
  return {word_cell(s.name), word_cell(length_text(s.levels[m.level].tolerance, s.unit)), word_cell(to_string(m.pattern)),
          count_cell(static_cast<std::uint64_t>(m.map_size))};
}

void append(std::vector<StudyCell>& row, std::vector<StudyCell> more) { row.insert(row.end(), more.begin(), more.end()); }

StudyTable level_table(const SoucyStudyResult& result) {
  StudyTable table{.name = "compression",
                   .title = "Range images decimated to tolerances",
                   .note =
                       "Less: of the faces, in %. Farthest: of all samples the largest distance to the decimated surface, audited by a "
                       "search tree; never "
                       "more than the tolerance.",
                   .columns = {"scan", "vertices", "faces", "tolerance", "vertices left", "faces left", "less %", "farthest"},
                   .rows = {}};
  for (const SoucyScanResult& s : result.scans)
    for (const SoucyLevel& level : s.levels)
      table.rows.push_back({word_cell(s.name), count_cell(s.vertices), count_cell(s.faces), word_cell(length_text(level.tolerance, s.unit)),
                            count_cell(level.vertices), count_cell(level.faces),
                            number_cell(100 - 100 * static_cast<double>(level.faces) / static_cast<double>(s.faces), 2),
                            number_cell(level.distance_max, 4)});
  return table;
}

StudyTable error_table(const SoucyStudyResult& result) {
  StudyTable table{.name = "errors",
                   .title = "Texture-mapping errors",
                   .note =
                       "Orthographic, a pixel a sample, over the pixels that both the undecimated and the decimated surface cover; nearest "
                       "lookups. MSE in "
                       "squared steps of 1/255, of the pattern's own channels: the chessboard's one grey, the ramp's red and green. Mean: "
                       "of the errors' magnitudes. "
                       "At edges: share of the squared error in the 44 % of pixels that touch a colour edge of the chessboard.",
                   .columns = {"scan", "tolerance", "pattern", "map", "pixels", "MSE", "RMS", "PSNR dB", "mean", "at edges %"},
                   .rows = {}};
  for (const SoucyScanResult& s : result.scans)
    for (const SoucyMapping& m : s.mappings) {
      std::vector<StudyCell> row = key_of(s, m);
      const SoucyError& e = m.error;
      append(row, {count_cell(e.texels), number_cell(e.mse(), 2), number_cell(std::sqrt(e.mse()), 2),
                   number_cell(psnr_db(static_cast<double>(e.sse), e.texels * static_cast<std::uint64_t>(e.channels), 255), 2),
                   number_cell(e.mean_magnitude(), 3),
                   m.pattern == SoucyPattern::chessboard ? percent_cell(static_cast<double>(e.edge_sse), static_cast<double>(e.sse), 2)
                                                         : word_cell("–")});
      table.rows.push_back(std::move(row));
    }
  return table;
}

std::vector<StudyCell> texel_cells(const bake::TexelCounts& t) {
  const auto inside = static_cast<double>(t.inside);
  return {count_cell(t.inside), percent_cell(static_cast<double>(t.hit), inside, 1),
          percent_cell(static_cast<double>(t.averaged), inside, 1), percent_cell(static_cast<double>(t.filled), inside, 1)};
}

StudyTable texel_table(const SoucyStudyResult& result) {
  StudyTable table{.name = "texels",
                   .title = "Texels of the maps",
                   .note =
                       "In triangles, and of these in %: hit by samples, averaged (part of hit), filled from the nearest on the surface. "
                       "Halved: steps of the "
                       "filtering. Iterations of the fill. Across: largest difference of texels that edges and vertices make one. Wrong: "
                       "hit texels that "
                       "are not the integer mean of their hits.",
                   .columns = {"scan", "tolerance", "pattern", "map", "texels", "hit %", "averaged %", "filled %", "halved", "iterations",
                               "across", "wrong"},
                   .rows = {},
                   .folded = true};
  for (const SoucyScanResult& s : result.scans)
    for (const SoucyMapping& m : s.mappings) {
      std::vector<StudyCell> row = key_of(s, m);
      append(row, texel_cells(m.texels));
      append(row, {count_cell(m.reductions), count_cell(static_cast<std::uint64_t>(m.iterations)),
                   count_cell(static_cast<std::uint64_t>(m.seam_residual)), count_cell(m.wrong_means)});
      table.rows.push_back(std::move(row));
    }
  return table;
}

StudyTable histogram_table(const SoucyStudyResult& result) {
  StudyTable table{
      .name = "histograms",
      .title = "Histograms of the errors",
      .note = "How many values of all channels are off by so much.",
      .columns = {"scan", "tolerance", "pattern", "map", "0", "1", "2", "3–4", "5–8", "9–16", "17–32", "33–64", "65–128", "129–255"},
      .rows = {},
      .folded = true};
  for (const SoucyScanResult& s : result.scans)
    for (const SoucyMapping& m : s.mappings) {
      std::vector<StudyCell> row = key_of(s, m);
      int low = 0;
      for (const int high : {0, 1, 2, 4, 8, 16, 32, 64, 128, 255}) {
        std::uint64_t count = 0;
        for (int d = low; d <= high; ++d) {
          count += m.error.histogram[static_cast<std::size_t>(255 + d)];
          if (d > 0) count += m.error.histogram[static_cast<std::size_t>(255 - d)];
        }
        row.push_back(count_cell(count));
        low = high + 1;
      }
      table.rows.push_back(std::move(row));
    }
  return table;
}

StudyTable model_table(const SoucyStudyResult& result) {
  StudyTable table{.name = "models",
                   .title = "Coloured models at few triangles",
                   .note = fmt::format("PSNR in dB against the model itself, {0} views at {1}×{1} on black, without light, all pictures "
                                       "together: of whole pictures / where both "
                                       "show the surface. Vertex colours: the same triangles in the colours of the vertices that are left. "
                                       "Flat and bent: mean size of the quarter "
                                       "of the triangles that turn least, and most, towards a neighbour. Farthest: of the model's vertices "
                                       "to the triangles, in % of the diagonal.",
                                       result.view_count, result.views_px),
                   .columns = {"model", "faces", "faces left", "farthest %", "map", "baked: whole", "both", "vertex colours: whole", "both",
                               "texels", "hit %", "averaged %", "filled %", "sizes", "flat", "bent"},
                   .rows = {}};
  for (const SoucyModelResult& s : result.models)
    for (const SoucyModelMap& m : s.maps) {
      std::vector<StudyCell> row{word_cell(s.name),
                                 count_cell(s.faces),
                                 count_cell(s.baked_faces),
                                 number_cell(100 * s.distance_max / s.diagonal, 3),
                                 count_cell(static_cast<std::uint64_t>(m.map_size)),
                                 number_cell(m.sums.whole_db(), 2),
                                 number_cell(m.sums.masked_db(), 2),
                                 number_cell(s.plain_sums.whole_db(), 2),
                                 number_cell(s.plain_sums.masked_db(), 2)};
      append(row, texel_cells(m.texels));
      append(row, {word_cell(fmt::format("{} to {}", m.smallest, m.largest)), number_cell(m.flat_size, 1), number_cell(m.bent_size, 1)});
      table.rows.push_back(std::move(row));
    }
  return table;
}

StudyTable byte_table(const SoucyStudyResult& result) {
  StudyTable table{.name = "bytes",
                   .title = "Bytes",
                   .note =
                       "Binary PLY without its header: 15 bytes a vertex and 13 a face with vertex colours; 12 and 42 with texture "
                       "coordinates, and the PNG of the map. "
                       "At equal bytes: the mesh with vertex colours, decimated alike, that is as large; its PSNR as above.",
                   .columns = {"model", "bytes", "map", "baked", "of it PNG", "model/baked", "baked: whole", "both", "faces at equal bytes",
                               "whole", "both"},
                   .rows = {}};
  for (const SoucyModelResult& s : result.models)
    for (const SoucyModelMap& m : s.maps)
      table.rows.push_back({word_cell(s.name), count_cell(s.bytes), count_cell(static_cast<std::uint64_t>(m.map_size)), count_cell(m.bytes),
                            count_cell(m.png_bytes), number_cell(quotient(static_cast<double>(s.bytes), static_cast<double>(m.bytes)), 1),
                            number_cell(m.sums.whole_db(), 2), number_cell(m.sums.masked_db(), 2),
                            m.equal_sums ? count_cell(m.equal_faces) : word_cell("–"),
                            number_cell(m.equal_sums ? m.equal_sums->whole_db() : std::nullopt, 2),
                            number_cell(m.equal_sums ? m.equal_sums->masked_db() : std::nullopt, 2)});
  return table;
}

StudyTable device_table(const SoucyStudyResult& result) {
  StudyTable table{
      .name = "crosscheck",
      .title = "Exact rasterizer and OpenGL",
      .note = fmt::format(
          "Every picture of the study, drawn by {} and by {}; their texels by class (docs/testing.md). A single unexplained one would be a "
          "defect.",
          result.exact_name, result.device_name),
      .columns = {"subject", "pictures"},
      .rows = {}};
  for (const std::string& column : class_columns()) table.columns.push_back(column);
  for (const CheckedDrawing::Group& group : result.drawings) {
    std::vector<StudyCell> row{word_cell(group.name), count_cell(group.pictures)};
    append(row, class_cells(group.counts));
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::vector<std::string> notes_of(const SoucyStudyResult& result) {
  std::vector<std::string> notes{
      "The paper's range images and its duck are not public. shuttle, hand, soldier, teapot and telephone are procedural range images of "
      "256 × 256 samples in "
      "millimetres, with a sensor's noise and no background; the duck is procedural and has exactly the paper's 83,141 vertices and "
      "166,278 faces.",
      "Decimation: half-edge collapses in the order of geometric quadrics, each refused that would leave an original vertex farther from "
      "the surface than the tolerance. "
      "The paper's own optimizes by retriangulation error; it is described elsewhere [Soucy & Laurendeau 1996].",
      "Samples lie on pixel centres and frames are one pixel wider on each side, so that the undecimated surface shows each sample's own "
      "colour.",
      "The paper prints no number for its errors, only figures 9b and 10b.",
      "Smooth shading in figure 11: light interpolated over the triangles from their vertices' normals, drawn apart and multiplied texel "
      "by texel with the picture "
      "without light."};
  std::uint64_t off = 0;
  for (const SoucyScanResult& s : result.scans) off += s.off_pattern;
  if (!result.scans.empty())
    notes.push_back(fmt::format("Pixels in which an undecimated surface does not show its sample's colour: {}.", grouped(off)));
  if (result.device_name.empty())
    notes.emplace_back("OpenGL was not available: pictures are the exact rasterizer's only.");
  else
    notes.push_back(fmt::format("Every picture was drawn by OpenGL too ({}): {} texels unexplained.", result.device_name,
                                grouped(result.unexplained())));
  return notes;
}

}  // namespace

std::string length_text(double length, const std::string& unit) {
  const std::string text = fmt::format("{:.4g}", length);
  return unit.empty() ? text : text + " " + unit;
}

StudyReport soucy_report(const SoucyStudyResult& result, Renderer& exact) {
  StudyReport report;
  report.name = "soucy";
  report.title = "Baking coloured scans: the study";
  report.paper =
      "M. Soucy, G. Godin, M. Rioux, A texture-mapping approach for the compression of colored 3D triangulations, The Visual Computer 12, "
      "1996.";
  report.lede =
      "The paper decimates a coloured scan and keeps the colours of the vertices that go in a map of half-square triangles. Its "
      "experiments again: test patterns on "
      "five range images at three tolerances, in maps of two sizes; a duck at 1,000 triangles; and its figures, drawn by the running code.";
  report.inputs = result.inputs;
  report.claims = soucy_claims(result);
  if (!result.scans.empty()) report.tables = {level_table(result), error_table(result), texel_table(result), histogram_table(result)};
  if (!result.models.empty()) report.tables.push_back(model_table(result)), report.tables.push_back(byte_table(result));
  if (!result.device_name.empty()) report.tables.push_back(device_table(result));
  report.figures = soucy_figures(result, exact);
  report.notes = notes_of(result);
  return report;
}

}  // namespace etalon::validation
