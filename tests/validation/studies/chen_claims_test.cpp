#include <doctest/doctest.h>

#include "raster/cpu_renderer.h"
#include "validation/studies/chen_report.h"

using namespace etalon;
using namespace etalon::validation;

namespace {

/// One model, one texture, one level: all claims on it hold.
ChenStudyResult good() {
  ChenStudyResult result;
  result.line.c_after = result.line.c.x;
  ChenSubjectResult s;
  s.name = "model", s.textures = {"colour"}, s.levels = {100};
  const double db[] = {20, 21, 24.5, 24, 24, 24.2}, detail[] = {1, 1, 0.5, 0.99, 1, 0.8};  // in the order of kChenMethods
  for (std::size_t n = 0; n < kChenMethods.size(); ++n) {
    ChenOutcome o;
    o.method = kChenMethods[n], o.masked_db = db[n], o.whole_db = db[n], o.detail = detail[n];
    s.outcomes.push_back(o);
  }
  s.records.cells = 1000;
  s.packing.adaptations = 1400, s.packing.packs = 100, s.packing.printed_packs = 50, s.packing.same_bytes = true;
  s.packing.exact.single_ms = 14, s.packing.exact.packed_ms = 1;
  const double format_db[] = {24, 23.95, 24, 22};
  const ChannelType types[] = {ChannelType::float32, ChannelType::half, ChannelType::unorm16, ChannelType::unorm8};
  for (std::size_t n = 0; n < 4; ++n) s.formats.push_back({{.type = types[n]}, format_db[n], {}});
  result.subjects.push_back(s);
  return result;
}

ChenOutcome& outcome(ChenStudyResult& result, ChenMethod method) {
  for (ChenOutcome& o : result.subjects.front().outcomes)
    if (o.method == method) return o;
  FAIL("no such outcome");
  return result.subjects.front().outcomes.front();
}

const StudyClaim& claim(const std::vector<StudyClaim>& claims, const char* words) {
  for (const StudyClaim& c : claims)
    if (c.claim.find(words) != std::string::npos) return c;
  FAIL("no claim: ", words);
  return claims.front();
}

constexpr const char *kBetter = "better than the same level", *kAps = "deviation (APS)", *kLimit = "exact limit", *kRebake = "made anew",
                     *kCells = "folding", *kBlur = "blur", *kFormats = "16 bits", *kPacks = "share a setup", *kTimes = "times as fast",
                     *kPlane = "in the plane";

}  // namespace

TEST_CASE("claims of study chen: all hold where all is well") {
  const std::vector<StudyClaim> claims = chen_claims(good());
  CHECK(claims.size() == 10);
  for (const StudyClaim& c : claims) {
    CAPTURE(c.claim);
    CHECK(c.verdict == ClaimVerdict::holds);
    CHECK(!c.measured.empty());
    CHECK(!c.where.empty());
    CHECK(c.timed == (c.claim.find(kTimes) != std::string::npos));
  }
}

TEST_CASE("claims of study chen: sharing is judged where there are objects to share") {
  ChenStudyResult result = good();
  result.sharing = ChenSharing{.names = {"one", "other"}, .packs = {10, 6}, .passes = 10, .texels = 32, .differing = 3, .largest = 0.01};
  const auto verdict = [&] { return claim(chen_claims(result), "shared among objects").verdict; };
  CHECK(chen_claims(result).size() == 11);
  CHECK(claim(chen_claims(result), "shared among objects").measured.find("10 passes instead of 16") != std::string::npos);
  CHECK(verdict() == ClaimVerdict::holds);
  result.sharing->largest = 2;
  CHECK(verdict() == ClaimVerdict::fails);
  result.sharing->largest = 0, result.sharing->passes = 16;
  CHECK(verdict() == ClaimVerdict::fails);
}

TEST_CASE("claims of study chen: each fails by what it is about, and says where") {
  ChenStudyResult worse = good();
  outcome(worse, ChenMethod::indexed).masked_db = 19.5;
  auto claims = chen_claims(worse);
  CHECK(claim(claims, kBetter).verdict == ClaimVerdict::partly);  // the adapted texture is still better
  CHECK(claim(claims, kBetter).why.find("model colour at 100: -0.50 dB through the map") != std::string::npos);
  CHECK(claim(claims, kRebake).verdict == ClaimVerdict::partly);
  outcome(worse, ChenMethod::adapted).masked_db = 19.5;
  claims = chen_claims(worse);
  CHECK(claim(claims, kBetter).verdict == ClaimVerdict::fails);
  CHECK(claim(claims, kAps).verdict == ClaimVerdict::fails);
  CHECK(claim(claims, kRebake).verdict == ClaimVerdict::fails);

  ChenStudyResult limit = good();
  outcome(limit, ChenMethod::analytic).masked_db = 23.9;
  CHECK(claim(chen_claims(limit), kLimit).verdict == ClaimVerdict::fails);
  outcome(limit, ChenMethod::analytic).masked_db = 23.96;
  CHECK(claim(chen_claims(limit), kLimit).verdict == ClaimVerdict::holds);
  outcome(limit, ChenMethod::analytic).masked_db.reset();  // the same picture
  CHECK(claim(chen_claims(limit), kLimit).verdict == ClaimVerdict::holds);

  ChenStudyResult other = good();
  other.subjects.front().records.folded_cells = 1;
  other.subjects.front().packing.same_bytes = false;
  other.subjects.front().packing.exact.packed_ms = 15;
  other.subjects.front().formats[1].masked_db = 23.5;
  outcome(other, ChenMethod::indexed).detail = 0.9;
  other.plane.levels[2].farthest = 0.001;
  claims = chen_claims(other);
  CHECK(claim(claims, kCells).verdict == ClaimVerdict::fails);
  CHECK(claim(claims, kPacks).verdict == ClaimVerdict::fails);
  CHECK(claim(claims, kTimes).verdict == ClaimVerdict::fails);
  CHECK(claim(claims, kFormats).verdict == ClaimVerdict::partly);
  CHECK(claim(claims, kBlur).verdict == ClaimVerdict::partly);
  CHECK(claim(claims, kPlane).verdict == ClaimVerdict::fails);
}

TEST_CASE("report of study chen: the paper's numbers stand beside a model that it has") {
  ChenStudyResult result = good();
  result.subjects.front().paper_row = 0;
  result.subjects.front().originals = result.subjects.front().originals_close = {Image(4, 4, kRgb8)};
  raster::CpuRenderer renderer;
  result.plane = plane_example(renderer, 64);
  const StudyReport report = chen_report(result);
  const StudyTable* packs = nullptr;
  for (const StudyTable& table : report.tables)
    if (table.name == "table1-packs") packs = &table;
  REQUIRE(packs != nullptr);
  const auto& row = packs->rows.front();
  CHECK(row[5].text == "14.00");   // 1,400 in 100 packs
  CHECK(row[11].text == "3,611");  // the paper's
  CHECK(row[13].text == "13.73");  // 3,611 / 263
  for (const StudyTable& table : report.tables) {
    CAPTURE(table.name);
    for (const auto& each : table.rows) CHECK(each.size() == table.columns.size());
  }
}
