// Who must be named when a known input is shown; keyed by what the file holds, not by its name.
#pragma once

#include <string>

namespace etalon::cli {

/// The credit line of the file with this sha256; empty where it is unknown or asks for none.
[[nodiscard]] std::string attribution_of(const std::string& sha256);

}  // namespace etalon::cli
