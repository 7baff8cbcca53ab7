// --view: a built-in name or a file `etalon/view/1`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/size_option.h"
#include "validation/verify/verify.h"

namespace etalon::cli {

struct ViewChoice {
  validation::NamedView named;
  std::optional<FrameSize> size;  ///< of the view file, where it says
};

/// "front", "fit", "N/24" by name; anything else is a JSON file {schema, eye, target, up, tan_half_fov_y, near, far, width?, height?}.
/// UsageError where it is neither a name nor an existing file; InputError "FILE: …" where the file is not such a document,
/// its view is degenerate, or its size is not one that --size takes.
[[nodiscard]] ViewChoice parse_view(const std::string& text);

/// `size` as --size gives it; where that is empty, what the view files say, else 1024 x 1024. UsageError where two files differ.
[[nodiscard]] FrameSize frame_size(const std::string& size, const std::vector<ViewChoice>& views);

}  // namespace etalon::cli
