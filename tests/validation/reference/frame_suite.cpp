#include "tests/validation/reference/frame_suite.h"

#include <fmt/format.h>

#include <cstring>

#include "core/base/parallel.h"
#include "tests/validation/reference/compare_sample.h"
#include "tests/validation/reference/scene_generator.h"
#include "validation/reference/sample.h"

namespace etalon::validation::reference {

namespace {

TexelBytes bytes_of(const Image& image, int i, int j) {
  TexelBytes bytes{};
  std::memcpy(bytes.data(), image.texel(i, j), static_cast<std::size_t>(bytes_per_texel(image.format())));
  return bytes;
}

Tally judge_row(const Scene& scene, const Judge& judge, const std::vector<Image>& images, const std::string& label, int j) {
  Tally tally;
  for (int i = 0; i < scene.frame.width; ++i) {
    const std::vector<TexelBytes> expected = judge.texel(i, j);
    ++tally.samples;
    for (std::size_t n = 0; n < images.size(); ++n) {
      ++tally.values;
      const TargetSpec& target = scene.frame.targets[n];
      const TexelBytes got = bytes_of(images[n], i, j);
      if (target.content == TargetContent::triangle_id && expected[n] != stored_clear(target, scene.frame.state.half_rounding))
        ++tally.covered;
      if (got == expected[n]) continue;
      const int size = bytes_per_texel(target.format);
      tally.mismatch(fmt::format("{}, texel ({}, {}), target {} {} {}, depth test {}: expected {}, got {}", label, i, j, n,
                                 to_string(target.content), to_string(target.format), scene.frame.state.depth_test ? "on" : "off",
                                 hex_of(expected[n], size), hex_of(got, size)));
    }
  }
  return tally;
}

Scene scene_of(const FrameOptions& options, std::uint64_t n) {
  return random_frame(options.first_seed + n, options.width, options.height, options.triangle_count);
}

}  // namespace

Tally run_frames(const FrameOptions& options, Renderer& renderer) {
  Tally sum;
  for (std::uint64_t n = 0; n < options.frames; ++n) {
    const Scene scene = scene_of(options, n);
    const std::vector<Image> images = renderer.render(scene.list, scene.frame);
    const Judge judge(scene.list, scene.frame);
    std::vector<Tally> rows(static_cast<std::size_t>(scene.frame.height));
    const std::string label = fmt::format("frame {}", options.first_seed + n);
    parallel_for(rows.size(), [&](std::size_t j) { rows[j] = judge_row(scene, judge, images, label, static_cast<int>(j)); });
    for (const Tally& row : rows) sum += row;
    sum.triangles += scene.list.triangles.size();
  }
  return sum;
}

Tally run_threads(const FrameOptions& options, Renderer& renderer) {
  Tally tally;
  for (std::uint64_t n = 0; n < options.frames; ++n) {
    const Scene scene = scene_of(options, n);
    tally.triangles += scene.list.triangles.size();
    set_thread_count(1);
    const std::vector<Image> expected = renderer.render(scene.list, scene.frame);
    for (const int threads : {2, 7}) {
      set_thread_count(threads);
      const std::vector<Image> got = renderer.render(scene.list, scene.frame);
      for (std::size_t k = 0; k < expected.size(); ++k) {
        tally.values += expected[k].texel_count();
        if (got[k] != expected[k])
          tally.mismatch(fmt::format("frame {}, target {}: {} threads give other bytes than one", options.first_seed + n, k, threads));
      }
    }
    set_thread_count(0);
  }
  return tally;
}

}  // namespace etalon::validation::reference
