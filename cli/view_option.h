// --view: a built-in name or a file `etalon/view/1`.
#pragma once

#include <string>

#include "validation/verify/verify.h"

namespace etalon::cli {

/// "front", "fit", "N/24" by name; anything else is a JSON file {schema, eye, target, up, tan_half_fov_y, near, far, width?, height?}.
/// UsageError where it is neither a name nor an existing file; InputError "FILE: …" where the file is not such a document.
[[nodiscard]] validation::NamedView parse_view(const std::string& text);

}  // namespace etalon::cli
