// The suites at their quick length, or at full length with ETALON_FULL=1, and proof that each of them can fail.

#include <doctest/doctest.h>

#include <cstdlib>
#include <cstring>
#include <iostream>
#include <set>
#include <sstream>

#include "core/base/parallel.h"
#include "raster/cpu_renderer.h"
#include "tests/validation/reference/defects.h"
#include "tests/validation/reference/frame_suite.h"
#include "tests/validation/reference/judge_renderer.h"
#include "tests/validation/reference/lattice_suite.h"
#include "tests/validation/reference/mass_suite.h"
#include "tests/validation/reference/suite_plan.h"
#include "tests/validation/reference/tiling.h"
#include "tests/validation/reference/tiling_suite.h"

namespace etalon::validation::reference {

namespace {

Length asked_length() {
  const char* full = std::getenv("ETALON_FULL");
  return full != nullptr && std::strcmp(full, "1") == 0 ? Length::full : Length::quick;
}

Tally run_suite(Suite suite) {
  Tally sum;
  for (const Block& block : blocks_of(suite, asked_length())) sum += block.run();
  std::cout << "[etalon] judge, " << to_string(suite) << ": " << to_string(sum) << std::endl;
  CHECK_MESSAGE(sum.mismatches == 0, sum.first_mismatch);
  return sum;
}

// A renderer that draws something other than it is asked.
class ChangedRenderer final : public Renderer {
 public:
  explicit ChangedRenderer(std::function<void(DrawList&, Frame&)> change) : change_(std::move(change)) {}
  std::string name() const override { return "changed"; }
  RasterState supported_state(const RasterState& wanted) const override { return wanted; }
  bool supports(const TargetSpec&) const override { return true; }
  std::vector<Image> render(const DrawList& list, const Frame& frame) override {
    DrawList changed_list = list;
    Frame changed_frame = frame;
    change_(changed_list, changed_frame);
    return inner_.render(changed_list, changed_frame);
  }

 private:
  std::function<void(DrawList&, Frame&)> change_;
  raster::CpuRenderer inner_;
};

FillRule other(FillRule rule) { return static_cast<FillRule>((static_cast<int>(rule) + 1) % 4); }

}  // namespace

TEST_CASE("mass: random triangles, the renderer's samples are the judge's") {
  const Tally tally = run_suite(Suite::mass);
  CHECK(tally.triangles >= 40'000);
  CHECK(tally.covered > 400'000);
  CHECK(tally.edge_ties > 10'000);
  CHECK(tally.texel_ties > 1'000);
}

TEST_CASE("mass_exact: the renderer's wide integers are the judge's") { CHECK(run_suite(Suite::mass_exact).covered > 40'000); }

TEST_CASE("judge: rationals and integers agree") {
  const Tally tally = run_suite(Suite::judge);
  CHECK(tally.triangles >= 500);
  CHECK(tally.values > 5'000);
}

TEST_CASE("lattice: every triangle of a small lattice") {
  const Tally tally = run_suite(Suite::lattice);
  CHECK(tally.triangles > 200'000);
  CHECK(tally.edge_ties > 50'000);
}

TEST_CASE("tilings: a shared edge is covered exactly once under every fill rule") {
  const Tally tally = run_suite(Suite::tilings);
  CHECK(tally.covered == tally.samples);
  CHECK(tally.samples >= 4 * 1'000'000);
}

TEST_CASE("frames: every target after visibility") { CHECK(run_suite(Suite::frames).covered > 50'000); }

TEST_CASE("threads: the same bytes with 1, 2 and 7 threads") {
  CHECK(run_suite(Suite::threads).values > 1'000'000);
  CHECK(thread_count() >= 1);
}

TEST_CASE("the mass suite sees a wrong fill rule, half rounding, vertex, texel and bit") {
  const MassOptions some{.first_seed = 1, .blocks = 40};
  REQUIRE(run_mass(some, raster_subject()).mismatches == 0);
  const auto mismatches = [&](std::function<void(DrawList&, Frame&)> change) {
    return run_mass(some, changed_subject(raster_subject(), std::move(change))).mismatches;
  };
  CHECK(mismatches([](DrawList&, Frame& frame) { frame.state.fill_rule = other(frame.state.fill_rule); }) > 0);
  CHECK(mismatches([](DrawList&, Frame& frame) {
          const bool nearest = frame.state.half_rounding == HalfRounding::nearest_even;
          frame.state.half_rounding = nearest ? HalfRounding::toward_zero : HalfRounding::nearest_even;
        }) > 0);
  CHECK(mismatches([](DrawList& list, Frame&) {
          for (RasterVertex& v : list.vertices) v.w = std::max(0x1p-20f, std::nextafter(v.w, 0.0f));
        }) > 0);
  CHECK(mismatches([](DrawList& list, Frame&) {
          for (Draw& draw : list.draws) std::swap(draw.sampler.wrap_u, draw.sampler.wrap_v);
        }) > 0);
  const Tally flipped = run_mass(some, flipped_bit_subject(raster_subject(), 300));
  CHECK(flipped.mismatches > 0);
  CHECK(flipped.first_mismatch.find("target 0 color") != std::string::npos);
  CHECK(flipped.first_mismatch.find("expected") != std::string::npos);
}

TEST_CASE("the lattice suite sees a wrong fill rule") {
  const LatticeOptions some{.first_point = 84, .point_count = 2, .one_triangle_in = 20};
  const MakeSubject wrong =
      changed_subject(raster_subject(), [](DrawList&, Frame& frame) { frame.state.fill_rule = other(frame.state.fill_rule); });
  CHECK(run_lattice(some, wrong).mismatches > 0);
  CHECK(run_lattice(some, judge_subject(Arithmetic::rational)).mismatches == 0);
}

TEST_CASE("the tiling suite sees a hole, and a triangle drawn twice") {
  const TilingOptions some{.first_seed = 1, .seeds = 1, .size = 64};
  ChangedRenderer hole([](DrawList& list, Frame&) { list.triangles[list.triangles.size() / 2] = {0, 0, 0}; });
  CHECK(run_tilings(some, hole).mismatches > 0);
  // The last triangle covers the texels of a neighbour too: seen where the list is reversed.
  ChangedRenderer twice([](DrawList& list, Frame&) {
    for (auto& triangle : list.triangles) triangle = list.triangles.front();
  });
  CHECK(run_tilings(some, twice).mismatches > 0);
}

TEST_CASE("tilings cover each sample exactly once by the judge's own count") {
  for (const TilingKind kind : {TilingKind::fan, TilingKind::strip, TilingKind::grid, TilingKind::subdivision}) {
    CAPTURE(to_string(kind));
    const Scene scene = random_tiling(3, kind, 8);
    const Judge judge(scene.list, scene.frame);
    for (int j = 0; j < 8; ++j)
      for (int i = 0; i < 8; ++i) {
        int covered = 0;
        for (std::uint32_t t = 0; t < scene.list.triangles.size(); ++t) covered += judge.triangle(t).verdict(i, j).covered ? 1 : 0;
        CHECK(covered == 1);
      }
  }
}

TEST_CASE("the frame suite sees another depth order; the rational judge draws the same frames") {
  const FrameOptions some{.first_seed = 1, .frames = 6, .width = 12, .height = 12, .triangle_count = 12};
  ChangedRenderer other_order([](DrawList&, Frame& frame) { frame.state.depth_test = !frame.state.depth_test; });
  CHECK(run_frames(some, other_order).mismatches > 0);
  JudgeRenderer rational(Arithmetic::rational);
  const Tally tally = run_frames({.first_seed = 1, .frames = 2, .width = 6, .height = 6, .triangle_count = 8}, rational);
  CHECK_MESSAGE(tally.mismatches == 0, tally.first_mismatch);
}

TEST_CASE("the thread suite sees bytes that depend on the thread count") {
  ChangedRenderer dependent([](DrawList& list, Frame&) {
    if (thread_count() == 7) list.vertices[0].x = 0, list.vertices[1].x = 4, list.vertices[2].y = 99;
  });
  CHECK(run_threads({.first_seed = 3, .frames = 3, .width = 40, .height = 40, .triangle_count = 3}, dependent).mismatches > 0);
}

TEST_CASE("plans: every block has its own name, full holds the promised numbers, a log resumes what agreed") {
  for (const Length length : {Length::quick, Length::full}) {
    std::set<std::string> names;
    std::size_t count = 0;
    for (const Suite suite : all_suites())
      for (const Block& block : blocks_of(suite, length)) names.insert(block.name), ++count;
    CHECK(names.size() == count);
  }
  CHECK(blocks_of(Suite::mass, Length::full).size() == 50);  // of 1250 · 32 = 40,000 triangles
  const Block done{"mass seeds 1..2", nullptr}, failed{"mass seeds 3..4", nullptr};
  Tally good, bad;
  good.triangles = 64;
  bad.mismatch("x");
  std::stringstream log;
  log << log_line(done, good, 1.5) << '\n' << log_line(failed, bad, 2) << '\n' << "mass seeds 5..6 | 64 triangles: 0 mismatches | 0.";
  CHECK(agreed_blocks(log) == std::set<std::string>{"mass seeds 1..2"});
}

}  // namespace etalon::validation::reference
