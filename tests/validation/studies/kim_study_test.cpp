#include "validation/studies/kim_study.h"

#include <doctest/doctest.h>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/procedural/duck.h"
#include "core/procedural/knot.h"
#include "raster/cpu_renderer.h"
#include "validation/report/study_page.h"
#include "validation/studies/kim_report.h"

using namespace etalon;
using namespace etalon::validation;

namespace {

KimSubject knot_subject() {
  KimSubject subject;
  subject.name = "knot";
  subject.mesh = procedural::make_knot({.rings = 60, .around = 12});
  subject.inputs = {{.name = "knot", .sha256 = std::string(64, '1'), .path = "", .role = "model", .attribution = ""}};
  return subject;
}

KimStudyOptions small() {
  KimStudyOptions options;
  options.picture_px = 64;
  options.views_px = 32;
  options.view_count = 2;
  options.metro_samples = 3'000;
  options.sweep_samples = 2'000;
  options.time_repeats = 1;
  return options;
}

}  // namespace

TEST_CASE("simplification stops by faces; the study by vertices, exactly, closed or open") {
  const Mesh closed = procedural::make_knot({.rings = 60, .around = 12}),
             open = procedural::make_duck(procedural::duck_of_faces(3'000, true));
  for (const auto metric : {simplify::MetricName::qem, simplify::MetricName::kim}) {
    simplify::SimplifyOptions options;
    options.metric = metric;
    options.target_faces = faces_for_vertices(closed, options, 100);
    CHECK(options.target_faces == 1440 - 2 * 620);  // 720 vertices, two faces a collapse
    CHECK(simplify::simplify_mesh(closed, options).mesh.vertex_count() == 100);
    options.target_faces = faces_for_vertices(open, options, 170);
    CHECK(simplify::simplify_mesh(open, options).mesh.vertex_count() == 170);
  }
  CHECK(faces_for_vertices(closed, {}, 720) == 1440);
  CHECK(faces_for_vertices(closed, {}, 9999) == 1440);
}

TEST_CASE("a whole study of a small model: every method, every unit, the same bytes for any thread count") {
  raster::CpuRenderer exact;
  KimStudyOptions options = small();
  int last = -1, calls = 0, total = 0;
  options.progress = [&](const std::string& label, int done, int all) {
    CHECK(!label.empty());
    CHECK(done == last + 1);
    last = done;
    total = all;
    ++calls;
  };
  const KimStudyResult one = run_kim_study({knot_subject()}, exact, options);
  CHECK(calls == total);
  REQUIRE(one.subjects.size() == 1);
  const KimSubjectResult& knot = one.subjects.front();
  CHECK(knot.target_vertices == 72);
  REQUIRE(knot.outcomes.size() == 4);
  for (const KimOutcome& o : knot.outcomes) {
    CAPTURE(to_string(o.method));
    CHECK(o.vertices == 72);
    CHECK(o.reached);
    CHECK(o.mean > 0);
    CHECK(o.rms >= o.mean);
    CHECK(o.max >= o.rms);
    CHECK(o.image_rms > 0);
    CHECK(o.image_rms_views > 0);
    CHECK(o.picture.width() == knot.picture.width());
    CHECK(o.inside_rms > 0);
    CHECK(o.outline_share > 0);
    CHECK(o.outline_share < 1);
    CHECK(!o.device_image_rms);
  }
  CHECK(knot.of(KimMethod::kim).state_bytes_per_vertex == 48);
  CHECK(knot.of(KimMethod::qem6).state_bytes_per_vertex == 112);
  REQUIRE(knot.sweep.size() == 17);
  CHECK(knot.sweep[8].unit_of_diagonal == doctest::Approx(1.0 / 8000).epsilon(1e-12));
  CHECK(knot.sweep[16].unit_of_diagonal / knot.sweep[0].unit_of_diagonal == doctest::Approx(1e8).epsilon(1e-12));

  options.progress = {};
  set_thread_count(3);
  const KimStudyResult three = run_kim_study({knot_subject()}, exact, options);
  set_thread_count(0);
  // All but the times, which are in `run`.
  auto a = study_document(kim_report(one), {}), b = study_document(kim_report(three), {});
  a.erase("run");
  b.erase("run");
  CHECK(a == b);
}

TEST_CASE("a study can be stopped at any step, and leaves out what is too large to sweep") {
  raster::CpuRenderer exact;
  KimStudyOptions options = small();
  options.sweep_faces = 100;
  options.progress = [](const std::string&, int done, int) {
    if (done == 3) throw InputError("stopped");
  };
  CHECK_THROWS_WITH_AS((void)run_kim_study({knot_subject()}, exact, options), "stopped", InputError);
  options.progress = {};
  CHECK(run_kim_study({knot_subject()}, exact, options).subjects.front().sweep.empty());
}

TEST_CASE("a study refuses what it cannot study") {
  raster::CpuRenderer exact;
  KimSubject plain = knot_subject();
  plain.mesh.colors.clear();
  CHECK_THROWS_WITH_AS((void)run_kim_study({plain}, exact, small()), "knot: expected vertex colours, got none", InputError);
  for (const double reduction : {0.0, 1.0, -1.0}) {
    KimSubject subject = knot_subject();
    subject.reduction = reduction;
    CHECK_THROWS_AS((void)run_kim_study({subject}, exact, small()), InputError);
  }
  CHECK_THROWS_AS((void)KimSubjectResult{}.of(KimMethod::kim), InputError);
}

TEST_CASE("the paper's rows are the figures of its tables") {
  const auto& rows = kim_paper_rows();
  // Ratios kim/qem6, as the text of section 5 has them: mean below 1, image error above, time about 1.7.
  for (const KimPaperRow& row : rows) {
    CHECK(row.kim_mean < row.qem6_mean);
    CHECK(row.kim_rms < row.qem6_rms);
    CHECK(row.kim_image > row.qem6_image);
    CHECK(row.kim_seconds / row.qem6_seconds == doctest::Approx(1.72).epsilon(0.02));
  }
  // Closed surfaces of genus 0 have 2V − 4 faces; the duck is open.
  CHECK(rows[0].faces == 2 * rows[0].vertices - 4);
  CHECK(rows[2].faces == 2 * rows[2].vertices - 4);
}
