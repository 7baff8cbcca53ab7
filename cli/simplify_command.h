// etalon simplify: a model with fewer triangles.
#pragma once

#include "cli/common_options.h"

namespace etalon::cli {

[[nodiscard]] Verb add_simplify(CLI::App& root);

}  // namespace etalon::cli
