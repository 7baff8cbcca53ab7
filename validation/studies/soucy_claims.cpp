#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "validation/report/json_report.h"
#include "validation/studies/soucy_report.h"
#include "validation/studies/study_tables.h"

namespace etalon::validation {
namespace {

using Each = std::function<void(const SoucyScanResult&, const SoucyMapping&)>;

void for_each(const SoucyStudyResult& result, SoucyPattern pattern, int map_size, const Each& visit) {
  for (const SoucyScanResult& s : result.scans)
    for (const SoucyMapping& m : s.mappings)
      if (m.pattern == pattern && m.map_size == map_size) visit(s, m);
}

std::string place_of(const SoucyScanResult& s, std::size_t level) {
  return s.name + " at " + length_text(s.levels[level].tolerance, s.unit);
}

struct Range {
  double low = 1e300, high = -1e300;
  void add(double x) { low = std::min(low, x), high = std::max(high, x); }
};

StudyClaim compression_claim(const SoucyStudyResult& result) {
  StudyClaim claim;
  claim.where = "section 5";
  claim.claim = "Compression levels at tolerances of 1, 2 and 4 mm are typically larger than 95 %.";
  CaseCount count;
  Range range;
  std::vector<std::string> not_so;
  for (const SoucyScanResult& s : result.scans)
    for (std::size_t l = 0; l < s.levels.size(); ++l) {
      const double less = 100 - 100 * static_cast<double>(s.levels[l].faces) / static_cast<double>(s.faces);
      count.add(less > 95), range.add(less);
      if (less <= 95) not_so.push_back(fmt::format("{}: {:.2f} %", place_of(s, l), less));
    }
  claim.verdict = count.verdict();
  claim.measured = fmt::format("{:.2f} to {:.2f} % of the faces are gone; more than 95 % in {} of {} cases.", range.low, range.high,
                               count.held, count.all);
  if (!not_so.empty()) claim.why = "Not so: " + listed(not_so) + ".";
  return claim;
}

StudyClaim tolerance_claim(const SoucyStudyResult& result) {
  StudyClaim claim;
  claim.where = "section 1";
  claim.claim = "The tolerance is the maximum distance between the original vertices and the compressed surface.";
  CaseCount count;
  double most = 0;
  for (const SoucyScanResult& s : result.scans)
    for (const SoucyLevel& level : s.levels)
      count.add(level.distance_max <= level.tolerance), most = std::max(most, level.distance_max / level.tolerance);
  claim.verdict = count.verdict();
  claim.measured = fmt::format("Farthest vertex, audited: at most {:.4f} of the tolerance.", most);
  return claim;
}

StudyClaim ramp_claim(const SoucyStudyResult& result) {
  // Contrast that the eye can just tell is about 1 % (Weber); of the range of 255 that is 2.55 steps.
  constexpr double kSeen = 2.55;
  StudyClaim claim;
  claim.where = "section 5";
  claim.claim =
      fmt::format("With the ramp the error is very small; the eye does not detect it (judged: RMS below {} steps of 255, 1 %).", kSeen);
  CaseCount count;
  Range rms, mean;
  std::vector<std::string> not_so;
  for_each(result, SoucyPattern::ramp, result.map_sizes[0], [&](const SoucyScanResult& s, const SoucyMapping& m) {
    const double value = std::sqrt(m.error.mse());
    count.add(value < kSeen), rms.add(value), mean.add(m.error.mean_magnitude());
    if (value >= kSeen) not_so.push_back(fmt::format("{}: {:.2f}", place_of(s, m.level), value));
  });
  claim.verdict = count.verdict();
  claim.measured = fmt::format("{}² maps: RMS {:.2f} to {:.2f} steps, mean magnitude {:.2f} to {:.2f}; below in {} of {} cases.",
                               result.map_sizes[0], rms.low, rms.high, mean.low, mean.high, count.held, count.all);
  if (!not_so.empty())
    claim.why = "Not so: " + listed(not_so) +
                ". A sample is mapped to the nearest point of a surface that is up to the tolerance away; on slopes that point "
                "lies beside the line of sight, and colours move by as much.";
  return claim;
}

StudyClaim edge_claim(const SoucyStudyResult& result) {
  StudyClaim claim;
  claim.where = "section 5";
  claim.claim =
      "With the chessboard the error mainly occurs near colour discontinuities (judged: at least 95 % of the squared error in pixels that "
      "touch a colour edge).";
  CaseCount count, most;
  std::vector<std::pair<std::string, Range>> shares;  // by tolerance
  std::vector<std::string> not_so;
  for_each(result, SoucyPattern::chessboard, result.map_sizes[0], [&](const SoucyScanResult& s, const SoucyMapping& m) {
    const double percent = m.error.sse > 0 ? 100 * static_cast<double>(m.error.edge_sse) / static_cast<double>(m.error.sse) : 100;
    count.add(percent >= 95), most.add(percent > 50);
    const std::string tolerance = length_text(s.levels[m.level].tolerance, s.unit);
    auto known = std::find_if(shares.begin(), shares.end(), [&](const auto& share) { return share.first == tolerance; });
    if (known == shares.end()) known = shares.insert(shares.end(), {tolerance, {}});
    known->second.add(percent);
    if (percent < 95)
      not_so.push_back(fmt::format("{}: {:.1f} %, the tolerance being {:.1f} pixels", place_of(s, m.level), percent,
                                   s.levels[m.level].tolerance / s.grid.spacing));
  });
  std::vector<std::string> found;
  for (const auto& [tolerance, share] : shares) found.push_back(fmt::format("at {} {:.1f} to {:.1f} %", tolerance, share.low, share.high));
  claim.verdict = count.verdict();
  claim.measured = fmt::format("{}² maps: {}; 95 % reached in {} of {} cases, more than half in {}.", result.map_sizes[0], listed(found),
                               count.held, count.all, most.held);
  if (!not_so.empty())
    claim.why =
        "Not so: " + listed(not_so) +
        ". The larger the tolerance, the farther colours move on slopes: by more than a pixel the error leaves the pixels at the edge.";
  return claim;
}

StudyClaim filter_claim(const SoucyStudyResult& result) {
  StudyClaim claim;
  claim.where = "sections 3 and 5, figures 9 and 10";
  claim.claim = "A smaller map filters the colours: texels hold the mean of the samples that fall into them, and the error grows.";
  CaseCount count;
  std::uint64_t wrong = 0, hit = 0;
  Range growth;
  std::vector<std::string> not_so;
  for (const SoucyPattern pattern : kSoucyPatterns)
    for_each(result, pattern, result.map_sizes[1], [&](const SoucyScanResult& s, const SoucyMapping& m) {
      const SoucyError& larger = s.of(m.level, pattern, result.map_sizes[0]).error;
      wrong += m.wrong_means, hit += m.texels.hit;
      count.add(m.wrong_means == 0 && m.error.sse >= larger.sse);
      if (larger.sse > 0) growth.add(static_cast<double>(m.error.sse) / static_cast<double>(larger.sse));
      if (m.error.sse < larger.sse)
        not_so.push_back(fmt::format("{}, {}: {:.3f}", place_of(s, m.level), to_string(pattern),
                                     static_cast<double>(m.error.sse) / static_cast<double>(larger.sse)));
    });
  claim.verdict = count.verdict();
  claim.measured = fmt::format(
      "Of {} hit texels of {}² maps {} are not the integer mean of their hits. Squared error, {}² over {}²: {:.2f} to {:.2f} times.",
      grouped(hit), result.map_sizes[1], grouped(wrong), result.map_sizes[1], result.map_sizes[0], growth.low, growth.high);
  if (!not_so.empty())
    claim.why = "Smaller in the smaller map: " + listed(not_so) +
                ". Where colours are off because they moved, the mean of several is nearer to what should be there than one of them.";
  return claim;
}

StudyClaim seam_claim(const SoucyStudyResult& result) {
  StudyClaim claim;
  claim.where = "section 2";
  claim.claim = "The texture is continuous: the image of every vertex and edge is the same in all triangles.";
  CaseCount count;
  int most = 0;
  const auto add = [&](int residual) { count.add(residual == 0), most = std::max(most, residual); };
  for (const SoucyScanResult& s : result.scans)
    for (const SoucyMapping& m : s.mappings) add(m.seam_residual);
  for (const SoucyModelResult& s : result.models)
    for (const SoucyModelMap& m : s.maps) add(m.seam_residual);
  claim.verdict = count.verdict();
  claim.measured = fmt::format("Largest difference across edges and vertices in {} maps: {}.", count.all, most);
  return claim;
}

StudyClaim silhouette_claim(const SoucyStudyResult& result) {
  StudyClaim claim;
  claim.where = "section 5, figure 11";
  claim.claim =
      "At 1,000 triangles the impression is very similar; most differences are around the silhouette (judged: more than half of the "
      "squared error where only one picture shows the surface).";
  CaseCount count;
  std::vector<std::string> found, not_so;
  for (const SoucyModelResult& s : result.models) {
    const PictureSums& sums = s.maps.front().sums;
    const double outline = sums.sse > 0 ? 100 * static_cast<double>(sums.sse - sums.common_sse) / static_cast<double>(sums.sse) : 100;
    count.add(outline > 50);
    found.push_back(fmt::format("{} ({:.1f} % of its faces gone): {:.0f} %, PSNR {:.1f} dB, of what both show {:.1f} dB", s.name,
                                100 - 100 * static_cast<double>(s.baked_faces) / static_cast<double>(s.faces), outline,
                                sums.whole_db().value_or(200), sums.masked_db().value_or(200)));
    if (outline <= 50) not_so.push_back(s.name);
  }
  claim.verdict = count.verdict();
  claim.measured = fmt::format("{}² map: {}.", result.models.front().maps.front().map_size, listed(found));
  if (!not_so.empty())
    claim.why = "Not so: " + listed(not_so) +
                ". Where colours have detail finer than the tolerance of so few triangles, it is off inside the outline as well.";
  return claim;
}

StudyClaim size_claim(const SoucyStudyResult& result) {
  StudyClaim claim;
  claim.where = "section 5, figure 12";
  claim.claim = "Flat areas have the largest texture triangles, areas of high curvature small ones.";
  CaseCount count;
  std::vector<std::string> found;
  for (const SoucyModelResult& s : result.models) {
    const SoucyModelMap& m = s.maps.front();
    count.add(m.flat_size > m.bent_size);
    found.push_back(fmt::format("{}: {:.1f} and {:.1f} texels", s.name, m.flat_size, m.bent_size));
  }
  claim.verdict = count.verdict();
  claim.measured = "Mean size of the flattest and of the most bent quarter of the triangles: " + listed(found) + ".";
  return claim;
}

}  // namespace

std::vector<StudyClaim> soucy_claims(const SoucyStudyResult& result) {
  std::vector<StudyClaim> claims;
  if (!result.scans.empty())
    claims = {compression_claim(result), tolerance_claim(result), ramp_claim(result), edge_claim(result), filter_claim(result)};
  claims.push_back(seam_claim(result));
  if (!result.models.empty()) claims.push_back(silhouette_claim(result)), claims.push_back(size_claim(result));
  return claims;
}

}  // namespace etalon::validation
