// etalon joint: one bit budget for a terrain's mesh and its texture [Horbelt, Balmelli & Vetterli].
#pragma once

#include "cli/common_options.h"

namespace etalon::cli {

Verb add_joint(CLI::App& root);

}  // namespace etalon::cli
