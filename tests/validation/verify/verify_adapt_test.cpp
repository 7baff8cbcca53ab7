// The job `adapt` with devices of our own making.
#include "validation/verify/verify_adapt.h"

#include <functional>

#include <doctest/doctest.h>

#include "core/procedural/swirl.h"
#include "raster/cpu_renderer.h"

using namespace etalon;
using namespace etalon::validation;

namespace {

/// The exact renderer with a defect in a drawing or in the map that stays.
class Tampered : public Renderer {
 public:
  std::function<void(std::vector<Image>&)> drawing;
  std::function<void(Image&)> kept;
  [[nodiscard]] std::string name() const override { return "tampered"; }
  [[nodiscard]] RasterState supported_state(const RasterState& wanted) const override { return wanted; }
  [[nodiscard]] bool supports(const TargetSpec&) const override { return true; }
  [[nodiscard]] std::vector<Image> render(const DrawList& list, const Frame& frame) override {
    std::vector<Image> images = exact_.render(list, frame);
    if (drawing) drawing(images);
    return images;
  }
  [[nodiscard]] std::unique_ptr<ResidentMap> make_map(Image map, const MapState& state) override {
    if (kept) kept(map);
    return exact_.make_map(std::move(map), state);
  }

 private:
  raster::CpuRenderer exact_;
};

VerifyModel swirl_model(bool has_uv = true) {
  VerifyModel model;
  model.name = "swirl";
  model.mesh = procedural::make_swirl({.faces = 128, .texture_size = 32}).mesh;
  model.mesh.has_uv = has_uv;
  model.materials = {{}};
  return model;
}

AdaptCases cases_with(Renderer* device, const VerifyModel& model = swirl_model()) {
  raster::CpuRenderer exact;
  VerifyOptions options;
  options.adapt_size = 64;
  options.adapt_faces = 60;
  return adapt_cases(model, exact, {device, contract_model(), device == nullptr ? "no library" : ""}, options, {});
}

}  // namespace

TEST_CASE("verify adapt: a device that keeps the contract agrees in every texel of every pass, down and up") {
  Tampered device;
  const AdaptCases made = cases_with(&device);
  REQUIRE(made.cases.size() == 2);
  CHECK(made.skipped.empty());
  for (const CaseResult& item : made.cases) {
    CHECK(item.skipped.empty());
    CHECK(item.tally.texels > 1000);
    CHECK(item.tally.texels == item.covered);
    CHECK(item.tally.identical == item.tally.texels);
    CHECK(item.view == "128 to 59 faces and back");
    REQUIRE(item.targets.size() == 2);  // the map at the coarsest level, and back
    CHECK(item.targets[0].difference->identical);
    CHECK(item.targets[0].cpu_sha256 != item.targets[1].cpu_sha256);
    CHECK(item.worst.empty());
    CHECK(!item.class_picture.empty());
  }
}

TEST_CASE("verify adapt: one wrong texel of one pass is found, and shown") {
  Tampered device;
  int drawings = 0;
  device.drawing = [&](std::vector<Image>& images) {
    if (++drawings != 3) return;
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x) {
        if (*images[1].channels<std::uint32_t>(x, y) == kNoTriangle) continue;
        images[0].channels<float>(x, y)[0] += 0.125f;
        return;
      }
  };
  const AdaptCases made = cases_with(&device);
  REQUIRE(made.cases.size() == 2);
  // Found once in the pass it was made in; the passes after it start from it on both sides. The map that stays has not got it.
  CHECK(made.cases[0].tally.unexplained >= 1);
  REQUIRE(!made.cases[0].worst.empty());
  CHECK(made.cases[0].worst[0].texel_class == "unexplained");
  CHECK(made.cases[1].tally.unexplained == 0);
}

TEST_CASE("verify adapt: a map that stays and does not hold what was drawn is a defect") {
  Tampered device;
  device.kept = [](Image& map) { map.channels<float>(0, 0)[1] = 7; };
  const AdaptCases made = cases_with(&device);
  REQUIRE(made.cases.size() == 2);
  CHECK(made.cases[0].tally.unexplained >= 1);
  CHECK(made.cases[0].diagnosis.find("map that stays") != std::string::npos);
}

TEST_CASE("verify adapt: without a device the maps are drawn and nothing is claimed; without coordinates it is skipped") {
  const AdaptCases alone = cases_with(nullptr);
  REQUIRE(alone.cases.size() == 2);
  CHECK(alone.cases[0].covered > 1000);
  CHECK(alone.cases[0].tally.texels == 0);
  CHECK(!alone.cases[0].targets[0].difference);
  const AdaptCases none = cases_with(nullptr, swirl_model(false));
  CHECK(none.cases.empty());
  CHECK(none.skipped == kNoTextureCoordinates);
}
