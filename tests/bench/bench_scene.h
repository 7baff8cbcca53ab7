// What is timed: drawings that the CPU renderer and OpenGL are given alike, as finished draw lists.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/draw/resident_map.h"

namespace etalon::bench {

/// Passes over a map that stays with its renderer.
struct MapWork {
  Image map;
  std::vector<MapPass> packed, one_by_one;  ///< the same groups in the same order
  Filter filter = Filter::linear;
};

/// One drawing with one draw, whose vertices all lie inside the frame: an application would need neither guard nor clipping for it.
struct BenchScene {
  DrawList list;
  Frame frame;
  std::optional<MapWork> map_work;  ///< instead of list and frame
};

/// A scene by name, made when its turn comes: the large ones take a second and some hundred megabytes.
struct SceneEntry {
  std::string name;
  std::string title;
  std::function<std::optional<BenchScene>()> make;  ///< nothing: a real input is absent
  /// The largest share of texels in which a device may differ before the scene is no comparison any more. Ties and rounding are below
  /// 0.2 %; llvmpipe filters RGBA8 with 8 bits, a fifth of its channels differ by 1 or 2 of 255; where all texels are ties, all may.
  double most_differing = 0.01;
};

/// Vertices of a square with the coordinates of `uv_of`, a function of texel positions; two triangles over the whole frame.
enum class ScreenWarp : std::uint8_t {
  identity,    ///< texel (i, j) of the frame looks up texel (i, j)
  half_texel,  ///< moved by half a texel in both directions: every texel is a tie between four
  rotated,     ///< turned by the angle of the 3-4-5 triangle about a corner, image repeated
};

/// 100,000 triangles of some five texels on average, random in place, depth and colour; depth-tested; 512 × 512.
[[nodiscard]] BenchScene small_triangles_scene(std::uint32_t triangle_count = 100'000);
/// The embedded head with its texture, 1024 × 1024.
[[nodiscard]] BenchScene head_scene(Filter filter);
/// The real head with its photo texture, or nothing where $ETALON_DATA does not have it.
[[nodiscard]] std::optional<BenchScene> real_head_scene(Filter filter);
/// The whole 1024 × 1024 frame looked up in a 1024 × 1024 RGBA8 image, nearest, without depth.
[[nodiscard]] BenchScene full_screen_scene(ScreenWarp warp);
/// The knot with rings × around vertices, in its vertex colours; depth-tested; 1024 × 1024.
[[nodiscard]] BenchScene knot_scene(int rings = 2360, int around = 500);
/// A terrain of 2·cells² triangles under a 1024 × 1024 texture, nearest; depth-tested; 1024 × 1024.
[[nodiscard]] BenchScene terrain_scene(std::uint32_t cells = 256);

/// All of them, in the order of the table; the fans (fan_scene.h) are an entry of their own.
[[nodiscard]] std::vector<SceneEntry> scene_entries();

/// What a scene asks of any renderer.
struct SceneWork {
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
  std::uint64_t covered_texels = 0;  ///< texels with a visible triangle
  std::uint64_t input_bytes = 0;     ///< vertices and triangles, as in the draw list
  std::uint64_t frame_bytes = 0;     ///< of all targets
  std::uint64_t lookups = 0;         ///< texture reads of visible texels: one each under nearest, four under linear
  std::uint64_t lookup_bytes = 0;    ///< of one read
  std::uint64_t table_texels = 0;    ///< of the texture; 0: none
};
[[nodiscard]] SceneWork work_of(const BenchScene& scene);

}  // namespace etalon::bench
