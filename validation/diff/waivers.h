// Known defects that a comparison may pass for a while: a file `etalon/waivers/1`, each with a reason, a device and an end.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "validation/diff/pair_diff.h"

namespace etalon::validation {

struct Waiver {
  std::string pair;          ///< name of the pair, as the comparison prints it
  std::string device;        ///< as --device names it
  std::string reason;        ///< not empty
  std::string expires;       ///< "2027-01-31": the last day it holds, UTC
  std::uint64_t texels = 0;  ///< so many unexplained texels at most
};

/// InputError "FILE: FIELD: what, expected, got": not such a document, an unknown member, an empty reason, no such day.
[[nodiscard]] std::vector<Waiver> read_waivers(const std::string& path);

/// Lets each failing pair pass, with a note, that a waiver for its name and device covers on the day `today` ("2026-11-22"). The waivers
/// for this device that covered nothing, a line each: they must go, or they would hide the next defect.
[[nodiscard]] std::vector<std::string> apply_waivers(std::vector<PairResult>& pairs, const std::vector<Waiver>& waivers,
                                                     const std::string& device, const std::string& today);

/// "2026-11-22", UTC.
[[nodiscard]] std::string today_utc();

}  // namespace etalon::validation
