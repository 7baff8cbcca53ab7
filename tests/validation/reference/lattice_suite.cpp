#include "tests/validation/reference/lattice_suite.h"

#include <fmt/format.h>

#include "core/base/parallel.h"
#include "core/base/rng.h"
#include "tests/validation/reference/compare_sample.h"
#include "tests/validation/reference/random_values.h"
#include "tests/validation/reference/scene_generator.h"

namespace etalon::validation::reference {

namespace {

constexpr int kTexels = 3;
constexpr int kBits = 2;

// The triangles whose first vertex is `first`, all of them; even first vertices draw perspectively, thirds by shading.
Scene lattice_scene(int first, FillRule fill_rule) {
  Rng rng(static_cast<std::uint64_t>(first) + 1);
  Scene scene;
  scene.frame.width = scene.frame.height = kTexels;
  scene.frame.guard = 0;
  scene.frame.state.subtexel_bits = kBits;
  scene.frame.state.fill_rule = fill_rule;
  scene.frame.targets = {{TargetContent::color, kRgba8, {}},
                         {TargetContent::coordinate, kRg32f, {}},
                         {TargetContent::barycentrics, {ChannelType::half, 3}, {}},
                         {TargetContent::depth, kR32f, {}},
                         {TargetContent::margins, kRgba32f, {}},
                         {TargetContent::bound_terms, kRg32f, {}}};
  for (int y = 0; y < kLatticeSide; ++y)
    for (int x = 0; x < kLatticeSide; ++x) {
      RasterVertex v;
      v.x = x, v.y = y;
      v.z = rng.uniform(0, 1);
      v.w = first % 2 == 0 ? rng.uniform(0.3f, 4.0f) : 1.0f;
      v.uv = {static_cast<float>(x) / 12, static_cast<float>(y) / 12};
      v.color = {rng.uniform(0, 1), rng.uniform(0, 1), static_cast<float>(x % 2), static_cast<float>(y % 2)};
      scene.list.vertices.push_back(v);
    }
  const auto a = static_cast<std::uint32_t>(first);
  for (std::uint32_t b = 0; b < kLatticePoints; ++b)
    for (std::uint32_t c = 0; c < kLatticePoints; ++c) scene.list.triangles.push_back({a, b, c});
  Draw draw;
  draw.triangle_count = static_cast<std::uint32_t>(scene.list.triangles.size());
  draw.shading = first % 3 == 0 ? Shading::vertex_color : Shading::texture;
  if (draw.shading == Shading::texture) {
    scene.list.images.push_back(random_image(rng, kRgba8, 0));
    draw.texture = 0;
    draw.sampler = random_sampler(rng);
  }
  scene.list.draws.push_back(draw);
  return scene;
}

Tally run_first_vertex(int first, const LatticeOptions& options, const MakeSubject& make_subject) {
  const Scene scene = lattice_scene(first, options.fill_rule);
  validate(scene.list, scene.frame);
  const std::unique_ptr<SampleSubject> subject = make_subject(scene.list, scene.frame);
  const std::string label = fmt::format("lattice {} {}", first, to_string(options.fill_rule));
  Rng rng(static_cast<std::uint64_t>(first) * 4 + static_cast<std::uint64_t>(options.fill_rule));
  Tally tally;
  for (std::uint32_t t = 0; t < scene.list.triangles.size(); ++t) {
    if (!one_in(rng, static_cast<std::uint64_t>(options.one_triangle_in))) continue;
    const bool with_values = one_in(rng, static_cast<std::uint64_t>(options.one_value_in));
    ++tally.triangles;
    const std::unique_ptr<TriangleJudge> judge = make_triangle_judge(scene.list, scene.frame, t);
    for (int j = 0; j < kTexels; ++j)
      for (int i = 0; i < kTexels; ++i) compare_sample(scene.list, scene.frame, t, i, j, *judge, *subject, with_values, label, tally);
  }
  return tally;
}

}  // namespace

Tally run_lattice(const LatticeOptions& options, const MakeSubject& make_subject) {
  std::vector<Tally> tallies(static_cast<std::size_t>(options.point_count));
  parallel_for(tallies.size(),
               [&](std::size_t n) { tallies[n] = run_first_vertex(options.first_point + static_cast<int>(n), options, make_subject); });
  Tally sum;
  for (const Tally& tally : tallies) sum += tally;
  return sum;
}

}  // namespace etalon::validation::reference
