// The progressive mesh that `etalon adapt` reads, its cells, and what is wrong with it in texture space: said, counted, or refused.
#pragma once

#include <array>
#include <string>

#include <nlohmann/json.hpp>

#include "cli/console.h"
#include "core/adapt/cell_statistics.h"
#include "core/mesh/mesh_validation.h"
#include "core/progressive/epm_format.h"

namespace etalon::cli {

/// A progressive mesh with all its splits; InputError for a part of one: a texture belongs to the finest level.
[[nodiscard]] progressive::EpmContent read_whole(const std::string& path);

/// The cells that the file holds, or the same made now, which is said. InputError naming `name`: no texture coordinates, or damaged cells.
[[nodiscard]] adapt::AdaptSequence cells_of(progressive::EpmContent& content, const std::string& name, Console& console);

struct TextureSpace {
  MeshReport report;                                         ///< of the finest level
  std::array<std::size_t, adapt::kCellStatusCount> rings{};  ///< by CellStatus
  [[nodiscard]] bool overlaps() const;                       ///< more than 1 % of what is covered is covered twice
};

/// Goes to the finest level and looks. InputError naming `name`: texture coordinates half a texture outside [0, 1] or further (it is tiled: one
/// texel then shows many points of the surface), or further than 2,048 texels of an image `largest_side` texels long (what a pass may reach).
[[nodiscard]] TextureSpace examine_texture_space(progressive::ProgressiveMesh& mesh, const adapt::AdaptSequence& sequence, int largest_side,
                                                 const std::string& name);

/// A line for each kind of finding, and what is done about it; overlaps of more than 1 % as a warning.
void print_texture_space(Console& console, const TextureSpace& space);

/// `coordinates` and `rings` of the document.
void add_texture_space(nlohmann::ordered_json& document, const TextureSpace& space);

}  // namespace etalon::cli
