// Each usual mistake planted into a drawing by the exact renderer: named first, with nearly all of the unexplained texels. Needs no OpenGL.
#include "validation/mistakes.h"

#include <doctest/doctest.h>

#include "raster/cpu_renderer.h"
#include "tests/validation/scenes.h"
#include "validation/diagnosis.h"
#include "validation/texel_lookup.h"

namespace etalon::validation {
namespace {

using test::at;

constexpr int kSize = 96;

// Two images, one through the other in depth, one in perspective: no texel is right by chance.
DrawList scene() {
  DrawList list =
      test::quad(kSize, kSize, {-0.37f, -0.21f}, {1.63f, 1.58f}, test::busy_texture(64, 64), {Filter::nearest, Wrap::repeat, Wrap::repeat});
  list.images.push_back(test::busy_texture(48, 80));
  const Vec2f uv[] = {{0.03f, 0.07f}, {0.91f, 0.13f}, {0.44f, 0.95f}};
  const double place[][2] = {{9.25, 11.5}, {87.75, 20.25}, {40.5, 90.125}};
  const float depth[] = {0.25f, 0.75f, 0.5f};  // partly before the square, partly behind it
  for (std::uint32_t k = 0; k < 3; ++k)
    list.vertices.push_back(at(place[k][0], place[k][1], uv[k], {0, 0, 0, 1}, depth[k], 1 + 0.75f * static_cast<float>(k)));
  list.triangles.push_back({6, 7, 8});
  list.draws.push_back({.first_triangle = 2,
                        .triangle_count = 1,
                        .shading = Shading::texture,
                        .texture = 1,
                        .sampler = {Filter::nearest, Wrap::repeat, Wrap::repeat}});
  return list;
}

struct Case {
  DrawList list = scene();
  Frame frame = test::frame_of(kSize, kSize, {{TargetContent::color, kRgba8}});
  DeviceModel device = specified_model("device", 2, 12, "a test");
  raster::CpuRenderer cpu;

  std::vector<Hypothesis> named(const std::vector<Image>& candidate) {
    const std::vector<Image> golden = cpu.render(list, frame);
    const DiffResult diff = diff_images(list, frame, device, golden, candidate);
    CHECK(diff.counts[TexelClass::unexplained] > 100);
    return diagnose(list, frame, device, golden, candidate, diff);
  }
  void check_named(const std::string& name, const DrawList& wrong, const Frame& wrong_frame, double share = 0.98) {
    check_named(name, cpu.render(wrong, wrong_frame), share);
  }
  void check_named(const std::string& name, const std::vector<Image>& candidate, double share = 0.98) {
    CAPTURE(name);
    const std::vector<Hypothesis> hypotheses = named(candidate);
    REQUIRE_FALSE(hypotheses.empty());
    CHECK(hypotheses[0].name == name);
    CHECK(hypotheses[0].explained_share >= share);
  }
};

TEST_CASE("mistakes: each that is planted is named first") {
  Case c;
  for (const Mistake& mistake : usual_mistakes(c.list, c.frame, c.device)) {
    // What leaves these scenes as they are, or a few texels; half storage has no half target here; a last resort is the looser bound itself.
    const bool no_trace = mistake.touches_few || mistake.last_resort || mistake.name == "wrap repeat" || mistake.name == "filter nearest" ||
                          mistake.name.starts_with("half stored") || mistake.name.starts_with("positions on a grid") ||
                          mistake.name == "unorm stored toward zero" || mistake.name == "mip levels" ||
                          mistake.name.starts_with("colours stored");
    if (no_trace) continue;
    const SupposedDrawing drawing = mistake.alternatives.front()();
    std::vector<Image> candidate = c.cpu.render(drawing.list, drawing.frame);
    candidate.front() = read_as(candidate.front(), mistake.reading);
    c.check_named(mistake.name, candidate);
  }
}

TEST_CASE("mistakes: mip levels, of which any may show at a texel") {
  Case c;
  DrawList wrong = c.list;
  for (auto& image : wrong.images) {
    Image half(image->width() / 2, image->height() / 2, image->format());
    for (int y = 0; y < half.height(); ++y)
      for (int x = 0; x < half.width(); ++x)
        for (int k = 0; k < 4; ++k) {
          const auto texel = [&](int i, int j) { return int{image->channels<std::uint8_t>(2 * x + i, 2 * y + j)[k]}; };
          half.channels<std::uint8_t>(x, y)[k] = static_cast<std::uint8_t>((texel(0, 0) + texel(1, 0) + texel(0, 1) + texel(1, 1) + 2) / 4);
        }
    image = std::make_shared<const Image>(std::move(half));
  }
  c.check_named("mip levels", wrong, c.frame);
}

TEST_CASE("mistakes: colours stored by the sRGB curve") {
  Case c;
  Frame curved = c.frame;
  curved.targets[0].format.type = ChannelType::srgb8;
  Image candidate = c.cpu.render(c.list, curved).front();
  Image bytes(kSize, kSize, kRgba8);
  std::copy(candidate.bytes().begin(), candidate.bytes().end(), bytes.bytes().begin());
  c.check_named("colours stored by the sRGB curve", {bytes});
}

TEST_CASE("mistakes: coordinates of 8 bits are a last resort, not asked where a mistake explains nearly all") {
  Case c;
  for (Draw& draw : c.list.draws) draw.sampler.filter = Filter::linear;
  c.frame.targets[0].format = kRgba32f;
  DrawList wrong = c.list;
  // Every coordinate off by 1/300 texel: beyond 2^-12, within 2^-8.
  for (RasterVertex& v : wrong.vertices) v.uv += Vec2f(1.0f / 300 / 64, 1.0f / 300 / 64);
  c.check_named("texture coordinates, or weights of the filter, of 8 bits", wrong, c.frame);
  for (RasterVertex& v : wrong.vertices) v.uv.y = 1 - v.uv.y;
  for (RasterVertex& v : c.list.vertices) v.uv += Vec2f(1.0f / 300 / 64, 1.0f / 300 / 64);
  for (const Hypothesis& h : c.named(c.cpu.render(wrong, c.frame))) CHECK(h.name.find(" bits") == std::string::npos);
}

TEST_CASE("mistakes: a supposition beyond the contract's ranges is passed over") {
  Case c;
  c.frame.guard = 0;  // geometry that is shifted leaves the frame
  DrawList wrong = c.list;
  for (Draw& draw : wrong.draws) draw.sampler.filter = Filter::linear;
  c.check_named("filter linear", wrong, c.frame);
}

TEST_CASE("reading a picture upside down, or with red and blue exchanged, twice gives it back") {
  const Image image = *test::busy_texture(5, 3);
  for (const CandidateReading reading : {CandidateReading::upside_down, CandidateReading::red_blue_exchanged}) {
    const Image other = read_as(image, reading);
    CHECK(other.sha256() != image.sha256());
    CHECK(read_as(other, reading).sha256() == image.sha256());
  }
  CHECK(read_as(image, CandidateReading::plain).sha256() == image.sha256());
  CHECK(*read_as(image, CandidateReading::upside_down).channels<std::uint8_t>(1, 0) == *image.channels<std::uint8_t>(1, 2));
  CHECK(read_as(image, CandidateReading::red_blue_exchanged).channels<std::uint8_t>(1, 0)[0] == image.channels<std::uint8_t>(1, 0)[2]);
}

}  // namespace
}  // namespace etalon::validation
