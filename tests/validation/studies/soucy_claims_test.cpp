// The verdicts, on results made by hand.
#include <doctest/doctest.h>

#include "validation/studies/soucy_report.h"
#include "validation/studies/study_tables.h"

using namespace etalon;
using namespace etalon::validation;

namespace {

SoucyError error_of(std::uint64_t texels, std::uint64_t sse, std::uint64_t edge_sse, int channels) {
  SoucyError error;
  error.texels = texels, error.sse = sse, error.edge_sse = edge_sse, error.channels = channels;
  return error;
}

SoucyStudyResult good() {
  SoucyStudyResult result;
  result.map_sizes = {512, 256};
  SoucyScanResult scan;
  scan.name = std::string("telephone"), scan.unit = std::string("mm"), scan.faces = 10'000;
  scan.levels = {{.tolerance = 1, .vertices = 200, .faces = 400, .distance_max = 0.99}};
  for (const SoucyPattern pattern : kSoucyPatterns)
    for (const int size : {512, 256}) {
      SoucyMapping m;
      m.pattern = pattern, m.map_size = size, m.texels.hit = 50;
      m.error = pattern == SoucyPattern::ramp ? error_of(100, size == 512 ? 100u : 200u, 0, 2) : error_of(100, 1000, 960, 1);
      scan.mappings.push_back(m);
    }
  result.scans = {scan};
  SoucyModelResult model;
  model.name = std::string("duck"), model.faces = 1000, model.baked_faces = 10;
  SoucyModelMap map;
  map.map_size = 512, map.flat_size = 20, map.bent_size = 10;
  map.sums.texels = 10, map.sums.sse = 100, map.sums.common_texels = 5, map.sums.common_sse = 40;
  model.maps = {map};
  result.models = {model};
  return result;
}

std::vector<ClaimVerdict> verdicts(const SoucyStudyResult& result) {
  std::vector<ClaimVerdict> all;
  for (const StudyClaim& claim : soucy_claims(result)) {
    all.push_back(claim.verdict);
    CHECK(!claim.measured.empty());
  }
  return all;
}

}  // namespace

TEST_CASE("every claim can hold, and each fails by its own number alone") {
  using enum ClaimVerdict;
  CHECK(verdicts(good()) == std::vector<ClaimVerdict>(8, holds));
  const auto fails_at = [](std::size_t n, const std::function<void(SoucyStudyResult&)>& spoil) {
    SoucyStudyResult result = good();
    spoil(result);
    std::vector<ClaimVerdict> expected(8, holds);
    expected[n] = fails;
    CAPTURE(n);
    CHECK(verdicts(result) == expected);
  };
  fails_at(0, [](SoucyStudyResult& r) { r.scans[0].levels[0].faces = 500; });  // 95 % is not more than 95 %
  fails_at(1, [](SoucyStudyResult& r) { r.scans[0].levels[0].distance_max = 1.01; });
  fails_at(2, [](SoucyStudyResult& r) { r.scans[0].mappings[2].error.sse = 1301, r.scans[0].mappings[3].error.sse = 1301; });  // RMS 2.5505
  fails_at(3, [](SoucyStudyResult& r) { r.scans[0].mappings[0].error.edge_sse = 949; });
  fails_at(6, [](SoucyStudyResult& r) { r.models[0].maps[0].sums.common_sse = 50; });
  fails_at(7, [](SoucyStudyResult& r) { r.models[0].maps[0].flat_size = 10; });
  // Two cases of means and sums, one of three maps: partly.
  SoucyStudyResult mean = good();
  mean.scans[0].mappings[3].wrong_means = 1;
  CHECK(verdicts(mean)[4] == partly);
  SoucyStudyResult sum = good();
  sum.scans[0].mappings[1].error.sse = 999;
  CHECK(verdicts(sum)[4] == partly);
  SoucyStudyResult seam = good();
  seam.scans[0].mappings[1].seam_residual = 1;
  CHECK(verdicts(seam)[5] == partly);
}

TEST_CASE("claims on what is not there are not made") {
  SoucyStudyResult models = good(), scans = good();
  models.scans.clear();
  scans.models.clear();
  CHECK(soucy_claims(models).size() == 3);
  CHECK(soucy_claims(scans).size() == 6);
}

TEST_CASE("tables of studies: quotients, shares, counts of cases, lists") {
  CHECK(quotient(3, 2) == 1.5);
  CHECK(!quotient(3, 0));
  CHECK(percent_cell(1, 8, 1).text == "12.5");
  CHECK(percent_cell(1, 0, 1).text == "–");
  CaseCount count;
  CHECK(count.verdict() == ClaimVerdict::fails);
  count.add(true);
  CHECK(count.verdict() == ClaimVerdict::holds);
  count.add(false);
  CHECK(count.verdict() == ClaimVerdict::partly);
  CHECK(listed({"a", "b", "c"}, 2) == "a; b; …");
  CHECK(listed({"a", "b"}, 2) == "a; b");
  ClassCounts classes;
  classes[TexelClass::identical] = 5, classes[TexelClass::unexplained] = 2;
  const std::vector<StudyCell> cells = class_cells(classes);
  REQUIRE(cells.size() == class_columns().size());
  CHECK(cells.front().value == 7);
  CHECK(cells.back().value == 2);
  CHECK(length_text(1, "mm") == "1 mm");
  CHECK(length_text(0.25, "") == "0.25");
}
