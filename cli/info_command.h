// etalon info: what a mesh or image file holds.
#pragma once

#include "cli/common_options.h"

namespace etalon::cli {

[[nodiscard]] Verb add_info(CLI::App& root);

}  // namespace etalon::cli
