#include "tests/validation/reference/mass_suite.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/parallel.h"
#include "core/base/rng.h"
#include "tests/validation/reference/compare_sample.h"
#include "tests/validation/reference/scene_generator.h"

namespace etalon::validation::reference {

namespace {

struct Texel {
  int i, j;
};

// The texels, inside the frame, that the triangle's bounding box touches.
struct TexelBox {
  std::int64_t i0, i1, j0, j1;  // both ends included
  [[nodiscard]] bool empty() const { return i0 > i1 || j0 > j1; }
  [[nodiscard]] std::uint64_t count() const { return static_cast<std::uint64_t>(i1 - i0 + 1) * static_cast<std::uint64_t>(j1 - j0 + 1); }
};

TexelBox box_of(const Scene& scene, std::uint32_t t) {
  const int bits = scene.frame.state.subtexel_bits;
  TexelBox box{INT32_MAX, INT32_MIN, INT32_MAX, INT32_MIN};
  for (const std::uint32_t corner : scene.list.triangles[t]) {
    const RasterVertex& v = scene.list.vertices[corner];
    box = {std::min<std::int64_t>(box.i0, v.x >> bits), std::max<std::int64_t>(box.i1, v.x >> bits),
           std::min<std::int64_t>(box.j0, v.y >> bits), std::max<std::int64_t>(box.j1, v.y >> bits)};
  }
  return {std::max<std::int64_t>(box.i0, 0), std::min<std::int64_t>(box.i1, scene.frame.width - 1), std::max<std::int64_t>(box.j0, 0),
          std::min<std::int64_t>(box.j1, scene.frame.height - 1)};
}

// A texel within one of a random point of an edge, or of the triangle; clamped to the box.
Texel random_texel(Rng& rng, const Scene& scene, std::uint32_t t, const TexelBox& box, bool near_edge) {
  if (!near_edge && rng.below(4) == 0)
    return {static_cast<int>(rng.between(box.i0, box.i1)), static_cast<int>(rng.between(box.j0, box.j1))};
  const auto& corners = scene.list.triangles[t];
  const std::uint64_t first = rng.below(3);
  const RasterVertex& a = scene.list.vertices[corners[first]];
  const RasterVertex& b = scene.list.vertices[corners[(first + 1) % 3]];
  const RasterVertex& c = scene.list.vertices[corners[(first + 2) % 3]];
  const double s = rng.unit(), r = near_edge ? 0.0 : rng.unit() * (1 - s);
  const auto at = [&](double pa, double pb, double pc) {
    return static_cast<std::int64_t>(pa + s * (pb - pa) + r * (pc - pa)) >> scene.frame.state.subtexel_bits;
  };
  const std::int64_t reach = near_edge ? 1 : 0;
  const std::int64_t i = at(a.x, b.x, c.x) + rng.between(-reach, reach), j = at(a.y, b.y, c.y) + rng.between(-reach, reach);
  return {static_cast<int>(std::clamp(i, box.i0, box.i1)), static_cast<int>(std::clamp(j, box.j0, box.j1))};
}

std::vector<Texel> chosen_texels(Rng& rng, const Scene& scene, std::uint32_t t, int wanted) {
  std::vector<Texel> texels;
  const TexelBox box = box_of(scene, t);
  if (box.empty()) return texels;
  if (box.count() <= static_cast<std::uint64_t>(wanted)) {
    for (std::int64_t j = box.j0; j <= box.j1; ++j)
      for (std::int64_t i = box.i0; i <= box.i1; ++i) texels.push_back({static_cast<int>(i), static_cast<int>(j)});
  } else {
    const Aim aim = scene.aims[t];
    const bool aimed = aim.i >= box.i0 && aim.i <= box.i1 && aim.j >= box.j0 && aim.j <= box.j1;
    if (aimed) texels.push_back({aim.i, aim.j});
    for (int n = aimed ? 1 : 0; n < wanted; ++n) texels.push_back(random_texel(rng, scene, t, box, n % 2 == 0));
  }
  return texels;
}

Tally run_block(std::uint64_t seed, int samples_per_triangle, const MakeSubject& make_subject) {
  const Scene scene = random_block(seed, kTrianglesPerBlock);
  validate(scene.list, scene.frame);
  const std::unique_ptr<SampleSubject> subject = make_subject(scene.list, scene.frame);
  const std::string label = fmt::format("block {}", seed);
  Rng rng(~seed);
  Tally tally;
  for (std::uint32_t t = 0; t < scene.list.triangles.size(); ++t) {
    ++tally.triangles;
    const std::unique_ptr<TriangleJudge> judge = make_triangle_judge(scene.list, scene.frame, t);
    for (const Texel texel : chosen_texels(rng, scene, t, samples_per_triangle))
      compare_sample(scene.list, scene.frame, t, texel.i, texel.j, *judge, *subject, true, label, tally);
  }
  return tally;
}

}  // namespace

Tally run_mass(const MassOptions& options, const MakeSubject& make_subject) {
  std::vector<Tally> tallies(options.blocks);
  parallel_for(tallies.size(),
               [&](std::size_t n) { tallies[n] = run_block(options.first_seed + n, options.samples_per_triangle, make_subject); });
  Tally sum;
  for (const Tally& tally : tallies) sum += tally;
  return sum;
}

}  // namespace etalon::validation::reference
