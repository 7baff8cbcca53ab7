// Scenes drawn at random, each from one seed: every combination of what the two renderers may disagree on.
#pragma once

#include <cstdint>
#include <string>

#include "core/draw/draw_list.h"

namespace etalon::test {

enum class SceneKind : std::uint8_t {
  affine_color,
  affine_nearest,
  affine_linear,
  perspective_color,
  perspective_nearest,
  perspective_linear,
  depth,
  indexed,
  slivers,
  shared_mesh,
  rectangles,
};
inline constexpr int kSceneKindCount = 11;
[[nodiscard]] std::string to_string(SceneKind kind);

struct RandomScene {
  SceneKind kind{};
  DrawList list;
  Frame frame;
};

/// Sizes up to `largest` texels a side, powers of two and not; formats, filters, wraps, guards and targets vary with the seed.
/// `device_state`: what the device has of its own (fill rule, half rounding, sub-texel bits).
[[nodiscard]] RandomScene make_random_scene(std::uint64_t seed, const RasterState& device_state, int largest = 512);

/// The same for a renderer that keeps the contract to the last bit: half rounding, sub-texel bits (1 up to the state's), sRGB images and
/// targets vary with the seed too. `nearest`: nothing is filtered linearly.
[[nodiscard]] RandomScene make_exact_scene(std::uint64_t seed, const RasterState& device_state, int largest = 512, bool nearest = false);

}  // namespace etalon::test
