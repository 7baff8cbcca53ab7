// What simplification did about a mesh that is no oriented manifold, for a person.
#pragma once

#include "cli/console.h"
#include "core/simplify/simplify.h"

namespace etalon::cli {

/// A line for each kind of place found: what, how many, the first, and what was done.
void print_repair(Console& console, const simplify::InputRepair& repair);

}  // namespace etalon::cli
