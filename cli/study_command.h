// etalon study: the measurements of a paper, repeated.
#pragma once

#include "cli/common_options.h"

namespace etalon::cli {

[[nodiscard]] Verb add_study(CLI::App& root);

}  // namespace etalon::cli
