// A DEM and an image of the same extent on the command line: the terrain and its texture.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/App.hpp>

#include "core/image/image.h"
#include "core/terrain/height_field.h"

namespace etalon::cli {

struct TerrainOptions {
  std::optional<int> grid;          ///< points on a side, 2^k + 1 of k 2..12; none: the most that the DEM holds
  std::optional<double> spacing_m;  ///< between samples of the DEM; none: 10, and a note that says so
  int texture_size = 0;             ///< side of the texture; 0: the image's own texels, cut to the DEM's window
  double height_scale_m = 1;        ///< of one step of a DEM of integers
};

/// --grid, --texture-size and --height-scale.
void add_terrain_options(CLI::App& verb, TerrainOptions& options);

/// What to type for these options: " --grid 257 --spacing 30"; empty where all have their defaults.
[[nodiscard]] std::string terrain_arguments(const TerrainOptions& options);

struct TerrainInput {
  terrain::HeightField field;
  Image image;                        ///< RGB (or one channel) unorm8, square, covering the window
  std::vector<std::string> notes;     ///< what was done
  std::vector<std::string> warnings;  ///< what the user should doubt
};

/// Reads both. The largest square in the middle of the DEM is taken, and the same part of the image. InputError "FILE: …": no such file, no DEM, no
/// 8-bit image, an image of another shape than the DEM.
[[nodiscard]] TerrainInput load_terrain(const std::string& dem_path, const std::string& image_path, const TerrainOptions& options);

/// The square of `image` that begins at (column, row), its alpha dropped; grey stays grey.
[[nodiscard]] Image cut_square(const Image& image, int column, int row, int size);

/// A square image brought to size × size by bilinear interpolation between texel centres (row by row, in double, rounded half up).
[[nodiscard]] Image resized_square(const Image& image, int size);

}  // namespace etalon::cli
