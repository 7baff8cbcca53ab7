// etalon progressive: a model as a progressive mesh, and any level of one as a model.
#pragma once

#include "cli/common_options.h"

namespace etalon::cli {

[[nodiscard]] Verb add_progressive(CLI::App& root);

}  // namespace etalon::cli
