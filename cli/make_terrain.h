// `etalon make terrain`: a DEM and an orthophoto, two files.
#pragma once

#include <optional>
#include <string>

#include "cli/common_options.h"

namespace etalon::cli {

struct MakeTerrainOptions {
  std::string output;  ///< the DEM: .tif, .tiff or .exr; the orthophoto goes to STEM_color.png beside it
  std::optional<int> size;
  std::optional<int> texture_size;
};

/// Returns the exit code.
int run_make_terrain(const MakeTerrainOptions& options, const CommonOptions& common);

}  // namespace etalon::cli
