#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "validation/report/json_report.h"
#include "validation/studies/chen_report.h"

namespace etalon::validation {

namespace {

// Pictures that are the same are better than any that are not.
constexpr double kSame = 200;

double masked(const ChenSubjectResult& s, std::size_t t, std::size_t l, ChenMethod method) {
  return s.of(t, l, method).masked_db.value_or(kSame);
}

struct Count {
  int held = 0, all = 0;
  [[nodiscard]] ClaimVerdict verdict() const {
    return held == all ? ClaimVerdict::holds : held > 0 ? ClaimVerdict::partly : ClaimVerdict::fails;
  }
};

using Each = std::function<void(const ChenSubjectResult&, std::size_t texture, std::size_t level)>;

void for_each(const ChenStudyResult& result, const Each& visit) {
  for (const ChenSubjectResult& s : result.subjects)
    for (std::size_t t = 0; t < s.textures.size(); ++t)
      for (std::size_t l = 0; l < s.levels.size(); ++l) visit(s, t, l);
}

std::string place_of(const ChenSubjectResult& s, std::size_t t, std::size_t l) {
  return fmt::format("{} {} at {}", s.name, s.textures[t], grouped(s.levels[l]));
}

/// "a; b", or "a; b; …" where there are more.
std::string listed(const std::vector<std::string>& places) {
  constexpr std::size_t kMost = 8;
  std::string text;
  for (std::size_t n = 0; n < std::min(places.size(), kMost); ++n) text += (n > 0 ? "; " : "") + places[n];
  return places.size() > kMost ? text + "; …" : text;
}

StudyClaim plane_claim(const ChenStudyResult& result) {
  StudyClaim claim;
  claim.where = "section 1, figures 1 to 3";
  claim.claim = "On the line and in the plane, adapted textures show what the original shows.";
  const ChenPlaneExample& plane = result.plane;
  // Nodes of cells are float32: each coordinate of a texel is off by 2^-25 at most, and every collapse moves it along by the map of a cell,
  // whose stretch here stays below 4.
  constexpr double kRounding = 0x1p-20;
  const double farthest = std::max(plane.levels[1].farthest, plane.levels[2].farthest);
  const bool line = std::abs(result.line.c_after - result.line.c.x) < kRounding;
  claim.verdict = line && farthest < kRounding && plane.damped == 0 ? ClaimVerdict::holds : ClaimVerdict::fails;
  claim.measured = fmt::format(
      "C, at {:.2f} of AB, goes from {:.2f} to {:.6f} in the texture. Of the hexagon, what any point of M¹ and M⁰ shows lies within {:.1e} "
      "of its width "
      "of where it should: the rounding of float32 nodes.",
      result.line.c.x, result.line.c_before, result.line.c_after, farthest);
  if (claim.verdict != ClaimVerdict::holds) claim.why = fmt::format("{} collapses were damped.", plane.damped);
  return claim;
}

StudyClaim better_claim(const ChenStudyResult& result, ChenMethod rival) {
  StudyClaim claim;
  claim.where = "section 4, figures 11 to 15";
  claim.claim = rival == ChenMethod::qem5
                    ? "Adaptation shows the full mesh's texture better than the same level without it, at every level of every model."
                    : "Adaptation with 5-D quadrics shows it better than meshes by texture deviation (APS) without it.";
  Count count;
  double least = 1e9, most = -1e9;
  std::vector<std::string> not_so;
  for_each(result, [&](const ChenSubjectResult& s, std::size_t t, std::size_t l) {
    const double gain = masked(s, t, l, ChenMethod::indexed) - masked(s, t, l, rival),
                 direct = masked(s, t, l, ChenMethod::adapted) - masked(s, t, l, rival);
    least = std::min({least, gain, direct}), most = std::max({most, gain, direct});
    count.all += 2, count.held += (gain > 0) + (direct > 0);
    if (gain <= 0 || direct <= 0)
      not_so.push_back(fmt::format("{}: {:+.2f} dB through the map, {:+.2f} dB as a texture", place_of(s, t, l), gain, direct));
  });
  claim.verdict = count.verdict();
  claim.measured = fmt::format("Gain in PSNR over the common silhouette: {:+.2f} to {:+.2f} dB, through the map and as an adapted texture.",
                               least, most);
  if (!not_so.empty()) claim.why = "Not so: " + listed(not_so) + ".";
  return claim;
}

StudyClaim limit_claim(const ChenStudyResult& result) {
  StudyClaim claim;
  claim.where = "section 3.4";
  claim.claim = "The map that is drawn collapse by collapse is as good as its exact limit, the chain of cells without resampling.";
  Count count;
  double least = 1e9, most = -1e9;
  std::vector<std::string> not_so;
  for_each(result, [&](const ChenSubjectResult& s, std::size_t t, std::size_t l) {
    const double loss = masked(s, t, l, ChenMethod::analytic) - masked(s, t, l, ChenMethod::indexed);
    least = std::min(least, loss), most = std::max(most, loss);
    ++count.all, count.held += loss >= -0.05;
    if (loss < -0.05) not_so.push_back(fmt::format("{}: {:+.2f} dB", place_of(s, t, l), loss));
  });
  claim.verdict = count.verdict();
  claim.measured = fmt::format("Limit minus map: {:+.2f} to {:+.2f} dB over the common silhouette.", least, most);
  if (!not_so.empty())
    claim.why =
        "Judged: the limit is no worse than the map by 0.05 dB. Not so, because the resampled map is a little smoother, which PSNR likes "
        "where it is off: " +
        listed(not_so) + ".";
  return claim;
}

StudyClaim rebake_claim(const ChenStudyResult& result) {
  StudyClaim claim;
  claim.where = "section 1 (Cignoni et al. 1999)";
  claim.claim =
      "Adaptation is as good as a texture made anew for the level by nearest points: not more than 0.5 dB behind, in each model's mean.";
  Count count;
  std::string text;
  std::vector<std::string> ahead;
  for (const ChenSubjectResult& s : result.subjects) {
    double texture = 0, map = 0;
    int n = 0;
    for (std::size_t t = 0; t < s.textures.size(); ++t)
      for (std::size_t l = 0; l < s.levels.size(); ++l) {
        const double rebaked = masked(s, t, l, ChenMethod::rebaked);
        texture += masked(s, t, l, ChenMethod::adapted) - rebaked, map += masked(s, t, l, ChenMethod::indexed) - rebaked, ++n;
      }
    count.all += 2, count.held += (texture >= -0.5 * n) + (map >= -0.5 * n);
    if (map > 0.5 * n) ahead.push_back(s.name);
    text += fmt::format("{}{} {:+.2f} and {:+.2f}", text.empty() ? "" : ", ", s.name, texture / n, map / n);
  }
  claim.verdict = count.verdict();
  claim.measured = "Minus re-baked, dB, mean over levels and textures, as a texture and through the map: " + text + ".";
  if (!ahead.empty())
    claim.why = "Where adaptation is far ahead (" + listed(ahead) +
                ") the nearest point of the full mesh is on another sheet of it: inside the mouth, behind the eyelids, under the chin. "
                "Collapses never leave the surface.";
  if (claim.verdict != ClaimVerdict::holds)
    claim.why +=
        " Where it is behind: a re-baked texture is resampled once, without a detour over the levels between, and its one averaging helps "
        "PSNR.";
  return claim;
}

StudyClaim cells_claim(const ChenStudyResult& result) {
  StudyClaim claim;
  claim.where = "section 3.3";
  claim.claim = "Parametric folding is prevented: all cells have positive area before and after.";
  std::size_t cells = 0, flat = 0, without = 0, sides = 0, damped = 0;
  for (const ChenSubjectResult& s : result.subjects) {
    const adapt::CellStatistics& r = s.records;
    cells += r.cells, flat += r.folded_cells, sides += r.made(), damped += r.damped_places + r.damped_crossings;
    without += r.rings[static_cast<std::size_t>(adapt::CellStatus::fold)] + r.rings[static_cast<std::size_t>(adapt::CellStatus::no_place)];
  }
  claim.verdict = flat == 0 ? ClaimVerdict::holds : ClaimVerdict::fails;
  claim.measured = fmt::format(
      "{} of {} cells of {} rings without positive area, decided exactly; {} places damped for it; {} rings have no cells, most where the "
      "parameterization itself is folded.",
      grouped(flat), grouped(cells), grouped(sides), grouped(damped), grouped(without));
  return claim;
}

StudyClaim blur_claim(const ChenStudyResult& result) {
  StudyClaim claim;
  claim.where = "section 3.4, figures 8 and 9";
  claim.claim = "The indexing map avoids the blur of textures that are resampled again and again.";
  double direct_least = 1e9, direct_most = 0, map_least = 1e9, map_most = 0;
  for_each(result, [&](const ChenSubjectResult& s, std::size_t t, std::size_t l) {
    const double limit = s.of(t, l, ChenMethod::analytic).detail;
    if (!(limit > 0)) return;
    const double direct = s.of(t, l, ChenMethod::adapted).detail / limit, map = s.of(t, l, ChenMethod::indexed).detail / limit;
    direct_least = std::min(direct_least, direct), direct_most = std::max(direct_most, direct);
    map_least = std::min(map_least, map), map_most = std::max(map_most, map);
  });
  claim.verdict = map_least >= 0.95 && direct_least < map_least ? ClaimVerdict::holds
                  : direct_least < map_least                    ? ClaimVerdict::partly
                                                                : ClaimVerdict::fails;
  claim.measured = fmt::format(
      "Squared differences of neighbouring texels, as a share of those that the exact limit shows: adapted textures {:.2f} to {:.2f} (1 "
      "where there is nothing to blur), through the "
      "map {:.2f} to {:.2f}.",
      direct_least, direct_most, map_least, map_most);
  if (claim.verdict != ClaimVerdict::holds) claim.why = "Judged: the map keeps 95 % of it everywhere.";
  return claim;
}

StudyClaim format_claim(const ChenStudyResult& result) {
  StudyClaim claim;
  claim.where = "section 3.4, figure 10";
  claim.claim = "16 bits are enough for the indexing map, 8 are not.";
  std::string text;
  bool half = true, unorm16 = true, unorm8 = false;
  for (const ChenSubjectResult& s : result.subjects) {
    if (s.formats.empty()) continue;
    const double full = s.formats.front().masked_db.value_or(kSame);
    for (const ChenFormatOutcome& f : s.formats) {
      const double db = f.masked_db.value_or(kSame);
      text += fmt::format("{}{} {:.2f} dB", text.empty() ? "" : ", ", to_string(f.format.type), db);
      if (f.format.type == ChannelType::half) half = db >= full - 0.1;
      if (f.format.type == ChannelType::unorm16) unorm16 = db >= full - 0.1;
      if (f.format.type == ChannelType::unorm8) unorm8 = db >= full - 0.1;
    }
    text = s.name + ": " + text + ".";
  }
  claim.measured = text;
  claim.verdict = half && unorm16 && !unorm8     ? ClaimVerdict::holds
                  : (unorm16 || half) && !unorm8 ? ClaimVerdict::partly
                                                 : ClaimVerdict::fails;
  if (!half && unorm16)
    claim.why =
        "16-bit integers are; 16-bit floating numbers, which the paper used, have 11 bits of precision: above ½ they name every second "
        "texel of 1,024, "
        "and every adaptation rounds again.";
  else if (claim.verdict != ClaimVerdict::holds)
    claim.why = "Judged: within 0.1 dB of float32.";
  return claim;
}

StudyClaim order_claim(const ChenStudyResult& result) {
  StudyClaim claim;
  claim.where = "section 4, table 1";
  claim.claim = "Adaptations of disjoint regions share a setup: 13.73 and 20.20 of them in the mean.";
  std::string text;
  bool many = true, same = true;
  for (const ChenSubjectResult& s : result.subjects) {
    const ChenPacking& p = s.packing;
    const double safe = static_cast<double>(p.adaptations) / static_cast<double>(std::max<std::size_t>(p.packs, 1)),
                 printed = static_cast<double>(p.adaptations) / static_cast<double>(std::max<std::size_t>(p.printed_packs, 1));
    text += fmt::format("{}{} {:.2f} and {:.2f}", text.empty() ? "" : ", ", s.name, safe, printed);
    many = many && safe >= 13.73, same = same && p.same_bytes;
  }
  claim.verdict = !same ? ClaimVerdict::fails : many ? ClaimVerdict::holds : ClaimVerdict::partly;
  claim.measured = fmt::format("A pack by the safe rule and by the printed one: {}. Safe packs leave {} bytes as one by one.", text,
                               same ? "the same" : "other");
  claim.why =
      "As printed the rule lets a region overtake one that it overlaps and that was passed over: its packs are larger and its map is "
      "another one. The safe rule lets passed-over "
      "regions block too.";
  return claim;
}

StudyClaim time_claim(const ChenStudyResult& result) {
  StudyClaim claim;
  claim.where = "section 4, table 1";
  claim.claim = "Packing makes an adaptation 13.66 and 17.51 times as fast.";
  claim.timed = true;
  std::string text;
  bool faster = true, as_much = true;
  for (const ChenSubjectResult& s : result.subjects) {
    const auto speedup = [](const ChenTimes& times) { return times.packed_ms > 0 ? times.single_ms / times.packed_ms : 1; };
    const double cpu = speedup(s.packing.exact), judged = s.packing.device ? speedup(*s.packing.device) : cpu;
    text += fmt::format("{}{} ", text.empty() ? "" : ", ", s.name);
    if (s.packing.device) text += fmt::format("{:.2f} on OpenGL, ", judged);
    text += fmt::format("{:.2f} on the exact rasterizer", cpu);
    faster = faster && judged > 1, as_much = as_much && judged >= 13.66;
  }
  claim.verdict = as_much ? ClaimVerdict::holds : faster ? ClaimVerdict::partly : ClaimVerdict::fails;
  claim.measured = "Times as fast: " + text + ".";
  claim.why =
      "The paper saves the setup of render-to-texture, 0.70 of the 0.76 ms of an adaptation on its card. OpenGL is judged where there is "
      "one. The exact rasterizer has next to no setup "
      "to save: one by one is about as fast.";
  return claim;
}

StudyClaim sharing_claim(const ChenSharing& sharing) {
  StudyClaim claim;
  claim.where = "section 4";
  claim.claim = "The setup can be shared among objects.";
  std::size_t apart = 0;
  for (const std::size_t packs : sharing.packs) apart += packs;
  // Coordinates of the atlas are rounded once more each time; a tenth of a texel would show something else than rounding.
  const bool same = sharing.largest < 0.1;
  claim.verdict = same && sharing.passes < apart ? ClaimVerdict::holds : ClaimVerdict::fails;
  std::string names;
  for (const std::string& name : sharing.names) names += (names.empty() ? "" : " and ") + name;
  claim.measured =
      fmt::format("{} in one atlas need {} passes instead of {}; their maps differ from what each has alone by {:.4f} texel at most.",
                  names, grouped(sharing.passes), grouped(apart), sharing.largest);
  return claim;
}

}  // namespace

std::vector<StudyClaim> chen_claims(const ChenStudyResult& result) {
  std::vector<StudyClaim> claims{plane_claim(result),
                                 better_claim(result, ChenMethod::qem5),
                                 better_claim(result, ChenMethod::aps),
                                 limit_claim(result),
                                 rebake_claim(result),
                                 cells_claim(result),
                                 blur_claim(result),
                                 format_claim(result),
                                 order_claim(result),
                                 time_claim(result)};
  if (result.sharing) claims.insert(claims.end() - 1, sharing_claim(*result.sharing));
  return claims;
}

}  // namespace etalon::validation
