#include "validation/studies/horbelt_study.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "core/base/rng.h"
#include "raster/cpu_renderer.h"
#include "validation/studies/horbelt_flight_figure.h"
#include "validation/studies/horbelt_report.h"

using namespace etalon;
using namespace etalon::validation;

namespace {

HorbeltSubject small_subject() {
  HorbeltSubject subject;
  subject.name = "hills", subject.title = "hills";
  subject.field = {.bits = 6, .spacing = 20, .unit = 0x1p-6, .uv_start = 0.5 / 65, .uv_step = 1.0 / 65, .heights = {}};
  Rng rng(2);
  for (int j = 0; j < 65; ++j)
    for (int i = 0; i < 65; ++i) {
      const int bump =
          std::max(0, 900 - (i - 20) * (i - 20) - (j - 30) * (j - 30)) + std::max(0, 500 - 2 * (i - 50) * (i - 50) - (j - 15) * (j - 15));
      subject.field.heights.push_back(64 * 500 + 12 * bump + static_cast<int>(rng.below(300)));
    }
  subject.image = Image(96, 96, kRgb8);
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 96; ++x) {
      auto* texel = subject.image.channels<std::uint8_t>(x, y);
      texel[0] = static_cast<std::uint8_t>(80 + (x / 9 + y / 9) % 2 * 90 + static_cast<int>(rng.below(20)));
      texel[1] = static_cast<std::uint8_t>(60 + x), texel[2] = static_cast<std::uint8_t>(200 - y);
    }
  return subject;
}

HorbeltStudyOptions small_options() {
  HorbeltStudyOptions options;
  options.width = 128, options.height = 96;
  options.view_count = 2;
  options.levels.meshes = 10, options.levels.textures = 7;
  options.flight_frames = 3;
  return options;
}

}  // namespace

TEST_CASE("study horbelt: a small one, and what must be true of any") {
  raster::CpuRenderer exact;
  const HorbeltStudyResult result = run_horbelt_study({small_subject()}, exact, small_options());
  REQUIRE(result.subjects.size() == 1);
  REQUIRE(result.subjects[0].views.size() == 2);
  for (const HorbeltViewResult& view : result.subjects[0].views) {
    CHECK(view.outcomes.size() == kHorbeltMethods.size());
    CHECK(view.all.errors.size() == view.mesh_bits.size() * view.texture_bits.size());
    for (const HorbeltOutcome& o : view.outcomes) {
      CHECK(o.gaps.mean_db >= 0);
      CHECK(o.gaps.max_db >= o.gaps.mean_db);
      CHECK(o.path.points.front().pair == joint::Pair{0, 0});
      CHECK(o.path.points.back().pair == joint::Pair{view.mesh_bits.size() - 1, view.texture_bits.size() - 1});
      for (const joint::PathPoint& p : o.path.points) CHECK(p.error == view.all.error(p.pair));
    }
    CHECK(view.of(HorbeltMethod::texture_first).path.evaluations == 0);
    REQUIRE(view.trades.size() == 3);
    CHECK(view.trades[0].pair.texture >= view.trades[1].pair.texture);
    CHECK(view.trades[2].pair.mesh >= view.trades[1].pair.mesh);
    for (const HorbeltTrade& t : view.trades) CHECK(t.psnr_db.value_or(99) <= view.trades[1].psnr_db.value_or(99));
    CHECK(view.full.width() == 128);
    CHECK(view.mesh_map.width() == view.texture_map.width());
    REQUIRE(view.distances.size() >= 2);
    CHECK(view.distances.front().distance == 1);
    for (std::size_t n = 1; n < view.distances.size(); ++n) {
      CHECK(view.distances[n].distance > view.distances[n - 1].distance);
      CHECK(view.distances[n].significant < view.distances[n - 1].significant);
      CHECK(view.distances[n].bits < view.distances[n - 1].bits);
    }
  }
  const std::vector<FlightFrame>& flight = result.subjects[0].flight;
  REQUIRE(flight.size() == 3);
  for (const FlightFrame& frame : flight) {
    CHECK_FALSE(frame.is_over_budget);
    CHECK(frame.mesh_bits + frame.texture_bits <= result.subjects[0].flight_budget_bits);
    CHECK(frame.psnr_db.value_or(99) > 10);
    CHECK(frame.picture.width() == 64);
  }
  CHECK(flight[0].view.eye.x < flight[2].view.eye.x);
  const Image sheet = contact_sheet(flight);
  CHECK(sheet.width() == 3 * 64 + 4 * 2);
  CHECK(sheet.height() == 48 + 2 * 2);
  for (const auto& [x, y] : {std::pair{0, 0}, {63, 47}})
    CHECK(std::equal(sheet.texel(2 + 66 + x, 2 + y), sheet.texel(2 + 66 + x, 2 + y) + 3, flight[1].picture.texel(x, y)));
  const HorbeltViewResult& valley = result.subjects[0].views[0];
  CHECK(valley.view.name == "valley");
  CHECK(100 * valley.visible_faces >= 8 * valley.faces);
  CHECK(100 * valley.visible_faces <= 12 * valley.faces);
  CHECK(result.unexplained() == 0);

  const StudyReport report = horbelt_report(result);
  CHECK(report.claims.size() == 7);
  CHECK(report.figures.size() == 2 * 5 + 1);
  CHECK(report.figures.back().pictures.size() == 3);
  CHECK(report.figures.back().is_film);
  CHECK(report.tables[0].rows.size() == 2 * kHorbeltMethods.size());
  CHECK(report.figures[0].svg.starts_with("<svg"));
}

TEST_CASE("a flight whose budget is below the smallest pair takes that, and says so") {
  raster::CpuRenderer exact;
  const HorbeltSubject subject = small_subject();
  FlightOptions options{.frames = 1, .width = 64, .height = 48, .budget_bits = 8};
  options.levels.meshes = 3, options.levels.textures = 3;
  const std::vector<FlightFrame> flight = fly_over(exact, subject.field, subject.image, options);
  REQUIRE(flight.size() == 1);
  CHECK(flight[0].is_over_budget);
  CHECK(flight[0].pair == joint::Pair{0, 0});
  HorbeltSubjectResult result{.name = "hills"};
  result.flight = flight;
  CHECK(flight_figure(result).pictures[0].label.find("over the budget") != std::string::npos);
}

TEST_CASE("study horbelt: claims follow the goals") {
  raster::CpuRenderer exact;
  HorbeltStudyResult result = run_horbelt_study({small_subject()}, exact, small_options());
  const auto slope = [&](std::size_t view) -> PathGaps& { return result.subjects[0].views[view].outcomes[0].gaps; };
  slope(0).mean_db = slope(1).mean_db = 0.2, slope(0).max_db = slope(1).max_db = 0.9;
  CHECK(horbelt_claims(result)[0].verdict == ClaimVerdict::holds);
  slope(1).max_db = 1.6;
  CHECK(horbelt_claims(result)[0].verdict == ClaimVerdict::partly);
  slope(1).max_db = 0.9, slope(1).mean_db = 0.31;
  CHECK(horbelt_claims(result)[0].verdict == ClaimVerdict::partly);
  slope(0).mean_db = 0.31;
  CHECK(horbelt_claims(result)[0].verdict == ClaimVerdict::fails);
  CHECK_FALSE(horbelt_claims(result)[0].why.empty());
  result.subjects[0].views[0].visible_faces = result.subjects[0].views[0].faces / 5;
  CHECK(horbelt_claims(result)[6].verdict == ClaimVerdict::fails);
}
