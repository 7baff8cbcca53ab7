// The job `bake` with devices of our own making.
#include "validation/verify/verify_bake.h"

#include <functional>
#include <limits>

#include <doctest/doctest.h>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/procedural/swirl.h"
#include "raster/cpu_renderer.h"
#include "tests/validation/verify/tampered_renderer.h"

using namespace etalon;
using namespace etalon::validation;
using Tampered = test::TamperedRenderer;

namespace {

constexpr int kSide = 96;

VerifyModel swirl_model(int faces = 512) {
  procedural::Model source = procedural::make_swirl({.faces = faces, .texture_size = 64});
  VerifyModel model;
  model.name = "swirl";
  model.mesh = std::move(source.mesh);
  model.materials.resize(1);
  model.materials[0].texture = std::make_shared<const Image>(std::move(source.texture));
  return model;
}

/// Red along x, green along y.
VerifyModel colored_model() {
  VerifyModel model = swirl_model();
  model.materials = {{}};
  model.mesh.has_uv = false;
  const BoundingBox box = bounding_box(model.mesh);
  for (const Vec3f& p : model.mesh.positions)
    model.mesh.colors.push_back({(p.x - box.lo.x) / (box.hi.x - box.lo.x), (p.y - box.lo.y) / (box.hi.y - box.lo.y), 0.5f, 1});
  return model;
}

VerifyOptions options_of(std::size_t faces, int size) {
  VerifyOptions options;
  options.jobs = {"bake"};
  options.width = options.height = kSide;
  options.bake_faces = faces;
  options.bake_size = size;
  return options;
}

JobResult job_with(Renderer* device, const std::vector<VerifyModel>& models, const VerifyOptions& options = options_of(0, 256)) {
  raster::CpuRenderer exact;
  return run_verify(models, exact, {device, llvmpipe_model(), device == nullptr ? "no library" : ""}, options).jobs.at(0);
}

}  // namespace

TEST_CASE("verify bake: a device that keeps the contract agrees in every byte, of colours and of a texture at the vertices") {
  Tampered device;
  const JobResult job = job_with(&device, {colored_model(), swirl_model()});
  CHECK(job.skipped.empty());
  REQUIRE(job.cases.size() == 4);
  for (const CaseResult& item : job.cases) {
    CHECK(item.job == "bake");
    CHECK(item.tally.texels == kSide * kSide);
    CHECK(item.tally.identical == item.tally.texels);
    CHECK(item.triangles <= 51);  // a tenth
    CHECK(item.triangles > 40);
    CHECK(item.sampling.find(" of 512 faces") != std::string::npos);
    CHECK(item.covered > 100);
    REQUIRE(item.targets.size() == 3);
    CHECK(item.targets[0].difference->identical);
    CHECK(!item.class_picture.empty());
  }
  CHECK(job.cases[0].name() == "swirl, 0/24, " + job.cases[0].sampling);
  CHECK(job.cases[0].description.find("vertex colours") != std::string::npos);
  CHECK(job.cases[2].description.find("texture at its vertices") != std::string::npos);
  CHECK(job.cases[0].targets[0].cpu_sha256 != job.cases[1].targets[0].cpu_sha256);
  CHECK(job.cases[0].targets[0].cpu_sha256 != job.cases[2].targets[0].cpu_sha256);
}

TEST_CASE("verify bake: a device that looks up half a texel off, or filters, fails the check though its bounds are lent") {
  Tampered shifted([](DrawList& list) {
    for (RasterVertex& vertex : list.vertices) vertex.uv.x += 0.5f / 256;
  });
  Tampered filtering([](DrawList& list) {
    for (Draw& draw : list.draws) draw.sampler.filter = Filter::linear;
  });
  for (Tampered* device : {&shifted, &filtering}) {
    const JobResult job = job_with(device, {colored_model()});
    REQUIRE(job.cases.size() == 2);
    for (const CaseResult& item : job.cases) {
      CHECK(item.tally.unexplained > 100);
      CHECK(!item.diagnosis.empty());
      CHECK(!item.worst.empty());
      CHECK(item.worst.front().texel_class == "unexplained");
    }
  }
}

TEST_CASE("verify bake: the scene on the other half-square of a pair is found too") {
  // One face shows its neighbour's texels: what a wrong place in the map looks like.
  Tampered device([](DrawList& list) {
    for (int c = 0; c < 3; ++c) list.vertices[list.triangles[0][c]].uv = list.vertices[list.triangles[7][c]].uv;
  });
  const JobResult job = job_with(&device, {colored_model()});
  std::uint64_t unexplained = 0;
  for (const CaseResult& item : job.cases) unexplained += item.tally.unexplained;
  CHECK(unexplained > 0);
}

TEST_CASE("verify bake: the number of faces and the map's side can be asked for; without a device nothing is claimed") {
  const JobResult job = job_with(nullptr, {colored_model()}, options_of(100, 128));
  REQUIRE(job.cases.size() == 2);
  CHECK(job.cases[0].triangles <= 100);
  CHECK(job.cases[0].triangles > 90);
  CHECK(job.cases[0].description.find("128 × 128") != std::string::npos);
  CHECK(job.cases[0].tally.texels == 0);
  CHECK(!job.cases[0].targets[0].difference);
  CHECK(!job.cases[0].targets[0].cpu_picture.empty());
}

TEST_CASE("verify bake: progress is told, and 300 faces are the most that are left of a large model") {
  int heard = 0;
  VerifyOptions options = options_of(0, 256);
  options.on_progress = [&](const std::string& label, int done, int total) {
    CHECK(label == "bake: swirl");
    CHECK(done <= total);
    ++heard;
  };
  const JobResult job = job_with(nullptr, {swirl_model(7688)}, options);
  CHECK(heard > 0);
  REQUIRE(job.cases.size() == 2);
  CHECK(job.cases[0].triangles <= 300);
  CHECK(job.cases[0].triangles > 280);
}

TEST_CASE("verify bake: the same bytes for any number of threads") {
  std::vector<std::string> hashes;
  for (const int threads : {1, 7}) {
    set_thread_count(threads);
    const JobResult job = job_with(nullptr, {swirl_model()});
    REQUIRE(job.cases.size() == 2);
    for (const CaseResult& item : job.cases) hashes.push_back(item.targets[0].cpu_sha256);
  }
  set_thread_count(0);
  for (std::size_t n = 0; n < 2; ++n) CHECK(hashes[n] == hashes[n + 2]);
}

TEST_CASE("verify bake: skipped with a hint where there are no colours, and with the reason where baking is refused") {
  VerifyModel bare = swirl_model();
  bare.mesh.has_uv = false;  // the texture is left, and nothing says where
  CHECK(job_with(nullptr, {bare}).skipped == kNoColors);
  VerifyModel untextured = swirl_model();
  untextured.materials = {{}};
  CHECK(job_with(nullptr, {untextured}).skipped == kNoColors);
  // Beside a model that has colours the job is done for that one.
  const JobResult both = job_with(nullptr, {bare, colored_model()});
  CHECK(both.skipped.empty());
  CHECK(both.cases.size() == 2);

  const JobResult crowded = job_with(nullptr, {colored_model()}, options_of(512, 16));
  CHECK(crowded.cases.empty());
  CHECK(crowded.skipped.find("smallest") != std::string::npos);
  VerifyModel broken = colored_model();
  broken.mesh.colors[3].y = std::numeric_limits<float>::quiet_NaN();
  CHECK(job_with(nullptr, {broken}).skipped.find("expected a finite colour") != std::string::npos);
}

TEST_CASE("verify bake: a scene that the device cannot draw is skipped, and said so") {
  Tampered device([](DrawList&) { throw UnavailableError("no memory"); });
  const JobResult job = job_with(&device, {colored_model()});
  REQUIRE(job.cases.size() == 2);
  for (const CaseResult& item : job.cases) {
    CHECK(item.skipped == "no memory");
    CHECK(item.width == kSide);
    CHECK(item.tally.texels == 0);
  }
}
