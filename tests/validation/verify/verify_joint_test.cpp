// The job `joint` with devices of our own making.
#include "validation/verify/verify_joint.h"

#include <algorithm>
#include <functional>

#include <doctest/doctest.h>

#include "core/base/parallel.h"
#include "raster/cpu_renderer.h"
#include "tests/validation/verify/tampered_renderer.h"

using namespace etalon;
using namespace etalon::validation;
using Tampered = test::TamperedRenderer;

namespace {

VerifyOptions options_of(int side) {
  VerifyOptions options;
  options.jobs = {"joint"};
  options.width = options.height = side;
  return options;
}

JobResult job_with(Renderer* device, int side = 96, const std::vector<VerifyModel>& models = {}) {
  raster::CpuRenderer exact;
  return run_verify(models, exact, {device, llvmpipe_model(), device == nullptr ? "no library" : ""}, options_of(side)).jobs.at(0);
}

bool is_lookup(const CaseResult& item) { return item.sampling.find("texture") != std::string::npos; }

}  // namespace

TEST_CASE("verify joint: a device that keeps the contract agrees in every byte, of coordinates and of lookups") {
  Tampered device;
  const JobResult job = job_with(&device);
  CHECK(job.skipped.empty());
  REQUIRE(job.cases.size() == 6);
  for (const CaseResult& item : job.cases) {
    CHECK(item.tally.identical == item.tally.texels);
    CHECK(item.covered > 1000);
    CHECK(!item.class_picture.empty());
  }
  // The smallest pair, one in the middle, and the largest.
  CHECK(job.cases[0].name() == "terrain, overview, mesh 0");
  CHECK(job.cases[1].name() == "terrain, overview, mesh 0, texture 0");
  CHECK(job.cases[5].name() == "terrain, overview, mesh 7, texture 5");
  CHECK(job.cases[4].triangles > 5 * job.cases[0].triangles);
  CHECK(job.cases[1].targets[0].cpu_sha256 != job.cases[5].targets[0].cpu_sha256);
}

TEST_CASE("verify joint: a device whose vertices, coordinates or lookups are off fails the check though its bounds are lent") {
  const auto unexplained = [](const std::function<void(DrawList&)>& tamper, bool of_lookups) {
    Tampered device(tamper);
    std::uint64_t least = ~std::uint64_t{0};
    for (const CaseResult& item : job_with(&device).cases)
      if (is_lookup(item) == of_lookups) least = std::min(least, item.tally.unexplained);
    return least;
  };
  const auto moved = [](DrawList& list) {
    for (RasterVertex& vertex : list.vertices) vertex.y += 128;  // half a texel
  };
  const auto shifted = [](DrawList& list) {
    for (RasterVertex& vertex : list.vertices) vertex.uv.x += 0.5f / 128;  // half a texel of the texture
  };
  const auto nearest = [](DrawList& list) {
    for (Draw& draw : list.draws) draw.sampler.filter = Filter::nearest;
  };
  CHECK(unexplained(moved, false) > 100);
  CHECK(unexplained(shifted, false) > 1000);
  CHECK(unexplained(nearest, true) > 1000);
}

TEST_CASE("verify joint: the same scenes for any models and threads, and without a device") {
  const JobResult alone = job_with(nullptr);
  REQUIRE(alone.cases.size() == 6);
  CHECK(alone.cases[0].tally.texels == 0);
  set_thread_count(3);
  const JobResult beside = job_with(nullptr, 96, std::vector<VerifyModel>(2));
  set_thread_count(0);
  REQUIRE(beside.cases.size() == 6);
  for (std::size_t n = 0; n < 6; ++n) CHECK(alone.cases[n].targets[0].cpu_sha256 == beside.cases[n].targets[0].cpu_sha256);
  CHECK(job_with(nullptr, 1024).cases[3].width == 512);
}
