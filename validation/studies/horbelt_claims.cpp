#include <fmt/format.h>

#include <algorithm>

#include "validation/studies/horbelt_report.h"

namespace etalon::validation {
namespace {

constexpr double kMeanGoal = 0.3, kWorstGoal = 1.0, kWorstOfAll = 1.5;

struct Count {
  int held = 0, all = 0;
  void add(bool holds) { held += holds, ++all; }
  [[nodiscard]] ClaimVerdict verdict() const {
    return held == all ? ClaimVerdict::holds : held > 0 ? ClaimVerdict::partly : ClaimVerdict::fails;
  }
};

template <class Body>
void for_each_view(const HorbeltStudyResult& result, const Body& body) {
  for (const HorbeltSubjectResult& subject : result.subjects)
    for (const HorbeltViewResult& view : subject.views) body(subject, view);
}

/// "0.03 to 0.31".
template <class Value>
std::string range_text(const HorbeltStudyResult& result, const char* format, const Value& value) {
  double low = 1e300, high = -1e300;
  for_each_view(result,
                [&](const auto&, const HorbeltViewResult& view) { low = std::min(low, value(view)), high = std::max(high, value(view)); });
  return fmt::format(fmt::runtime(format), low, high);
}

/// Near the best of all pairs: the mean on every view, the worst on four of five views of a terrain, and nowhere farther than kWorstOfAll.
ClaimVerdict nearness(const HorbeltStudyResult& result, HorbeltMethod method) {
  Count count;
  bool worst_holds = true;
  for (const HorbeltSubjectResult& subject : result.subjects) {
    std::size_t near = 0;
    for (const HorbeltViewResult& view : subject.views) {
      const PathGaps& gaps = view.of(method).gaps;
      count.add(gaps.mean_db <= kMeanGoal);
      near += gaps.max_db <= kWorstGoal;
      worst_holds = worst_holds && gaps.max_db <= kWorstOfAll;
    }
    worst_holds = worst_holds && 5 * near >= 4 * subject.views.size();
  }
  return !worst_holds && count.verdict() == ClaimVerdict::holds ? ClaimVerdict::partly : count.verdict();
}

StudyClaim close_claim(const HorbeltStudyResult& result) {
  const ClaimVerdict verdict = nearness(result, HorbeltMethod::slope);
  return {
      .where = "sections 3 and 4, Figure 5",
      .claim = "marginal analysis performs quite close to the optimal exhaustive search.",
      .measured = fmt::format(
          "By slope: {} dB behind the best of all pairs in the mean of a path's points (goal {} on every view), {} dB at worst (goal {} on "
          "four of five views, {} on all).",
          range_text(result, "{:.3f} to {:.3f}", [](const auto& v) { return v.of(HorbeltMethod::slope).gaps.mean_db; }), kMeanGoal,
          range_text(result, "{:.2f} to {:.2f}", [](const auto& v) { return v.of(HorbeltMethod::slope).gaps.max_db; }), kWorstGoal,
          kWorstOfAll),
      .why = verdict == ClaimVerdict::holds
                 ? ""
                 : "A greedy step sees one level ahead; where mesh and texture depend on each other, a pair that "
                   "pays only after two steps is missed.",
      .verdict = verdict};
}

StudyClaim printed_claim(const HorbeltStudyResult& result) {
  const ClaimVerdict verdict = nearness(result, HorbeltMethod::printed);
  return {.where = "section 3, the algorithm as printed",
          .claim = "comparing D(M_i−1, T_j) with D(M_i, T_j−1) finds a path close to the optimum.",
          .measured =
              fmt::format("{} dB behind in the mean, {} dB at worst.",
                          range_text(result, "{:.2f} to {:.2f}", [](const auto& v) { return v.of(HorbeltMethod::printed).gaps.mean_db; }),
                          range_text(result, "{:.2f} to {:.2f}", [](const auto& v) { return v.of(HorbeltMethod::printed).gaps.max_db; })),
          .why = verdict == ClaimVerdict::holds ? ""
                                                : "The printed loop compares errors of steps that remove different numbers of "
                                                  "bits: a texture level of 16 % more coefficients "
                                                  "against a mesh level of 8 % more vertices. Section 2.3 asks for equal bits; the "
                                                  "error per bit is what does that with whole levels.",
          .verdict = verdict};
}

StudyClaim evaluation_claim(const HorbeltStudyResult& result) {
  Count count;
  std::size_t most = 0, pairs = 0, limit = 0;
  for_each_view(result, [&](const auto&, const HorbeltViewResult& view) {
    const std::size_t evaluations = view.of(HorbeltMethod::slope).path.evaluations, levels = view.all.mesh_count + view.all.texture_count;
    count.add(evaluations <= 2 * levels);
    most = std::max(most, evaluations), pairs = std::max(pairs, view.all.errors.size()), limit = std::max(limit, 2 * levels);
  });
  return {.where = "section 4",
          .claim = "exhaustive search evaluates about 2000 pairs, marginal analysis 168: twice as many as its path has.",
          .measured = fmt::format(
              "At most {} pairs on a view against at most {} evaluations (2·(levels) = {}). The path goes on along the border to the "
              "smallest pair, without evaluations.",
              pairs, most, limit),
          .why = "",
          .verdict = count.verdict()};
}

StudyClaim growing_claim(const HorbeltStudyResult& result) {
  Count count;
  for_each_view(result, [&](const auto&, const HorbeltViewResult& view) {
    count.add(view.of(HorbeltMethod::slope).gaps.mean_db <= view.of(HorbeltMethod::grow_slope).gaps.mean_db);
  });
  return {.where = "section 3",
          .claim = "tree growing is doubly greedy, and pruning is preferred.",
          .measured = fmt::format(
              "Growing by slope is {} dB behind in the mean, pruning {}; pruning is at least as near on {} of {} views.",
              range_text(result, "{:.2f} to {:.2f}", [](const auto& v) { return v.of(HorbeltMethod::grow_slope).gaps.mean_db; }),
              range_text(result, "{:.2f} to {:.2f}", [](const auto& v) { return v.of(HorbeltMethod::slope).gaps.mean_db; }), count.held,
              count.all),
          .why = count.verdict() == ClaimVerdict::holds ? "" : "Where the first steps of both are worth taking, growing loses nothing.",
          .verdict = count.verdict()};
}

StudyClaim trade_claim(const HorbeltStudyResult& result) {
  Count count;
  for_each_view(result, [&](const auto&, const HorbeltViewResult& view) {
    const HorbeltTrade &a = view.trades[0], &b = view.trades[1], &c = view.trades[2];
    count.add(a.pair != b.pair && b.pair != c.pair && b.psnr_db.value_or(99) >= a.psnr_db.value_or(99) &&
              b.psnr_db.value_or(99) >= c.psnr_db.value_or(99) && a.mesh_share > c.mesh_share && c.texture_share > a.texture_share);
  });
  return {.where = "Figure 6",
          .claim = "at equal bits: (a) parts of the image are displaced, (c) the image is blurred, the best compromise (b) is in between.",
          .measured = fmt::format(
              "So on {} of {} views: (b) has the highest PSNR, more of (a)'s error than of (c)'s stands when the texture is at its finest "
              "(displacement), more of (c)'s when the mesh is (blur).",
              count.held, count.all),
          .why = count.verdict() == ClaimVerdict::holds
                     ? ""
                     : "On the others one of the three pairs is the best one, or the errors are of one kind.",
          .verdict = count.verdict()};
}

StudyClaim joint_claim(const HorbeltStudyResult& result) {
  Count count;
  for_each_view(result, [&](const auto&, const HorbeltViewResult& view) {
    const double slope = view.of(HorbeltMethod::slope).gaps.mean_db;
    count.add(slope < view.of(HorbeltMethod::texture_first).gaps.mean_db && slope < view.of(HorbeltMethod::mesh_first).gaps.mean_db);
  });
  return {.where = "sections 1 and 3",
          .claim = "mesh and texture are to be treated jointly, not separately.",
          .measured = fmt::format(
              "One after the other: {} dB behind where the texture goes first, {} where the mesh does. Each judged alone by slope: {} dB.",
              range_text(result, "{:.2f} to {:.2f}", [](const auto& v) { return v.of(HorbeltMethod::texture_first).gaps.mean_db; }),
              range_text(result, "{:.2f} to {:.2f}", [](const auto& v) { return v.of(HorbeltMethod::mesh_first).gaps.mean_db; }),
              range_text(result, "{:.2f} to {:.2f}", [](const auto& v) { return v.of(HorbeltMethod::independent).gaps.mean_db; })),
          .why = count.verdict() == ClaimVerdict::holds ? "" : "On some views one of the two hardly matters.",
          .verdict = count.verdict()};
}

StudyClaim visible_claim(const HorbeltStudyResult& result) {
  Count count;
  std::string measured;
  for (const HorbeltSubjectResult& subject : result.subjects) {
    if (subject.has_own_views) continue;
    const HorbeltViewResult& view = subject.views.front();
    const double percent = 100.0 * static_cast<double>(view.visible_faces) / static_cast<double>(view.faces);
    count.add(percent >= 8 && percent <= 12);
    measured += fmt::format("{}{}: {:.1f} % of the triangles reach a pixel", measured.empty() ? "" : "; ", subject.name, percent);
  }
  return {.where = "section 4",
          .claim = "only 10 % of the terrain model is visible (one view).",
          .measured = measured + ".",
          .why = "",
          .verdict = count.verdict()};
}

}  // namespace

std::vector<StudyClaim> horbelt_claims(const HorbeltStudyResult& result) {
  std::vector<StudyClaim> claims = {close_claim(result),   printed_claim(result), evaluation_claim(result),
                                    growing_claim(result), trade_claim(result),   joint_claim(result)};
  // The paper says it of its own view: of a user's there is nothing to judge.
  const auto has_own_views = [](const HorbeltSubjectResult& subject) { return subject.has_own_views; };
  if (!std::ranges::all_of(result.subjects, has_own_views)) claims.push_back(visible_claim(result));
  return claims;
}

}  // namespace etalon::validation
