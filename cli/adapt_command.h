// etalon adapt: a progressive mesh's texture, or its indexing map, at one of its levels.
#pragma once

#include "cli/common_options.h"

namespace etalon::cli {

[[nodiscard]] Verb add_adapt(CLI::App& root);

}  // namespace etalon::cli
