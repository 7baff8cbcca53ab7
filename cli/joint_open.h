// A joint stream, or a prefix of one, opened as a model: the other direction of `etalon joint`.
#pragma once

#include <string>

#include "cli/console.h"

namespace etalon::cli {

/// True where the file begins as a joint stream does. InputError where it cannot be read.
[[nodiscard]] bool is_joint_stream(const std::string& path);

/// Writes model.obj with its texture, and picture.png where the stream has a view, into `folder`; says which pair it is, and where a prefix was cut.
/// InputError "FILE: joint stream: byte N: …". WriteError.
void open_joint_stream(const std::string& path, const std::string& folder, Console& console);

}  // namespace etalon::cli
