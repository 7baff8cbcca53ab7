#include "validation/report/json_report.h"

#include <doctest/doctest.h>

#include "tests/validation/report/sample_result.h"

using namespace etalon;
using namespace etalon::validation;

TEST_CASE("numbers in groups of three") {
  CHECK(grouped(0) == "0");
  CHECK(grouped(999) == "999");
  CHECK(grouped(1000) == "1,000");
  CHECK(grouped(1234567) == "1,234,567");
}

TEST_CASE("the document: sums, classes, base names only, run apart") {
  RunInfo run;
  run.version = "0";
  run.threads = 3;
  run.paths = {"/secret/place/head.glb"};
  auto document = verify_document(test::sample_result(), run);
  CHECK(document["schema"] == "etalon/verify/1");
  CHECK(document["verdict"] == "agreed");
  CHECK(document["total"]["texels"] == 16);
  CHECK(document["total"]["tie"] == 1);
  CHECK(document["jobs"][0]["cases"][0]["targets"][0]["difference"]["sse"] == 9);
  CHECK(document["jobs"][1]["skipped"] == "no texture coordinates (try another)");
  CHECK(document["run"]["paths"][0] == "/secret/place/head.glb");
  document.erase("run");
  CHECK(document.dump().find("/secret") == std::string::npos);
  VerifyResult identical = test::sample_result();
  identical.jobs[0].cases[0].targets[0].difference = measure_difference(Image(1, 1, kRgb8), Image(1, 1, kRgb8));
  CHECK(verify_document(identical, run)["jobs"][0]["cases"][0]["targets"][0]["difference"]["psnr_db"].is_null());
}

TEST_CASE("a file name that is not UTF-8 does not break the document") {
  VerifyResult result = test::sample_result();
  result.inputs[0].name = "\xff.glb";
  CHECK(to_text(verify_document(result, {})).find("\xEF\xBF\xBD.glb") != std::string::npos);
}

TEST_CASE("the verdict: an unexplained texel fails, no texel compares nothing") {
  VerifyResult result = test::sample_result();
  CHECK(verdict(result) == Verdict::agreed);
  result.jobs[0].cases[0].tally.unexplained = 1;
  CHECK(verdict(result) == Verdict::failed);
  result.jobs[0].cases.clear();
  CHECK(verdict(result) == Verdict::not_compared);
}

TEST_CASE("raster state, covered texels, skipped scenes and caveats are in the document and the table") {
  VerifyResult result = test::sample_result();
  result.state.subtexel_bits = 6;
  result.caveats = {"the device is small"};
  result.jobs[0].cases[0].skipped = "too wide";
  const auto document = verify_document(result, {});
  CHECK(document["state"]["subtexel_bits"] == 6);
  CHECK(document["state"]["snap"] == "nearest_even");
  CHECK(document["state"]["fill_rule"] == "left_ymin");
  CHECK(document["state"]["half_rounding"] == "nearest_even");
  CHECK(document["notes"].back() == "the device is small");
  CHECK(document["jobs"][0]["cases"][0]["covered"] == 7);
  CHECK(document["jobs"][0]["cases"][0]["skipped"] == "too wide");
  CHECK(document["verdict"] == "not_compared");
  const std::vector<std::string> lines = verify_table(result);
  CHECK(lines[1].find("skipped: too wide") != std::string::npos);
  CHECK(lines.back() == "note: the device is small");
}

TEST_CASE("CSV: quoted fields, a line per scene, per job and for all") {
  const std::string csv = verify_csv(test::sample_result());
  CHECK(csv.find("render,\"a <b> & \"\"c\"\", d\",fit,nearest,16,15,0,1,0,0\r\n") != std::string::npos);
  CHECK(csv.rfind("total,,,all,16,15,0,1,0,0\r\n") != std::string::npos);
}

TEST_CASE("the table names unbounded and unexplained even when 0") {
  const std::vector<std::string> lines = verify_table(test::sample_result());
  REQUIRE(lines.size() == 4);
  CHECK(lines[0].find("unbounded") != std::string::npos);
  CHECK(lines[2] == "indexed  skipped: no texture coordinates (try another)");
  CHECK(lines[3].rfind("total", 0) == 0);
  CHECK(lines[3].back() == '0');
}
