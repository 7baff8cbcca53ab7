// etalon selftest: does this build draw the contract's bytes on this machine? No data, no file, no OpenGL needed.
#pragma once

#include "cli/common_options.h"
#include "validation/selftest/selftest.h"

namespace etalon::cli {

[[nodiscard]] Verb add_selftest(CLI::App& root);

/// What --quiet prints on standard error where the exit code is 2; empty where the test passed.
[[nodiscard]] std::string first_failure(const validation::SelftestResult& result);

}  // namespace etalon::cli
