// The diff that explains: golden and candidate images of one draw list, texel by texel, each difference put into a class.
//
//   identical    same bytes
//   rounding     same decisions; the value is a legal rounding of some number within the device's bound of the exact one
//   tie          another texel or depth order, whose margin is within the bound, and the value is the one which that choice gives
//   unbounded    the device's bound is infinite or useless here
//   unexplained  anything else: a defect of one side
//
// Does: vertex colours, textures, indexed lookups, coordinates, barycentrics, depth, ids; all formats. Coverage has bound 0.
// Does not: draw; compare margins and bound terms (the oracle's own notes). Deterministic for any thread count.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "validation/texel_explainer.h"

namespace etalon::validation {

struct DiffOptions {
  int worst_count = 16;          ///< texels described in the result
  bool keep_class_image = true;  ///< R unorm8, the class's number per texel
};

struct ClassCounts {
  std::array<std::uint64_t, kClassCount> texels{};
  [[nodiscard]] std::uint64_t operator[](TexelClass c) const { return texels[static_cast<std::size_t>(c)]; }
  [[nodiscard]] std::uint64_t& operator[](TexelClass c) { return texels[static_cast<std::size_t>(c)]; }
  [[nodiscard]] std::uint64_t total() const;
  ClassCounts& operator+=(const ClassCounts& other);
};

struct TexelReport {
  int x = 0, y = 0;
  TexelVerdict verdict;
  std::vector<std::string> golden_bytes, candidate_bytes;  ///< hexadecimal, per target; empty where the image was not given
  std::string sentence;
};

struct DiffResult {
  ClassCounts counts;
  std::array<std::uint64_t, kCauseCount> unexplained_by{};  ///< indexed by Cause
  std::vector<TexelReport> worst;  ///< most severe class first, then the largest share of the bound, then row by row
  Image class_image;
  double largest_rounding_share = 0;  ///< of the bounds that were needed: far below 1 where the derivation is safe
  double largest_tie_share = 0;
  BoundOrigin bound_origin = BoundOrigin::derived;
  std::string bound_valid_for;

  [[nodiscard]] bool agreed() const { return counts[TexelClass::unexplained] == 0; }
  /// Proven: agreed, and on bounds that are derived.
  [[nodiscard]] bool proven() const { return agreed() && (bound_origin == BoundOrigin::exact || bound_origin == BoundOrigin::derived); }
};

/// `golden` and `candidate`: one image per target of the frame, in order, as Renderer::render() returns them; an empty image is "not given".
/// Where the golden id target is given it names the visible triangles, else they are found from the draw list.
/// A candidate id target lets a wrong triangle be told from a wrong value. InputError where an image's size or format is not the target's,
/// or where no target is given on both sides.
[[nodiscard]] DiffResult diff_images(const DrawList& list, const Frame& frame, const DeviceModel& device, std::span<const Image> golden,
                                     std::span<const Image> candidate, const DiffOptions& options = {});

/// One texel explained, whatever its class.
[[nodiscard]] TexelReport explain_texel(const DrawList& list, const Frame& frame, const DeviceModel& device, std::span<const Image> golden,
                                        std::span<const Image> candidate, int x, int y);

/// The class table as text, one line per class that names its count and share.
[[nodiscard]] std::string format_counts(const DiffResult& result);

}  // namespace etalon::validation
