#include "core/adapt/adapt_map.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/draw/scene.h"
#include "raster/cpu_renderer.h"
#include "tests/adapt/level_fixture.h"
#include "validation/metrics/image_difference.h"

using namespace etalon;
using namespace etalon::adapt;

namespace {

Image picture(const Mesh& mesh, const Material& material) {
  Frame frame{.width = 256, .height = 256, .guard = 0, .state = {}, .targets = {{}}};
  frame.state.depth_test = true;
  raster::CpuRenderer renderer;
  const Camera camera = named_view("front", bounding_box(test::swirl().model.mesh), 256, 256);
  return renderer.render(make_scene(mesh, {material}, camera, frame), frame).front();
}

double psnr_of(const Image& a, const Image& b) { return validation::measure_difference(a, b).psnr_db().value_or(1000); }

// Distances, in texels of the map, from where the map's texels point to where the cells' chain leads.
std::vector<double> errors_against_chain(const Image& map, std::size_t level) {
  const AdaptSequence& sequence = test::swirl().sequence;
  std::vector<double> errors;
  for (int y = 3; y < map.height(); y += 11)
    for (int x = 5; x < map.width(); x += 13) {
      const Vec2d truth = sequence.follow({(x + 0.5) / map.width(), (y + 0.5) / map.height()}, level, sequence.size());
      const auto* const at = map.channels<float>(x, y);
      errors.push_back(std::hypot((at[0] - truth.x) * map.width(), (at[1] - truth.y) * map.height()));
    }
  std::sort(errors.begin(), errors.end());
  return errors;
}

}  // namespace

TEST_CASE("adapt: the swirl at 399 faces keeps its picture, through an indexing map and as a texture") {
  test::ModelLevels& s = test::swirl();
  const auto texture = std::make_shared<const Image>(s.model.texture);
  const Sampler linear{Filter::linear, Wrap::clamp, Wrap::clamp};
  Image map = identity_map(512, 512), adapted = s.model.texture;
  raster::CpuRenderer renderer;
  const AdaptCounts counts = adapt_map(renderer, s.sequence, s.sequence.size(), 0, map);
  (void)adapt_map(renderer, s.sequence, s.sequence.size(), 0, adapted);
  s.mesh.go_to(0);
  const Mesh coarse = s.mesh.mesh();
  const Image full = picture(s.model.mesh, {.texture = texture, .sampler = linear});
  const double unadapted = psnr_of(full, picture(coarse, {.texture = texture, .sampler = linear}));
  const double by_map = psnr_of(
      full,
      picture(coarse, {.texture = texture, .sampler = linear, .indexing_map = std::make_shared<const Image>(map), .map_sampler = linear}));
  const double by_texture = psnr_of(full, picture(coarse, {.texture = std::make_shared<const Image>(adapted), .sampler = linear}));
  MESSAGE("PSNR against the full model: unadapted " << unadapted << " dB, through the map " << by_map << " dB, adapted texture "
                                                    << by_texture << " dB; " << counts.adaptations << " adaptations in " << counts.packs
                                                    << " packs, " << counts.texels << " texels");
  CHECK(by_map > unadapted + 3);
  CHECK(by_texture > unadapted + 1);
  CHECK(counts.adaptations > 3700);
  CHECK(counts.packs < counts.adaptations / 4);
}

TEST_CASE("adapt: the map follows the exact chain, and comes back") {
  test::ModelLevels& s = test::swirl();
  Image map = identity_map(512, 512);
  raster::CpuRenderer renderer;
  (void)adapt_map(renderer, s.sequence, s.sequence.size(), 0, map);
  const std::vector<double> down = errors_against_chain(map, 0);
  (void)adapt_map(renderer, s.sequence, 0, s.sequence.size(), map);
  const std::vector<double> back = errors_against_chain(map, s.sequence.size());
  MESSAGE("texels from the chain: down median " << down[down.size() / 2] << ", 99 % " << down[down.size() * 99 / 100] << ", most "
                                                << down.back() << "; back median " << back[back.size() / 2] << ", 99 % "
                                                << back[back.size() * 99 / 100] << ", most " << back.back());
  CHECK(down[down.size() / 2] < 0.5);
  CHECK(back[back.size() / 2] < 0.5);
}

TEST_CASE("adapt: the chain is its own inverse to 2^-30 texel") {
  test::ModelLevels& s = test::swirl();
  for (int y = 0; y < 512; y += 37)
    for (int x = 0; x < 512; x += 29) {
      const Vec2d p((x + 0.5) / 512, (y + 0.5) / 512),
          q = s.sequence.follow(s.sequence.follow(p, s.sequence.size(), 0), 0, s.sequence.size());
      CHECK(std::hypot(q.x - p.x, q.y - p.y) * 512 <= 0x1p-30);
    }
}

TEST_CASE("adapt: packed is one by one, byte for byte, down and up") {
  test::ModelLevels& s = test::swirl();
  raster::CpuRenderer renderer;
  const std::size_t fine = s.sequence.size(), coarse = fine - 300;
  Image packed = identity_map(128, 128), single = packed;
  (void)adapt_map(renderer, s.sequence, fine, coarse, packed);
  for (std::size_t n = fine; n-- > coarse;) (void)adapt_map(renderer, s.sequence, n + 1, n, single);
  CHECK(packed == single);
  (void)adapt_map(renderer, s.sequence, coarse, fine, packed);
  for (std::size_t n = coarse; n < fine; ++n) (void)adapt_map(renderer, s.sequence, n, n + 1, single);
  CHECK(packed == single);
}

TEST_CASE("adapt: the rule as printed makes fewer, larger packs, since passed-over regions do not block") {
  const AdaptSequence& sequence = test::swirl().sequence;
  const std::size_t fine = sequence.size(), safe = pack_splits(sequence, fine, 0, 512, 512).size(),
                    printed = count_printed_packs(sequence, fine, 0, 512, 512);
  CHECK(printed < safe);
  CHECK(printed > 1);
  // Where no two regions overlap no rule matters; one split is one pack.
  CHECK(count_printed_packs(sequence, fine, fine - 1, 512, 512) == 1);
  CHECK(count_printed_packs(sequence, fine, fine, 512, 512) == 0);
}
