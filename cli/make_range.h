// `etalon make range`: one of the built-in range images, as depths or as a coloured mesh.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/image/image.h"
#include "core/mesh/mesh.h"
#include "core/procedural/range_scan.h"

namespace etalon::cli {

struct RangeRequest {
  std::optional<std::string> kind;   ///< shuttle, hand, soldier, teapot or telephone (default)
  std::optional<std::string> image;  ///< chessboard or ramp; by default a mesh has the chessboard, depths have none
  std::string output;                ///< .ply .obj .glb: the mesh; .png .tif .exr: depths
};

struct MadeRange {
  std::string kind, image;  ///< image: empty without colours
  RangeImage range;
  Mesh mesh;                                   ///< its triangulation; with colours if `image` says so
  std::vector<std::filesystem::path> outputs;  ///< what write_range will write
};

[[nodiscard]] MadeRange make_range(const RangeRequest& request);

/// Depths with an image asked for: that too, as STEM_color.png. WriteError.
void write_range(const MadeRange& made);

}  // namespace etalon::cli
