// One golden picture and one candidate: their differences by thresholds, and, where a device is named, the class of every texel.
// With the draws that the golden was made from, what the device may do is known, and ties are proven by redrawing; without, a texel
// that another rounding or another choice might have given is only that: "tie?".
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/draw/renderer.h"
#include "validation/bounds.h"
#include "validation/metrics/pixel_comparison.h"
#include "validation/texel_diff.h"
#include "validation/verify/verify_result.h"

namespace etalon::validation {

/// A device by name, as the command line gives it.
struct DiffDevice {
  DeviceModel model;
  int subtexel_bits = 0;                           ///< of its grid: draws must lie on it; 0: any
  std::optional<FillRule> fill_rule = {};          ///< measured: the draws must have the same; nothing: the draws' own
  std::optional<HalfRounding> half_rounding = {};  ///< measured: of half candidates; nothing: the draws' own
  std::string caveat = {};                         ///< one line for whoever relies on the result; may be empty
};

/// "contract", "llvmpipe", "gl", "d3d11", "vulkan:BITS[:TEXELBITS]" (sub-texel bits, 4 to 16; fractional bits of
/// texture coordinates, 4 to 24). InputError for any other name.
[[nodiscard]] DiffDevice device_of_name(const std::string& name);

/// PROBE.json of `etalon probe`: bounds that were measured, times a factor (docs/probe.md). InputError as read_probe().
[[nodiscard]] DiffDevice device_of_probe(const std::string& path);

struct TexelPlace {
  int x = 0, y = 0;  ///< row 0 lowest
};

struct PairOptions {
  PixelThresholds thresholds;
  std::optional<DiffDevice> device;
  std::string draws_path;  ///< empty: what the golden names, or STEM.draws beside it
  std::optional<TexelPlace> texel;
  int picture_px = 0;  ///< pictures for a page, at most so large; 0: none
  int worst_count = 12;
};

enum class PairStatus : std::uint8_t { compared, sizes_differ, only_golden, only_candidate, unreadable };
[[nodiscard]] std::string to_string(PairStatus status);
enum class PairVerdict : std::uint8_t { pass, warning, failure, sizes_differ, bad_input };  // in order of exit codes 0 to 4
[[nodiscard]] std::string to_string(PairVerdict verdict);

struct PairResult {
  std::string name;
  std::string golden_path, candidate_path;
  std::string golden_sha256, candidate_sha256;
  PairStatus status = PairStatus::compared;
  std::string problem;  ///< one line where nothing could be compared
  PairVerdict verdict = PairVerdict::pass;
  PixelComparison pixels;
  std::string draws_path;    ///< by which ties were proven; empty where there were none
  std::string device;        ///< empty: no classes
  std::string bounds;        ///< "derived: llvmpipe of …"
  std::string bound_origin;  ///< to_string(BoundOrigin)
  bool bounds_proven = false;
  std::uint64_t unproven_ties = 0;    ///< in no other class
  std::vector<std::string> patterns;  ///< where unexplained texels lie (defect_patterns.h)
  std::string note;
  std::string texel;  ///< the sentence that was asked for
  CaseResult page;    ///< tally (without unproven ties), worst texels, and pictures
};

/// InputError of a file or of its draws becomes PairStatus::unreadable, so that one bad file does not end a comparison of folders.
[[nodiscard]] PairResult diff_pair(const std::string& name, const std::string& golden_path, const std::string& candidate_path,
                                   Renderer& exact, const PairOptions& options);

/// A side is missing.
[[nodiscard]] PairResult missing_pair(const std::string& name, PairStatus status);

/// The largest verdict: what the exit code says.
[[nodiscard]] PairVerdict worst_verdict(const std::vector<PairResult>& pairs);

}  // namespace etalon::validation
