#include "validation/report/html_report.h"

#include <cstdlib>
#include <filesystem>
#include <regex>

#include <doctest/doctest.h>

#include "core/base/error.h"
#include "tests/validation/report/sample_result.h"

using namespace etalon;
using namespace etalon::validation;

namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++n;
  return n;
}

}  // namespace

TEST_CASE("the page needs nothing from outside") {
  const std::string page = verify_page(test::sample_result(), {});
  const std::regex reference(R"((src|href|data|action|poster)\s*=\s*"([^"]*))");
  for (auto it = std::sregex_iterator(page.begin(), page.end(), reference); it != std::sregex_iterator(); ++it) {
    const std::string target = (*it)[2];
    CAPTURE(target.substr(0, 60));
    CHECK((target.rfind("data:image/png;base64,", 0) == 0 || target.rfind("#", 0) == 0));
  }
  CHECK(count(page, "@import") == 0);
  CHECK(count(page, "url(") == 0);
  CHECK(count(page, "fetch(") == 0);
}

TEST_CASE("whatever names and sentences hold stays text") {
  const std::string page = verify_page(test::sample_result(), {});
  CHECK(page.find("a &lt;b&gt; &amp; &quot;c&quot;, d") != std::string::npos);
  CHECK(count(page, "<b> & ") == 0);
  CHECK(count(page, "<script>alert") == 0);
  CHECK(count(page, "</script>") == 2);
  CHECK(count(page, "/secret/place") == 0);
}

TEST_CASE("the page says what the result says") {
  VerifyResult result = test::sample_result();
  CHECK(verify_page(result, {}).find("Every texel is explained.") != std::string::npos);
  CHECK(verify_page(result, {}).find("head.glb: Somebody, CC BY 3.0.") != std::string::npos);
  CHECK(verify_page(result, {}).find("skipped: no texture coordinates") != std::string::npos);
  result.jobs[0].cases[0].tally.unbounded = 1;
  CHECK(verify_page(result, {}).find("Every texel is explained.") == std::string::npos);
  result.jobs[0].cases[0].tally.unexplained = 2;
  result.jobs[0].cases[0].diagnosis = "coverage: of one side";
  CHECK(verify_page(result, {}).find("2 texels are unexplained.") != std::string::npos);
  CHECK(verify_page(result, {}).find("coverage: of one side") != std::string::npos);
  result.jobs.clear();
  result.gl_unavailable = "no library";
  CHECK(verify_page(result, {}).find("OpenGL is not available: no library") != std::string::npos);
}

TEST_CASE("the page calls nothing explained that was not drawn, and says which state was compared") {
  const auto has = [](const VerifyResult& result, const std::string& text) {
    return verify_page(result, {}).find(text) != std::string::npos;
  };
  VerifyResult result = test::sample_result();
  result.state.subtexel_bits = 6;
  CHECK(has(result, "6 sub-texel bits"));
  result.jobs[0].cases[0].covered = 0;
  CHECK(has(result, "Nothing was drawn."));
  CHECK_FALSE(has(result, "Every texel is explained."));
  result = test::sample_result();
  CaseResult skipped = result.jobs[0].cases[0];
  skipped.skipped = "texture <too> wide";
  skipped.targets.clear();
  skipped.tally = {};
  result.jobs[0].cases.insert(result.jobs[0].cases.begin(), skipped);
  CHECK(has(result, "Not every scene was compared."));
  CHECK(has(result, "skipped: texture &lt;too&gt; wide"));
  CHECK(has(result, "data-from=\"case-0-1\""));  // the first scene that has a picture
}

TEST_CASE("a picture that both sides drew alike is not called the whole scene") {
  VerifyResult result = test::sample_result();
  CaseResult& item = result.jobs[0].cases[0];
  TargetResult depth = item.targets[0];
  depth.content = "depth";
  item.targets[0].gl_picture = {};
  item.targets[0].difference = measure_difference(item.targets[0].cpu_picture, item.targets[0].cpu_picture);
  CHECK(verify_page(result, {}).find("CPU, exact = OpenGL") != std::string::npos);
  item.targets.push_back(depth);
  const std::string page = verify_page(result, {});
  CHECK(page.find("CPU, exact = OpenGL") == std::string::npos);
  CHECK(page.find("colour identical; depth differs in 1") != std::string::npos);
}

TEST_CASE("a report is written whole, and refused where it cannot be") {
  std::string pattern = (std::filesystem::temp_directory_path() / "etalon-report-XXXXXX").string();
  REQUIRE(mkdtemp(pattern.data()) != nullptr);
  const std::filesystem::path folder = pattern;
  const std::filesystem::path page = write_verify_report(folder / "a" / "b", test::sample_result(), {});
  CHECK(page == folder / "a" / "b" / "index.html");
  for (const char* name : {"index.html", "verify.json", "classes.csv"}) CHECK(std::filesystem::file_size(folder / "a" / "b" / name) > 0);
  CHECK_THROWS_AS((void)write_verify_report(page / "c", test::sample_result(), {}), WriteError);
  CHECK_THROWS_AS((void)write_verify_report(page, test::sample_result(), {}), WriteError);
  std::filesystem::remove_all(folder);
}
