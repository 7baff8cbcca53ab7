#include "cli/reduction_options.h"

#include <fmt/format.h>

#include "cli/common_options.h"
#include "cli/length_option.h"
#include "cli/usage_error.h"
#include "validation/report/json_report.h"

namespace etalon::cli {

void add_reduction_options(CLI::App& verb, ReductionOptions& options, std::int64_t least_faces, const std::string& what,
                           const std::string& counts) {
  verb.add_option("--faces", options.faces, "Stop at this many triangles")
      ->type_name("N")
      ->check(CLI::Range(least_faces, std::int64_t{1} << 32));
  verb.add_option(
          "--tolerance", options.tolerance,
          fmt::format("Let no vertex of the {} be farther than this from the result: model units, or 0.5% of the diagonal; alone, or "
                      "with {}, whichever comes first",
                      what, counts))
      ->type_name("D")
      ->check(not_empty());
}

std::optional<double> tolerance_of(const ReductionOptions& options, double diagonal, const std::string& verb, bool above_zero) {
  if (options.tolerance.empty()) return std::nullopt;
  const std::string where = verb + ": --tolerance";
  const double tolerance = parse_length(options.tolerance, diagonal, where);
  if (above_zero && !(tolerance > 0)) throw UsageError(fmt::format("{}: expected a length above 0, got {}", where, options.tolerance));
  return tolerance;
}

void print_unreached(Console& console, const simplify::SimplifyResult& result, std::size_t target_faces) {
  if (result.stop == simplify::StopReason::faces) return;
  console.line(fmt::format("stopped above the {} faces asked for: every collapse left is refused{}", validation::grouped(target_faces),
                           result.stop == simplify::StopReason::tolerance ? ", some for the tolerance" : ""));
}

}  // namespace etalon::cli
