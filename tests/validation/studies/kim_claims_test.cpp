// Verdicts on results made by hand.
#include <doctest/doctest.h>

#include "validation/studies/kim_report.h"

using namespace etalon;
using namespace etalon::validation;

namespace {

KimOutcome outcome(KimMethod method, double geometry, double image, double seconds, std::size_t bytes) {
  KimOutcome o;
  o.method = method;
  o.vertices = 10;
  o.mean = o.rms = o.max = geometry;
  o.image_rms = o.image_rms_views = image;
  o.seconds = seconds;
  o.state_bytes_per_vertex = bytes;
  o.picture = o.closeup = o.error = o.closeup_error = Image(2, 2, kRgb8);
  return o;
}

/// kim against a quadric of 1 everywhere.
KimSubjectResult subject(const std::string& name, double geometry, double image, double seconds) {
  KimSubjectResult s;
  s.name = name;
  s.reduction = 0.9;
  s.vertices = 100;
  s.picture = s.closeup = Image(2, 2, kRgb8);
  s.outcomes = {outcome(KimMethod::qem6, 1, 1, 1, 112), outcome(KimMethod::qem6_full, 1, 1, 1, 112),
                outcome(KimMethod::kim, geometry, image, seconds, 48), outcome(KimMethod::qem, 0.8, 2, 0.3, 40)};
  return s;
}

KimStudyResult result_of(std::vector<KimSubjectResult> subjects) {
  KimStudyResult result;
  result.exact_name = "exact";
  result.view_count = 24;
  result.subjects = std::move(subjects);
  return result;
}

const StudyClaim& claim_of(const std::vector<StudyClaim>& claims, const std::string& word) {
  for (const StudyClaim& claim : claims)
    if (claim.claim.find(word) != std::string::npos) return claim;
  FAIL("no claim with " << word);
  return claims.front();
}

}  // namespace

TEST_CASE("claims that hold say so and need no reason") {
  const auto claims = kim_claims(result_of({subject("a", 0.9, 1.2, 1.6), subject("b", 0.5, 1.1, 1.7)}));
  CHECK(claims.size() == 5);
  for (const StudyClaim& claim : claims) {
    CAPTURE(claim.claim);
    CHECK(claim.verdict == ClaimVerdict::holds);
    CHECK(claim.why.empty());
    CHECK(claim.measured.find("a ") != std::string::npos);
    CHECK(claim.timed == (claim.where == "table 1, section 5.1"));
  }
  CHECK(claim_of(claims, "The mean").measured == "kim/qem6, half-edge: a 0.90, b 0.50; full-edge: a 0.90, b 0.50.");
}

TEST_CASE("a ratio near 0 is not rounded to 0") {
  const auto claims = kim_claims(result_of({subject("flat", 0.0004, 1.2, 1.6)}));
  CHECK(claim_of(claims, "The mean").measured == "kim/qem6, half-edge: flat 0.0004; full-edge: flat 0.0004.");
}

TEST_CASE("claims that fail, for one subject or for all, say where and why") {
  std::vector<KimSubjectResult> subjects{subject("a", 1.3, 0.7, 0.9), subject("b", 0.5, 1.1, 1.7)};
  subjects[0].sweep = {{1e-5, 0.8, 0.8, 1.5}, {1e-4, 1.3, 1.3, 0.7}};
  auto claims = kim_claims(result_of(subjects));
  const StudyClaim& mean = claim_of(claims, "The mean");
  CHECK(mean.verdict == ClaimVerdict::partly);
  CHECK(mean.why.find("On a it would hold with a unit of D/1e+05 (ratio 0.80; the image RMS is then 1.50 times that of qem6)") !=
        std::string::npos);
  CHECK(mean.why.find("On b") == std::string::npos);
  CHECK(claim_of(claims, "keeps colours").verdict == ClaimVerdict::partly);
  CHECK(claim_of(claims, "keeps colours").why.find("On a outlines") != std::string::npos);
  CHECK(claim_of(claims, "keeps colours").why.find("On b") == std::string::npos);
  CHECK(claim_of(claims, "takes longer").verdict == ClaimVerdict::partly);
  CHECK(!claim_of(claims, "takes longer").why.empty());

  subjects.pop_back();
  subjects[0].sweep[0].mean = 1.1;
  claims = kim_claims(result_of(subjects));
  CHECK(claim_of(claims, "The mean").verdict == ClaimVerdict::fails);
  CHECK(claim_of(claims, "The mean").why.find("for no unit in eight decades (least ratio 1.10") != std::string::npos);
  CHECK(claim_of(claims, "keeps colours").verdict == ClaimVerdict::fails);
  CHECK(!claim_of(claims, "keeps colours").why.empty());

  subjects[0].outcomes[2].state_bytes_per_vertex = 49;
  CHECK(claim_of(kim_claims(result_of(subjects)), "48 bytes").verdict == ClaimVerdict::fails);
}

TEST_CASE("a claim that holds against half-edge collapses only is partly held, and says so") {
  std::vector<KimSubjectResult> subjects{subject("a", 0.9, 1.2, 1.6)};
  subjects[0].outcomes[1].mean = 0.8;
  const auto claims = kim_claims(result_of(subjects));
  CHECK(claim_of(claims, "The mean").verdict == ClaimVerdict::partly);
  CHECK(claim_of(claims, "The mean").why.find("On a it holds against half-edge collapses and not against full-edge ones") !=
        std::string::npos);
}

TEST_CASE("the report: the paper's ratios beside ours, times apart, pictures named once") {
  std::vector<KimSubjectResult> subjects{subject("monkey", 0.9, 1.2, 1.6), subject("own", 0.5, 1.1, 1.7)};
  subjects[0].paper_row = 0;
  subjects[1].attribution = "by A. Body";
  const StudyReport report = kim_report(result_of(subjects));
  for (const StudyTable& table : report.tables) {
    CAPTURE(table.name);
    CHECK(table.timed == (table.name == "table1-times"));
    for (const auto& row : table.rows) CHECK(row.size() == table.columns.size());
  }
  const StudyTable& geometry = report.tables[2];
  REQUIRE(geometry.rows.size() == 8);
  CHECK(*geometry.rows[0].back().value == doctest::Approx(4.69 / 5.30));
  CHECK(geometry.rows[2].back().text == "–");
  CHECK(geometry.rows[4].back().text == "–");
  bool credited = false;
  for (const StudyFigure& figure : report.figures) credited = credited || figure.caption.find("by A. Body") != std::string::npos;
  CHECK(credited);
}
