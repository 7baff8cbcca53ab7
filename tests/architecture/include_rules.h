// The layers: who may include whom (docs/architecture.md#layers), checked on the #include lines.
#pragma once

#include <string>
#include <vector>

#include "tests/architecture/source_text.h"

namespace etalon::test {

/// The layer a file belongs to: "core/mesh", "raster", "validation/reference", "validation", …; "" for a folder the table does not know.
[[nodiscard]] std::string layer_of(const std::string& path);

/// Violations of: the arrows between layers; every quoted include written from the root and there; our own headers never in angle brackets;
/// each outside library only in its folder.
[[nodiscard]] std::vector<Violation> check_includes(const std::vector<SourceFile>& files);

/// The judge is not the judged: what validation/reference reaches, directly or through other headers, is in core/base, core/image, core/draw
/// and the plain types those need. Detail names the chain of includes.
[[nodiscard]] std::vector<Violation> check_reference_reach(const std::vector<SourceFile>& files);

}  // namespace etalon::test
