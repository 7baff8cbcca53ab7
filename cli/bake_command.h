// etalon bake: a coloured scan as few triangles and a texture map.
#pragma once

#include "cli/common_options.h"

namespace etalon::cli {

[[nodiscard]] Verb add_bake(CLI::App& root);

}  // namespace etalon::cli
