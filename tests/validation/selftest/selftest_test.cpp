// The self-test passes here, and fails where one texel is wrong.
#include <doctest/doctest.h>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "raster/cpu_renderer.h"
#include "validation/selftest/judged_scenes.h"
#include "validation/selftest/selftest.h"

using namespace etalon;
using namespace etalon::validation;

namespace {

// The renderer, but for one bit in the last texel of the first target, where `is_hit` says so.
class Defective final : public Renderer {
 public:
  using Hit = bool (*)(const Frame&);
  explicit Defective(Hit is_hit) : is_hit_(is_hit) {}
  std::string name() const override { return "defective"; }
  RasterState supported_state(const RasterState& wanted) const override { return wanted; }
  bool supports(const TargetSpec&) const override { return true; }
  std::vector<Image> render(const DrawList& list, const Frame& frame) override {
    std::vector<Image> images = exact_.render(list, frame);
    if (is_hit_(frame)) images.front().bytes().back() ^= std::byte{1};
    return images;
  }

 private:
  raster::CpuRenderer exact_;
  Hit is_hit_;
};

SelftestOptions small_options() {
  SelftestOptions options;
  options.small = true;
  options.levels = {raster::available_simd_levels().back()};
  options.threads = {2};
  return options;
}

SelftestResult with_defect(Defective::Hit is_hit) {
  SelftestOptions options = small_options();
  options.make_renderer = [&](raster::Evaluation) { return std::make_unique<Defective>(is_hit); };
  return run_selftest(options);
}

}  // namespace

TEST_CASE("the self-test passes, and leaves level and threads as they were") {
  set_thread_count(3);
  const raster::SimdLevel before = raster::simd_level();
  SelftestOptions options;
  options.small = true;
  options.threads = {2, 1};
  std::size_t hashes = 0, judged = 0;
  options.hash_done = [&](const HashRun& run) { hashes += run.difference.empty() ? 1 : 0; };
  options.judge_done = [&](const JudgeRun& run) { judged += run.mismatches == 0 ? 1 : 0; };
  const SelftestResult result = run_selftest(options);
  CHECK(thread_count() == 3);
  CHECK(raster::simd_level() == before);
  set_thread_count(0);
  CHECK(result.passed());
  CHECK(result.threads >= 1);
  const std::size_t levels = raster::available_simd_levels().size();
  CHECK(result.hashes.size() == levels + 1);  // the best level with each thread count
  CHECK(result.judged.size() == levels + 1);  // and the scalar evaluation
  CHECK(hashes == result.hashes.size());
  CHECK(judged == result.judged.size());
  for (const HashRun& run : result.hashes) CHECK(run.sha256 == golden_scene_hashes().all);
  for (const JudgeRun& run : result.judged) CHECK((run.texels > 10'000 && run.values > run.texels));
}

TEST_CASE("one wrong bit in one scene: the hash differs, and the texel is named") {
  // Of the fixed scenes only `sizes` has such a frame, and the judge's are smaller.
  const SelftestResult result = with_defect([](const Frame& frame) { return frame.width == 257; });
  CHECK_FALSE(result.passed());
  for (const HashRun& run : result.hashes) {
    CHECK(run.sha256 != golden_scene_hashes().all);
    CHECK(run.difference.rfind("family sizes, 257x3, colour: texel (256, 2), color rgba unorm8: expected ", 0) == 0);
  }
  for (const JudgeRun& run : result.judged) CHECK(run.mismatches == 0);
}

TEST_CASE("one wrong bit in what only the judge sees") {
  // The fixed scenes have no frame of this height.
  const SelftestResult result = with_defect([](const Frame& frame) { return frame.height == 40; });
  CHECK_FALSE(result.passed());
  for (const HashRun& run : result.hashes) CHECK(run.difference.empty());
  for (const JudgeRun& run : result.judged) {
    CHECK(run.mismatches > 0);
    CHECK(run.first_mismatch.find("judged ") == 0);
    CHECK(run.first_mismatch.find(", 39), ") != std::string::npos);
  }
}

TEST_CASE("equal images compare equal, value by value") {
  raster::CpuRenderer renderer;
  const FixedScene scene = judged_scene(7);
  const std::vector<Image> images = renderer.render(scene.list, scene.frame);
  const Comparison same = compare(scene, images, images);
  CHECK(same.mismatches == 0);
  CHECK(same.values == same.texels * scene.frame.targets.size());
  CHECK(same.first_mismatch.empty());
}

TEST_CASE("a level that is not there is refused") {
  SelftestOptions options = small_options();
  options.levels = {raster::available_simd_levels().back() == raster::SimdLevel::neon ? raster::SimdLevel::avx2 : raster::SimdLevel::neon};
  CHECK_THROWS_AS((void)run_selftest(options), InputError);
}
