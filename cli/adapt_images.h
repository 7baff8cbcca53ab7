// The images that `etalon adapt` makes for a level: the indexing map, and the textures adapted directly or looked up through a map.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "cli/console.h"
#include "core/adapt/adapt_map.h"
#include "core/image/image.h"

namespace etalon::cli {

/// A level of a progressive mesh, and how images get there.
struct LevelImages {
  const adapt::AdaptSequence& sequence;
  const adapt::ChartBorders& borders;
  Renderer& renderer;
  std::size_t level = 0;
  Filter filter = Filter::linear;
  bool analytic = false;  ///< the exact chain of cells in charts instead of a map adapted split by split, which gives the gutter
  Console& console;
  /// One entry for each image that was adapted or followed: its size, what it cost, what the gutter holds.
  nlohmann::ordered_json images = nlohmann::ordered_json::array();
  std::size_t adaptations = 0, packs = 0;  ///< of the image last adapted

  [[nodiscard]] Image adapted(Image image, const std::string& what);
  [[nodiscard]] Image map(int width, int height, ChannelType type, const std::string& what);
};

/// "float32", "half", "unorm16" or "unorm8".
[[nodiscard]] ChannelType map_type_named(const std::string& name);
/// EXR for floating types; PNG for the others, with a third channel of zeros, which lookups through the map do not read.
void write_map(const std::filesystem::path& path, const Image& map);

/// How far, in texels of the map, texels of charts point from where the chain of cells leads without resampling: median, p99, max over a grid
/// of at most 128 × 128 texels. Null where no texel of the grid is in a chart.
[[nodiscard]] nlohmann::ordered_json map_errors(const LevelImages& level, const Image& map);

/// MODEL.obj, 2 → MODEL_texture_2.png: where the second and later textures go.
[[nodiscard]] std::filesystem::path later_texture_path(const std::filesystem::path& model, std::size_t number);

/// InputError where a texture cannot be adapted and written as PNG: integers, floating numbers, two channels.
void require_texture(const Image& texture, const std::string& name);

}  // namespace etalon::cli
