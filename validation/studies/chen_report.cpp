#include "validation/studies/chen_report.h"

#include <fmt/format.h>

#include "validation/report/json_report.h"

namespace etalon::validation {

namespace {

StudyCell word(const std::string& text) { return {text, {}}; }

StudyCell share_cell(std::size_t part, std::size_t whole) {
  return whole == 0 ? StudyCell{"–", {}} : number_cell(100 * static_cast<double>(part) / static_cast<double>(whole), 2);
}

std::optional<double> ratio(double above, double below) { return below > 0 ? std::optional<double>(above / below) : std::nullopt; }

StudyTable psnr_table(const ChenStudyResult& result, bool masked) {
  StudyTable table{
      .name = masked ? "psnr-masked" : "psnr-whole",
      .title = masked ? "PSNR where both show the surface" : "PSNR of whole pictures",
      .note = fmt::format(
          "dB against the full mesh with its texture, {0} views at {1}×{1}, unlit, linear lookups, all pictures together"
          "{2} qem5 and aps: the texture as it is.",
          result.view_count, result.views_px,
          masked ? ": over the texels in which both pictures show the surface." : ": outlines, which no texture can mend, included."),
      .columns = {"model", "texture", "faces"},
      .rows = {},
      .folded = !masked};
  for (const ChenMethod method : kChenMethods) table.columns.emplace_back(to_string(method));
  for (const ChenSubjectResult& s : result.subjects)
    for (std::size_t t = 0; t < s.textures.size(); ++t)
      for (std::size_t l = 0; l < s.levels.size(); ++l) {
        std::vector<StudyCell> row{word(s.name), word(s.textures[t]), count_cell(s.levels[l])};
        for (const ChenMethod method : kChenMethods) {
          const ChenOutcome& o = s.of(t, l, method);
          row.push_back(number_cell(masked ? o.masked_db : o.whole_db, 2));
        }
        table.rows.push_back(std::move(row));
      }
  return table;
}

StudyTable detail_table(const ChenStudyResult& result) {
  StudyTable table{
      .name = "detail",
      .title = "Detail that is left",
      .note =
          "Sum of squared differences of neighbouring texels, as a share of the full mesh's in the same places: below 1 a picture is "
          "blurred. PSNR does not see it: where a picture is off by a little, blur even helps.",
      .columns = {"model", "texture", "faces"},
      .rows = {},
      .folded = true};
  for (const ChenMethod method : kChenMethods) table.columns.emplace_back(to_string(method));
  for (const ChenSubjectResult& s : result.subjects)
    for (std::size_t t = 0; t < s.textures.size(); ++t)
      for (std::size_t l = 0; l < s.levels.size(); ++l) {
        std::vector<StudyCell> row{word(s.name), word(s.textures[t]), count_cell(s.levels[l])};
        for (const ChenMethod method : kChenMethods) row.push_back(number_cell(s.of(t, l, method).detail, 3));
        table.rows.push_back(std::move(row));
      }
  return table;
}

StudyTable pack_table(const ChenStudyResult& result) {
  StudyTable table{
      .name = "table1-packs",
      .title = "Table 1: packs",
      .note = fmt::format("From the finest level to the coarsest, on a map of {0}². Safe: a region joins a pack only if it overlaps "
                          "neither one in the pack nor one "
                          "passed over before it; this is what is drawn. Printed: the paper's rule, which forgets the latter; counted, "
                          "never drawn, since its "
                          "packs give another map. Texels: written by an adaptation, in the mean.",
                          result.map_size),
      .columns = {"model", "faces", "simplified", "adaptations", "packs, safe", "a pack, safe", "packs, printed", "a pack, printed",
                  "texels", "same bytes as one by one", "paper's model", "paper: adaptations", "paper: packs", "paper: a pack"},
      .rows = {}};
  for (const ChenSubjectResult& s : result.subjects) {
    const ChenPacking& p = s.packing;
    const ChenPaperRow* paper = s.paper_row ? &chen_paper_rows()[*s.paper_row] : nullptr;
    const auto adaptations = static_cast<double>(p.adaptations);
    table.rows.push_back(
        {word(s.name), count_cell(p.faces), count_cell(p.base_faces), count_cell(p.adaptations), count_cell(p.packs),
         number_cell(ratio(adaptations, static_cast<double>(p.packs)), 2), count_cell(p.printed_packs),
         number_cell(ratio(adaptations, static_cast<double>(p.printed_packs)), 2),
         number_cell(ratio(static_cast<double>(p.texels), adaptations), 0), word(p.same_bytes ? "yes" : "no"),
         word(paper != nullptr ? paper->model : "–"), paper != nullptr ? count_cell(paper->adaptations) : word("–"),
         paper != nullptr ? count_cell(paper->packs) : word("–"),
         paper != nullptr ? number_cell(static_cast<double>(paper->adaptations) / static_cast<double>(paper->packs), 2) : word("–")});
  }
  return table;
}

StudyTable time_table(const ChenStudyResult& result) {
  StudyTable table{
      .name = "table1-times",
      .title = "Table 1: times",
      .note =
          "Milliseconds of wall clock an adaptation: the passes alone, made beforehand, up to the last texel read back. On OpenGL the mean "
          "of at most "
          "1,000 adaptations, evenly spread, stands for one by one. Run-time: all levels down, without a texture; with the map adapted, "
          "packing "
          "and making the passes included; the same with mesh and map at once on two threads. The paper's: Pentium 4, 3 GHz, GeForce 6800 "
          "GT.",
      .columns = {"model", "renderer", "one by one", "packed", "speed-up", "run-time without", "run-time with", "mesh and map at once"},
      .rows = {},
      .timed = true};
  for (const ChenSubjectResult& s : result.subjects) {
    const ChenPacking& p = s.packing;
    const auto add = [&](const ChenTimes& times, bool run_time) {
      table.rows.push_back({word(s.name), word(times.renderer), number_cell(times.single_ms, 4), number_cell(times.packed_ms, 4),
                            number_cell(ratio(times.single_ms, times.packed_ms), 2), run_time ? number_cell(p.levels_ms, 2) : word("–"),
                            run_time ? number_cell(p.adapted_ms, 1) : word("–"), run_time ? number_cell(p.together_ms, 1) : word("–")});
    };
    add(p.exact, true);
    if (p.device) add(*p.device, false);
    if (!s.paper_row) continue;
    const ChenPaperRow& paper = chen_paper_rows()[*s.paper_row];
    table.rows.push_back({word(s.name), word("the paper's " + paper.model), number_cell(paper.single_ms, 4),
                          number_cell(paper.packed_ms, 4), number_cell(paper.speedup, 2), number_cell(paper.plain_ms, 2),
                          number_cell(paper.adapted_ms, 1), word("–")});
  }
  return table;
}

StudyTable record_table(const ChenStudyResult& result) {
  StudyTable table{.name = "records",
                   .title = "Cells",
                   .note =
                       "Of all collapses from the finest level to the coarsest. Sides: of a vertex on a seam or border each side counts. "
                       "Damped: u, or the "
                       "crossings, moved less far than the nearest points in space lie, so that all cells stay positive; kept: how much of "
                       "the crossings' way, "
                       "in the mean. Without cells: rings with a fold in texture space; rings for which no positive cells were found; "
                       "sides on which nothing is "
                       "left.",
                   .columns = {"model", "collapses", "sides", "cells", "cells without positive area", "u damped %", "crossings damped %",
                               "u kept", "crossings kept", "fold", "no place", "gone"},
                   .rows = {}};
  for (const ChenSubjectResult& s : result.subjects) {
    const adapt::CellStatistics& r = s.records;
    const auto rings = [&](adapt::CellStatus status) { return count_cell(r.rings[static_cast<std::size_t>(status)]); };
    table.rows.push_back({word(s.name), count_cell(r.splits), count_cell(r.made()), count_cell(r.cells), count_cell(r.folded_cells),
                          share_cell(r.damped_places, r.made()), share_cell(r.damped_crossings, r.made()),
                          number_cell(r.mean_place_share, 4), number_cell(r.mean_crossing_share, 4), rings(adapt::CellStatus::fold),
                          rings(adapt::CellStatus::no_place), rings(adapt::CellStatus::gone)});
  }
  return table;
}

StudyTable format_table(const ChenSubjectResult& s) {
  StudyTable table{
      .name = "formats",
      .title = "Figure 10: formats of the map",
      .note = fmt::format("{}, {}, {} faces. Unnamed: texels of the texture that the identity map of this format does not give back. "
                          "Errors: how far the map's "
                          "texels point from where the exact chain of cells leads, in texels, over all texels in charts. dB as above.",
                          s.name, s.textures[s.formats_texture], grouped(s.levels.back())),
      .columns = {"format", "unnamed texels", "median", "99 %", "largest", "PSNR"},
      .rows = {}};
  for (const ChenFormatOutcome& f : s.formats)
    table.rows.push_back({word(to_string(f.format.type)), count_cell(f.format.unnamed), number_cell(f.format.errors.median, 4),
                          number_cell(f.format.errors.p99, 3), number_cell(f.format.errors.largest, 1), number_cell(f.masked_db, 2)});
  return table;
}

StudyTable inverse_table(const ChenSubjectResult& s) {
  StudyTable table{
      .name = "inverse",
      .title = "Down and up again: the map's errors",
      .note = fmt::format(
          "{}, down to {} faces and up to {} again. In texels of the map, over all texels in charts: down, from where the exact "
          "chain of cells leads; back, from each texel's own centre. The chain itself, followed down and up, returns to within "
          "2^-30 texel (tests/adapt).",
          s.name, grouped(s.levels.back()), grouped(s.faces)),
      .columns = {"size", "format", "filter", "unnamed texels", "down: median", "99 %", "largest", "back: median", "99 %", "largest"},
      .rows = {}};
  for (const ChenInverse& i : s.inverses)
    table.rows.push_back({count_cell(static_cast<std::uint64_t>(i.size)), word(to_string(i.type)), word(to_string(i.filter)),
                          count_cell(i.unnamed), number_cell(i.down.median, 4), number_cell(i.down.p99, 3), number_cell(i.down.largest, 1),
                          number_cell(i.back.median, 4), number_cell(i.back.p99, 3), number_cell(i.back.largest, 1)});
  return table;
}

std::string joined(const std::vector<std::string>& words, const char* between) {
  std::string text;
  for (const std::string& each : words) text += (text.empty() ? "" : between) + each;
  return text;
}

StudyTable sharing_table(const ChenSharing& sharing) {
  StudyTable table{
      .name = "sharing",
      .title = "Several objects in one pass",
      .note =
          "Their maps lie in one atlas, one above the other; the n-th packs of all are one pass. Coordinates in the atlas are float32 "
          "too, so that a few texels differ in their last bits from what each object has alone.",
      .columns = {"objects", "passes apart", "passes together", "texels", "differing", "by at most (texels)"},
      .rows = {}};
  std::size_t apart = 0;
  for (const std::size_t packs : sharing.packs) apart += packs;
  table.rows.push_back({word(joined(sharing.names, " + ")), count_cell(apart), count_cell(sharing.passes), count_cell(sharing.texels),
                        count_cell(sharing.differing), number_cell(sharing.largest, 4)});
  return table;
}

StudyTable sharing_times(const ChenStudyResult& result) {
  const ChenSharing& sharing = *result.sharing;
  StudyTable table{.name = "sharing-times",
                   .title = "Several objects in one pass: times",
                   .note = "Milliseconds of wall clock for all passes, from the finest level to the coarsest.",
                   .columns = {"objects", "renderer", "apart", "together", "speed-up"},
                   .rows = {},
                   .timed = true};
  const auto add = [&](const std::string& renderer, double apart, double shared) {
    table.rows.push_back({word(joined(sharing.names, " + ")), word(renderer), number_cell(apart, 1), number_cell(shared, 1),
                          number_cell(ratio(apart, shared), 2)});
  };
  add(result.exact_name, sharing.apart_ms, sharing.shared_ms);
  if (sharing.device_apart_ms) add(result.device_name, *sharing.device_apart_ms, *sharing.device_shared_ms);
  return table;
}

std::vector<std::string> notes_of(const ChenStudyResult& result) {
  std::vector<std::string> notes{
      "The paper's models are not public. parasaur is a scanned head reduced to the paper's 7,685 faces first (Figure 12; Table 1's 7,835 "
      "cannot "
      "be), which is then the full mesh; bunny the same head at its own 17,684 faces (paper: 17,483); spot stands for the horse, 5,856 to "
      "574 being "
      "the paper's 9.8 %; the swirl has the paper's size.",
      "Levels are those of half-edge collapses in the order of 5-D quadrics (qem5); aps is a mesh of as many faces by texture deviation. "
      "Where two faces "
      "go at a time a level has one face less than its name.",
      "adapted: the texture itself, in its own 8 bits, drawn over itself collapse by collapse; through the map: the same with an indexing "
      "map of two "
      "float32 a texel, the texture left alone; analytic: an indexing map whose texels are followed through all cells without resampling; "
      "re-baked: "
      "each texel of the level's texture looks up the original at the nearest point of the full mesh.",
      "Normals are in object space, as colours: baked from the scan's tangent-space map, or from the mesh's own vertex normals. Pictures "
      "of them are "
      "lit; PSNR is of the normals.",
      fmt::format("Maps have {0}×{0} texels. Textures and maps are looked up linearly, clamped.", result.map_size)};
  notes.emplace_back(
      "Adaptation in parallel with the collapses: the mesh goes through its levels on one thread while the map is adapted on the other. "
      "Going through "
      "the levels takes next to nothing here (a collapse changes a dozen corners in place; the paper's 15 µs a collapse include more), so "
      "that "
      "next to nothing is gained by it. Passes of Table 1 are the cells alone, as in the paper; the pictures' maps and textures keep a "
      "gutter too.");
  if (result.device_name.empty()) notes.emplace_back("OpenGL was not available: times are the exact rasterizer's only.");
  return notes;
}

}  // namespace

StudyReport chen_report(const ChenStudyResult& result) {
  StudyReport report;
  report.name = "chen";
  report.title = "Texture adaptation for progressive meshes: the study";
  report.paper = "C.-C. Chen, J.-H. Chuang, Texture Adaptation for Progressive Meshes, Computer Graphics Forum 25(3), Eurographics 2006.";
  report.lede =
      "The paper lets all levels of a progressive mesh share one texture, or an indexing map, and redraws it around every collapse so that "
      "the "
      "surface shows what it showed before. Here it runs beside the same meshes without it, beside its exact limit, and beside a texture "
      "made anew "
      "for the level.";
  report.inputs = result.inputs;
  report.claims = chen_claims(result);
  report.tables = {psnr_table(result, true), psnr_table(result, false), detail_table(result),
                   pack_table(result),       time_table(result),        record_table(result)};
  for (const ChenSubjectResult& s : result.subjects)
    if (!s.formats.empty()) report.tables.push_back(format_table(s)), report.tables.push_back(inverse_table(s));
  if (result.sharing) report.tables.push_back(sharing_table(*result.sharing)), report.tables.push_back(sharing_times(result));
  report.figures = chen_figures(result);
  report.notes = notes_of(result);
  return report;
}

}  // namespace etalon::validation
