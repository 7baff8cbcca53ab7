#include <fmt/format.h>

#include "core/draw/camera.h"
#include "raster/cpu_renderer.h"
#include "validation/report/json_report.h"
#include "validation/studies/chen_report.h"

namespace etalon::validation {

namespace {

std::string db_text(const std::optional<double>& db) { return db ? fmt::format("{:.2f} dB", *db) : "the same"; }

std::string file_word(ChenMethod method) {
  switch (method) {
    case ChenMethod::qem5: return "qem5";
    case ChenMethod::aps: return "aps";
    case ChenMethod::adapted: return "adapted";
    case ChenMethod::indexed: return "map";
    case ChenMethod::analytic: return "analytic";
    case ChenMethod::rebaked: return "rebaked";
  }
  return "";
}

std::string named(ChenMethod method) {
  switch (method) {
    case ChenMethod::qem5: return "not adapted";
    case ChenMethod::aps: return "APS, not adapted";
    case ChenMethod::adapted: return "adapted texture";
    case ChenMethod::indexed: return "adapted, through the map";
    case ChenMethod::analytic: return "the exact limit";
    case ChenMethod::rebaked: return "re-baked";
  }
  return "";
}

StudyPicture original(const ChenSubjectResult& s, std::size_t t) {
  return {fmt::format("{}-{}-original.png", s.name, s.textures[t]), fmt::format("original, {} faces", grouped(s.faces)), s.originals[t]};
}

StudyPicture shown(const ChenSubjectResult& s, std::size_t t, std::size_t l, ChenMethod method) {
  const ChenOutcome& o = s.of(t, l, method);
  return {fmt::format("{}-{}-{}-{}.png", s.name, s.textures[t], s.levels[l], file_word(method)),
          fmt::format("{}: {} ({} whole)", named(method), db_text(o.masked_db), db_text(o.whole_db)), o.picture};
}

std::string credit(const ChenSubjectResult& s) { return s.attribution.empty() ? "" : " The model is " + s.attribution + "."; }

/// "Figure 11", or the subject where the paper has no such figure.
std::string heading(const ChenSubjectResult& s, std::size_t t) {
  const int figure = s.paper_figure == 11 && s.textures[t] == "normals" ? 12 : s.paper_figure;
  return figure > 0 ? fmt::format("Figure {}: {}, {}", figure, s.name, s.textures[t]) : fmt::format("{}, {}", s.name, s.textures[t]);
}

StudyFigure strip(const ChenSubjectResult& s, std::size_t t) {
  StudyFigure figure{.id = fmt::format("strip-{}-{}", s.name, s.textures[t]),
                     .title = heading(s, t),
                     .caption = fmt::format("Simplified to {} faces. dB: over the common silhouette of all views, and whole.{}",
                                            grouped(s.levels.back()), credit(s)),
                     .svg = "",
                     .pictures = {original(s, t)},
                     .columns = 4};
  const std::size_t last = s.levels.size() - 1;
  for (const ChenMethod method : {ChenMethod::qem5, ChenMethod::indexed, ChenMethod::rebaked})
    figure.pictures.push_back(shown(s, t, last, method));
  return figure;
}

/// Figure 11: a row a level, from left to right APS, not adapted, adapted, re-baked.
StudyFigure levels_figure(const ChenSubjectResult& s) {
  StudyFigure figure{.id = "levels-" + s.name,
                     .title = s.paper_figure == 11 ? fmt::format("Figure 11: {}", s.name) : s.name,
                     .caption = "From top to bottom:",
                     .svg = "",
                     .pictures = {},
                     .columns = 4};
  for (std::size_t l = 0; l < s.levels.size(); ++l) {
    figure.caption += fmt::format("{} {}", l == 0 ? "" : l + 1 == s.levels.size() ? " and" : ",", grouped(s.levels[l]));
    for (const ChenMethod method : {ChenMethod::qem5, ChenMethod::aps, ChenMethod::indexed, ChenMethod::rebaked})
      figure.pictures.push_back(shown(s, 0, l, method));
  }
  figure.caption += fmt::format(" of {} faces.{}", grouped(s.faces), credit(s));
  return figure;
}

StudyFigure close_figure(const ChenSubjectResult& s, std::size_t t) {
  StudyFigure figure{
      .id = fmt::format("close-{}-{}", s.name, s.textures[t]),
      .title = fmt::format("Figure 8: {}, {}, close", s.name, s.textures[t]),
      .caption =
          fmt::format("Where the level of {} faces without adaptation differs most, four times enlarged. A texture that is adapted itself "
                      "blurs with every resampling; the map does not.{}",
                      grouped(s.levels.back()), credit(s)),
      .svg = "",
      .pictures = {{fmt::format("{}-{}-original-close.png", s.name, s.textures[t]), "original", s.originals_close[t]}},
      .columns = 3};
  for (const ChenMethod method : {ChenMethod::qem5, ChenMethod::adapted, ChenMethod::indexed, ChenMethod::analytic, ChenMethod::rebaked}) {
    const ChenOutcome& o = s.of(t, s.levels.size() - 1, method);
    figure.pictures.push_back({fmt::format("{}-{}-{}-close.png", s.name, s.textures[t], file_word(method)), named(method), o.closeup});
  }
  return figure;
}

StudyFigure parameterization_figure(const ChenSubjectResult& s) {
  return {.id = "parameterization-" + s.name,
          .title = fmt::format("Figure {}: the parameterization of {}", s.paper_figure, s.name),
          .caption = "The edges of the full mesh over its texture." + credit(s),
          .svg = "",
          .pictures = {{s.name + "-parameterization.png", "texture and edges", s.parameterization}},
          .columns = 2};
}

StudyFigure format_figure(const ChenSubjectResult& s) {
  StudyFigure figure{.id = "formats-figure",
                     .title = "Figure 10: formats of the indexing map",
                     .caption = fmt::format("{}, {}, at {} faces through maps of four formats, close.{}", s.name,
                                            s.textures[s.formats_texture], grouped(s.levels.back()), credit(s)),
                     .svg = "",
                     .pictures = {},
                     .columns = 4};
  for (const ChenFormatOutcome& f : s.formats) {
    const std::string type = to_string(f.format.type);
    figure.pictures.push_back({"format-" + type + ".png", type + ": " + db_text(f.masked_db), f.closeup});
  }
  return figure;
}

/// Figures 2 and 3: the plane's three levels, as they are and adapted.
std::vector<StudyFigure> plane_figures(const ChenStudyResult& result) {
  constexpr int kPicture = 512;
  raster::CpuRenderer renderer;
  const ChenPlaneExample& plane = result.plane;
  const Camera camera = named_view("front", bounding_box(plane.levels[0].mesh), kPicture, kPicture);
  const auto drawn = [&](const TexturedMesh& what) { return draw_textured(renderer, what, camera, kPicture, kPicture); };
  const DrawnView full = drawn({&plane.levels[0].mesh, plane.texture, nullptr});
  StudyFigure before{.id = "fig2",
                     .title = "Figure 2: distortion by collapses in a plane",
                     .caption =
                         "A planar polygon M² and its levels with the texture as it is. The parameterization is piecewise linear on M²: "
                         "with fewer triangles its "
                         "kinks are lost.",
                     .svg = "",
                     .pictures = {{"plane-texture.png", "the texture with the edges of M²",
                                   parameterization_picture(renderer, plane.levels[0].mesh, plane.texture, kPicture)}},
                     .columns = 4};
  StudyFigure after{.id = "fig3",
                    .title = "Figure 3: the same with adaptation",
                    .caption = "The textures of M¹ and M⁰ as adapted, with their edges, and what they show.",
                    .svg = "",
                    .pictures = {},
                    .columns = 4};
  constexpr const char* kNames[] = {"M²", "M¹", "M⁰"};
  for (std::size_t i = 0; i < 3; ++i) {
    const ChenPlaneExample::Level& level = plane.levels[i];
    const auto label = [&](const DrawnView& view, const char* how) {
      PictureSums sums;
      sums.add(full, view);
      return fmt::format("{}{}: {}", kNames[i], how, i == 0 ? "the original" : db_text(sums.masked_db()));
    };
    const DrawnView plain = drawn({&level.mesh, plane.texture, nullptr});
    before.pictures.push_back({fmt::format("plane-m{}.png", 2 - i), label(plain, ""), on_paper(plain)});
    if (i == 0) continue;
    const DrawnView adapted = drawn({&level.mesh, plane.texture, level.analytic});
    after.pictures.push_back({fmt::format("plane-m{}-texture.png", 2 - i), fmt::format("T{}, adapted", i == 1 ? "¹" : "⁰"),
                              parameterization_picture(renderer, level.mesh, level.adapted, kPicture)});
    after.pictures.push_back({fmt::format("plane-m{}-adapted.png", 2 - i), label(adapted, ""), on_paper(adapted)});
  }
  return {before, after};
}

}  // namespace

std::vector<StudyFigure> chen_figures(const ChenStudyResult& result) {
  std::vector<StudyFigure> figures;
  for (const ChenSubjectResult& s : result.subjects)
    for (std::size_t t = 0; t < s.textures.size(); ++t) {
      if (t == 0 && s.levels.size() > 1) figures.push_back(levels_figure(s));
      figures.push_back(strip(s, t));
      if (t == 0 && !s.parameterization.empty()) figures.push_back(parameterization_figure(s));
    }
  for (const ChenSubjectResult& s : result.subjects)
    if (!s.formats.empty()) figures.push_back(format_figure(s));
  for (const ChenSubjectResult& s : result.subjects)
    figures.push_back(close_figure(s, s.textures.size() > 1 && s.textures[1] == "checker" ? 1 : 0));
  figures.push_back({.id = "fig1",
                     .title = "Figure 1: distortion and adaptation on a line",
                     .caption = "AC and CB become AB. Blue is the texture up to C's coordinate: without adaptation it takes 0.3 of AB, "
                                "with it what AC covered. The "
                                "place of C in the texture is computed by the cells.",
                     .svg = line_drawing(result.line),
                     .pictures = {}});
  for (StudyFigure& figure : plane_figures(result)) figures.push_back(std::move(figure));
  const ChenSubjectResult* best = nullptr;
  for (const ChenSubjectResult& s : result.subjects)
    if (s.collapse && (best == nullptr || s.collapse->score > best->collapse->score)) best = &s;
  if (best != nullptr) {
    const ChenSubjectResult& s = *best;
    const std::string which = fmt::format(" Split {} of {}, as core/adapt made it.", grouped(s.collapse->split), s.name);
    figures.push_back({.id = "fig4",
                       .title = "Figure 4: the neighbourhood of an edge",
                       .caption = "A half-edge collapse in space and on the texture plane." + which,
                       .svg = neighbourhood_drawing(*s.collapse),
                       .pictures = {}});
    figures.push_back(
        {.id = "fig5",
         .title = "Figure 5: overlay and cells",
         .caption =
             "The edges of u before (u at its new place, the nearest point of the mesh after) and of v after over each other." + which,
         .svg = overlay_drawing(*s.collapse),
         .pictures = {}});
    figures.push_back(
        {.id = "fig6",
         .title = "Figure 6: correspondence",
         .caption =
             "The same cells in both textures; each crossing lies where the nearest points of its two edges in space have it." + which,
         .svg = correspondence_drawing(*s.collapse),
         .pictures = {}});
    figures.push_back({.id = "fig7",
                       .title = "Figure 7: fans and strips",
                       .caption = "The cells can be sent as a fan around u and strips. Here all cells of a pack are indexed triangles in "
                                  "one buffer and one draw, which sends each corner once." +
                                  which,
                       .svg = fan_drawing(*s.collapse),
                       .pictures = {}});
  }
  figures.push_back({.id = "fig9",
                     .title = "Figure 9: adapting coordinates instead of texels",
                     .caption = "A row of eight texels is drawn together to four. Adapted texels are means; adapted coordinates still name "
                                "places of the original, and between them "
                                "linear lookups of map and texture bring it back.",
                     .svg = blur_drawing(),
                     .pictures = {}});
  return figures;
}

}  // namespace etalon::validation
