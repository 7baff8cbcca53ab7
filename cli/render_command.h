// etalon render: one picture of a model, from the exact rasterizer or from OpenGL.
#pragma once

#include "cli/common_options.h"

namespace etalon::cli {

[[nodiscard]] Verb add_render(CLI::App& root);

}  // namespace etalon::cli
