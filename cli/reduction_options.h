// How far a mesh is reduced, on the command line: --faces and --tolerance, and what is said where neither was reached.
#pragma once

#include <optional>
#include <string>

#include <CLI/App.hpp>

#include "cli/console.h"
#include "core/simplify/simplify.h"

namespace etalon::cli {

struct ReductionOptions {
  std::optional<std::int64_t> faces;
  std::string tolerance;  ///< empty where it was not given
};

/// Adds --faces N, from `least_faces`, and --tolerance D. `what` is reduced ("scan"); `counts` are the options that give a count ("--faces or
/// --ratio").
void add_reduction_options(CLI::App& verb, ReductionOptions& options, std::int64_t least_faces, const std::string& what,
                           const std::string& counts);

/// The tolerance in model units, as parse_length(); nothing where it was not given. UsageError names `verb`; of a length of 0 too where
/// `above_zero`.
[[nodiscard]] std::optional<double> tolerance_of(const ReductionOptions& options, double diagonal, const std::string& verb,
                                                 bool above_zero);

/// Says so where a count of faces was asked for and not reached.
void print_unreached(Console& console, const simplify::SimplifyResult& result, std::size_t target_faces);

}  // namespace etalon::cli
