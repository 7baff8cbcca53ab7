// Drawn images against the judge, every texel of every target.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "validation/reference/sample.h"
#include "validation/selftest/fixed_scenes.h"

namespace etalon::validation {

/// What the judge says about a whole scene: [target][row by row].
using Judgement = std::vector<std::vector<reference::TexelBytes>>;

/// Slow: big integers, on all threads.
[[nodiscard]] Judgement judge_scene(const FixedScene& scene);

struct Comparison {
  std::uint64_t texels = 0;
  std::uint64_t values = 0;
  std::uint64_t mismatches = 0;
  std::string first_mismatch;  ///< "SCENE: texel (I, J), color rgba half: expected HEX, got HEX"
};

[[nodiscard]] Comparison compare(const FixedScene& scene, const Judgement& expected, const std::vector<Image>& drawn);
/// The same with another drawing in the judge's place.
[[nodiscard]] Comparison compare(const FixedScene& scene, const std::vector<Image>& expected, const std::vector<Image>& drawn);

}  // namespace etalon::validation
