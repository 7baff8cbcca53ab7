// etalon diff: golden against candidate, by idiff's thresholds or by what a device may do.
#pragma once

#include "cli/common_options.h"

namespace etalon::cli {

[[nodiscard]] Verb add_diff(CLI::App& root);

}  // namespace etalon::cli
