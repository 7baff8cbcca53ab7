// One name for a draw list: what a margins file says it belongs to.
#pragma once

#include <string>

#include "core/draw/draw_list.h"

namespace etalon::validation {

/// sha256 over the list, little-endian, field by field (no padding): counts; per vertex x, y, z, w, u, v, r, g, b, a; per triangle three
/// indices; per draw its range, shading, image indices and samplers; per image Image::sha256(). source_faces do not count.
[[nodiscard]] std::string draw_list_sha256(const DrawList& list);

}  // namespace etalon::validation
