// What simplification did about a mesh that is no oriented manifold, for a person.
#pragma once

#include <nlohmann/json.hpp>

#include "cli/console.h"
#include "core/simplify/simplify.h"

namespace etalon::cli {

/// A line for each kind of place found: what, how many, the first, and what was done.
void print_repair(Console& console, const simplify::InputRepair& repair);

/// The same for a document: count and first place of each kind.
[[nodiscard]] nlohmann::ordered_json repair_json(const simplify::InputRepair& repair);

}  // namespace etalon::cli
