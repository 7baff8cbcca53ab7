// etalon make: writes a procedural model and its texture.
#pragma once

#include "cli/common_options.h"

namespace etalon::cli {

[[nodiscard]] Verb add_make(CLI::App& root);

}  // namespace etalon::cli
