// etalon verify: the exact rasterizer against OpenGL, every texel explained. The main job.
#pragma once

#include "cli/common_options.h"
#include "validation/verify/verify_result.h"

namespace etalon::cli {

[[nodiscard]] Verb add_verify(CLI::App& root);

/// What --quiet prints on standard error where the exit code is not 0: "3 texels unexplained, see PAGE"; empty where the sides agree.
[[nodiscard]] std::string quiet_outcome(const validation::VerifyResult& result, const std::string& page);

}  // namespace etalon::cli
