// FILE.draws on the command line: whose vertices are drawn as they are.
#pragma once

#include <string>
#include <vector>

#include "cli/call_files.h"
#include "core/io/draws_file.h"
#include "validation/verify/verify_result.h"

namespace etalon::cli {

/// Whether the name ends in ".draws", in any case.
[[nodiscard]] bool is_draws_name(const std::string& path);

/// Reads the file and its images. All that is read is added to `files` (UsageError where one of them is an output) and to `inputs`. InputError.
[[nodiscard]] io::DrawsFile load_draws(const std::string& path, CallFiles& files, std::vector<validation::VerifyInput>& inputs);

}  // namespace etalon::cli
