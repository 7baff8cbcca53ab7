// etalon probe: what an OpenGL device does with the freedoms that an API leaves it.
#pragma once

#include "cli/common_options.h"

namespace etalon::cli {

[[nodiscard]] Verb add_probe(CLI::App& root);

}  // namespace etalon::cli
