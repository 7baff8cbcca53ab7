// etalon metro: how far two surfaces are apart.
#pragma once

#include "cli/common_options.h"

namespace etalon::cli {

[[nodiscard]] Verb add_metro(CLI::App& root);

}  // namespace etalon::cli
