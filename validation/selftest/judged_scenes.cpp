#include "validation/selftest/judged_scenes.h"

#include <fmt/format.h>

#include <cstring>

#include "core/base/parallel.h"

namespace etalon::validation {
namespace {

std::string hex_of(const std::byte* bytes, int count) {
  std::string text;
  for (int n = 0; n < count; ++n) text += fmt::format("{:02x}", static_cast<unsigned>(bytes[n]));
  return text;
}

// `expected(target, i, j)`: first byte of the texel as it should be.
template <class Expected>
Comparison compare_texels(const FixedScene& scene, const Expected& expected, const std::vector<Image>& drawn) {
  Comparison result;
  result.texels = static_cast<std::uint64_t>(scene.frame.width) * static_cast<std::uint64_t>(scene.frame.height);
  for (std::size_t n = 0; n < drawn.size(); ++n) {
    const TargetSpec& target = scene.frame.targets[n];
    const int size = bytes_per_texel(target.format);
    for (int j = 0; j < scene.frame.height; ++j)
      for (int i = 0; i < scene.frame.width; ++i) {
        ++result.values;
        const std::byte* should = expected(n, i, j);
        if (std::memcmp(should, drawn[n].texel(i, j), static_cast<std::size_t>(size)) == 0) continue;
        if (result.mismatches++ == 0)
          result.first_mismatch = fmt::format("{}: texel ({}, {}), {} {}: expected {}, got {}", scene.name, i, j, to_string(target.content),
                                              to_string(target.format), hex_of(should, size), hex_of(drawn[n].texel(i, j), size));
      }
  }
  return result;
}

}  // namespace

Judgement judge_scene(const FixedScene& scene) {
  const reference::Judge judge(scene.list, scene.frame);
  const auto width = static_cast<std::size_t>(scene.frame.width), height = static_cast<std::size_t>(scene.frame.height);
  Judgement judgement(scene.frame.targets.size(), std::vector<reference::TexelBytes>(width * height));
  parallel_for(height, [&](std::size_t j) {
    for (std::size_t i = 0; i < width; ++i) {
      const std::vector<reference::TexelBytes> bytes = judge.texel(static_cast<int>(i), static_cast<int>(j));
      for (std::size_t n = 0; n < bytes.size(); ++n) judgement[n][j * width + i] = bytes[n];
    }
  });
  return judgement;
}

Comparison compare(const FixedScene& scene, const Judgement& expected, const std::vector<Image>& drawn) {
  const auto width = static_cast<std::size_t>(scene.frame.width);
  const auto texel = [&](std::size_t n, int i, int j) {
    return expected[n][static_cast<std::size_t>(j) * width + static_cast<std::size_t>(i)].data();
  };
  return compare_texels(scene, texel, drawn);
}

Comparison compare(const FixedScene& scene, const std::vector<Image>& expected, const std::vector<Image>& drawn) {
  return compare_texels(
      scene, [&](std::size_t n, int i, int j) { return expected[n].texel(i, j); }, drawn);
}

}  // namespace etalon::validation
