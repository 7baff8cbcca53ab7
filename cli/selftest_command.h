// etalon selftest: does this build draw the contract's bytes on this machine? No data, no file, no OpenGL needed.
#pragma once

#include "cli/common_options.h"

namespace etalon::cli {

[[nodiscard]] Verb add_selftest(CLI::App& root);

}  // namespace etalon::cli
