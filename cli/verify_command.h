// etalon verify: the exact rasterizer against OpenGL, every texel explained. The main job.
#pragma once

#include "cli/common_options.h"

namespace etalon::cli {

[[nodiscard]] Verb add_verify(CLI::App& root);

}  // namespace etalon::cli
