// The main job with a device of our own making: one that keeps the contract, and ones with a defect planted.
#include "validation/verify/verify.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <limits>

#include <doctest/doctest.h>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/procedural/swirl.h"
#include "raster/cpu_renderer.h"
#include "validation/verify/verify_maps.h"

using namespace etalon;
using namespace etalon::validation;

namespace {

/// The exact renderer, whose images are then tampered with.
class Tampered : public Renderer {
 public:
  explicit Tampered(std::function<void(std::vector<Image>&)> tamper = {}) : tamper_(std::move(tamper)) {}
  [[nodiscard]] std::string name() const override { return "tampered"; }
  [[nodiscard]] RasterState supported_state(const RasterState& wanted) const override { return wanted; }
  [[nodiscard]] bool supports(const TargetSpec&) const override { return true; }
  [[nodiscard]] std::vector<Image> render(const DrawList& list, const Frame& frame) override {
    std::vector<Image> images = exact_.render(list, frame);
    if (tamper_) tamper_(images);
    return images;
  }

 private:
  raster::CpuRenderer exact_;
  std::function<void(std::vector<Image>&)> tamper_;
};

VerifyModel swirl_model() {
  procedural::Model source = procedural::make_swirl({.faces = 128, .texture_size = 32});
  VerifyModel model;
  model.name = "swirl";
  model.mesh = source.mesh;
  Material material;
  material.texture = std::make_shared<const Image>(source.texture);
  model.materials = {material};
  model.inputs = {{.name = "swirl", .sha256 = std::string(64, '0'), .path = "", .role = "model", .attribution = ""}};
  return model;
}

VerifyOptions small() {
  VerifyOptions options;
  options.jobs = {"render", "indexed"};
  options.width = 48;
  options.height = 40;
  options.picture_px = 48;
  return options;
}

VerifyResult verify_with(Renderer* device, const VerifyOptions& options = small()) {
  raster::CpuRenderer exact;
  return run_verify({swirl_model()}, exact, {device, contract_model(), device == nullptr ? "no library" : ""}, options);
}

}  // namespace

TEST_CASE("a device that keeps the contract agrees in every byte") {
  Tampered device;
  const VerifyResult result = verify_with(&device);
  CHECK(verdict(result) == Verdict::agreed);
  REQUIRE(result.jobs.size() == 2);
  CHECK(result.jobs[0].cases.size() == 4);
  CHECK(result.jobs[1].cases.size() == 2);
  const ClassTally total = result.total();
  CHECK(total.texels == 6 * 48 * 40);
  CHECK(total.identical == total.texels);
  for (const TargetResult& target : result.jobs[0].cases[0].targets) {
    CHECK(target.difference->identical);
    CHECK(target.gl_picture.empty());
    CHECK(target.cpu_sha256 == target.gl_sha256);
  }
}

TEST_CASE("one wrong byte fails the check and is shown") {
  Tampered device([](std::vector<Image>& images) { images[0].channels<std::uint8_t>(24, 20)[1] ^= 0x10; });
  VerifyOptions options = small();
  options.jobs = {"render"};
  const VerifyResult result = verify_with(&device, options);
  CHECK(verdict(result) == Verdict::failed);
  CHECK(result.total().unexplained == 4);
  const CaseResult& item = result.jobs[0].cases[0];
  CHECK(item.tally.unexplained == 1);
  CHECK(!item.diagnosis.empty());
  REQUIRE(item.worst.size() == 1);
  CHECK(item.worst[0].x == 24);
  CHECK(item.worst[0].y == 20);
  CHECK(item.worst[0].texel_class == "unexplained");
  CHECK(item.worst[0].cpu_value != item.worst[0].gl_value);
  CHECK(item.worst[0].cpu_crop != item.worst[0].gl_crop);
  CHECK(item.targets[0].difference->total.sse == 256);
  CHECK(!item.targets[0].gl_picture.empty());
}

TEST_CASE("a missing row of texels is a coverage defect") {
  Tampered device([](std::vector<Image>& images) {
    for (int x = 0; x < images[1].width(); ++x) *images[1].channels<std::uint32_t>(x, 20) = kNoTriangle;
  });
  VerifyOptions options = small();
  options.jobs = {"render"};
  options.views = {{"front", {}}};
  const VerifyResult result = verify_with(&device, options);
  CHECK(verdict(result) == Verdict::failed);
  CHECK(result.jobs[0].cases[0].diagnosis.find("coverage") != std::string::npos);
}

namespace {

/// A device with 8 sub-texel bits that truncates halves, and refuses linear filtering where told so.
class Limited : public Tampered {
 public:
  explicit Limited(bool refuses_linear) : refuses_linear_(refuses_linear) {}
  [[nodiscard]] RasterState supported_state(const RasterState& wanted) const override {
    RasterState state = wanted;
    state.subtexel_bits = 8;
    state.half_rounding = HalfRounding::toward_zero;
    return state;
  }
  [[nodiscard]] std::vector<Image> render(const DrawList& list, const Frame& frame) override {
    if (refuses_linear_ && list.draws.at(0).sampler.filter == Filter::linear) throw UnavailableError("texture too wide");
    return Tampered::render(list, frame);
  }

 private:
  bool refuses_linear_;
};

bool any_has(const std::vector<std::string>& lines, const std::string& part) {
  return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) { return line.find(part) != std::string::npos; });
}

}  // namespace

TEST_CASE("a state that the device does not have is told") {
  Limited device(false);
  VerifyOptions options = small();
  options.state.subtexel_bits = 16;
  const VerifyResult result = verify_with(&device, options);
  CHECK(result.state.subtexel_bits == 8);
  CHECK(any_has(result.caveats, "the device has 8 sub-texel bits, not 16: compared at 8"));
  CHECK(verify_with(&device).caveats.empty());
  CHECK(verify_with(nullptr, options).state.subtexel_bits == 16);
}

TEST_CASE("a scene that the device cannot draw is skipped, the others are compared, and that is a warning") {
  Limited device(true);
  const VerifyResult result = verify_with(&device);
  CHECK(verdict(result) == Verdict::not_compared);
  CHECK(result.skipped_cases() == 2);
  CHECK(result.jobs[0].cases[1].skipped == "texture too wide");
  CHECK(result.jobs[0].cases[1].targets.empty());
  CHECK(result.jobs[0].cases[0].skipped.empty());
  CHECK(result.total().identical == 4 * 48 * 40);
}

TEST_CASE("nothing drawn is no agreement") {
  Tampered device;
  CHECK(verify_with(&device).jobs[0].cases[0].covered > 100);
  VerifyOptions options = small();
  Camera away;
  away.eye = {0, 0, 4};
  away.target = {0, 0, 8};
  options.views = {{"away", away}};
  const VerifyResult result = verify_with(&device, options);
  CHECK(result.total().identical > 0);
  CHECK(result.covered() == 0);
  CHECK(verdict(result) == Verdict::not_compared);
  CHECK(any_has(result.caveats, "render, swirl, away, nearest: no triangle covers a texel"));
  options.views = {{"fit", {}}, {"away", away}};
  options.jobs = {"render"};
  CHECK(verdict(verify_with(&device, options)) == Verdict::agreed);
  CHECK(verify_with(&device, options).caveats.size() == 2);
}

TEST_CASE("a model that breaks the contract is named") {
  Tampered device;
  raster::CpuRenderer exact;
  VerifyModel model = swirl_model();
  model.mesh.positions[0].x = std::numeric_limits<float>::quiet_NaN();
  VerifyOptions options = small();
  options.views = {{"straight", Camera{}}};
  std::string message;
  try {
    (void)run_verify({model}, exact, {&device, contract_model(), ""}, options);
  } catch (const InputError& error) {
    message = error.what();
  }
  CHECK(message.rfind("swirl: ", 0) == 0);
}

TEST_CASE("without a device the exact pictures are there and nothing is claimed") {
  const VerifyResult result = verify_with(nullptr);
  CHECK(verdict(result) == Verdict::not_compared);
  CHECK(result.gl_unavailable == "no library");
  CHECK(result.total().texels == 0);
  const CaseResult& item = result.jobs[0].cases[0];
  CHECK(!item.targets[0].cpu_picture.empty());
  CHECK(!item.targets[0].difference.has_value());
}

TEST_CASE("what cannot be done is skipped or refused") {
  Tampered device;
  raster::CpuRenderer exact;
  VerifyModel model = swirl_model();
  model.mesh.has_uv = false;
  const VerifyResult result = run_verify({model}, exact, {&device, contract_model(), ""}, small());
  CHECK(result.jobs[1].skipped.rfind("no texture coordinates", 0) == 0);
  CHECK(result.jobs[1].cases.empty());
  // Beside a model that has coordinates the job is done for that one.
  CHECK(run_verify({model, swirl_model()}, exact, {&device, contract_model(), ""}, small()).jobs[1].skipped.empty());
  VerifyOptions wrong = small();
  wrong.jobs = {"paint"};
  CHECK_THROWS_AS((void)verify_with(&device, wrong), InputError);
  wrong = small();
  wrong.views = {{"sideways", {}}};
  CHECK_THROWS_AS((void)verify_with(&device, wrong), InputError);
}

TEST_CASE("progress and scenes are told in order; pictures do not depend on threads") {
  Tampered device([](std::vector<Image>& images) { images[0].channels<std::uint8_t>(3, 4)[0] ^= 1; });
  VerifyOptions options = small();
  int steps = 0;
  int scenes = 0;
  options.on_progress = [&](const std::string&, int done, int total) {
    CHECK(done == steps++);
    CHECK(total == 6);
  };
  options.on_case = [&](const CaseResult&) { ++scenes; };
  set_thread_count(1);
  const VerifyResult one = verify_with(&device, options);
  CHECK(steps == 6);
  CHECK(scenes == 6);
  set_thread_count(7);
  const VerifyResult seven = verify_with(&device, small());
  set_thread_count(0);
  for (std::size_t i = 0; i < one.jobs[0].cases.size(); ++i) {
    CHECK(one.jobs[0].cases[i].class_picture == seven.jobs[0].cases[i].class_picture);
    CHECK(one.jobs[0].cases[i].tally == seven.jobs[0].cases[i].tally);
    CHECK(one.jobs[0].cases[i].targets[0].error_picture == seven.jobs[0].cases[i].targets[0].error_picture);
  }
}

TEST_CASE("a device with another fill rule is caught, and the mistake is named") {
  class OtherRule : public Tampered {
   public:
    [[nodiscard]] std::vector<Image> render(const DrawList& list, const Frame& frame) override {
      Frame other = frame;
      other.state.fill_rule = FillRule::right_ymax;
      return Tampered::render(list, other);
    }
  } device;
  // Faces that share edges through sample centres: a grid of 8 x 8 cells over 48 x 48 texels, seen straight on.
  VerifyModel model = swirl_model();
  for (Vec3f& p : model.mesh.positions) p.z = 0;
  VerifyOptions options = small();
  options.width = options.height = 48;
  options.jobs = {"render"};
  Camera camera;
  camera.eye = {0, 0, 2};
  options.views = {{"straight", camera}};
  raster::CpuRenderer exact;
  const VerifyResult result = run_verify({model}, exact, {&device, llvmpipe_model(), ""}, options);
  REQUIRE(verdict(result) == Verdict::failed);
  CAPTURE(result.jobs[0].cases[0].diagnosis);
  CHECK(result.jobs[0].cases[0].diagnosis.find("fill rule right_ymax") != std::string::npos);
}
