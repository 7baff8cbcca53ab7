// The judge: docs/contract.md written down a second time, slowly, in big integers; what raster/ draws is compared with it.
// Does: for one triangle and one sample, whether it is covered and which bytes each target receives; for one texel, the same after
// visibility.
// Does not: share a line with raster/ or core/math, validate its input (validate() first), or try to be fast.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/draw/draw_list.h"
#include "core/draw/state.h"

namespace etalon::validation::reference {

/// Two transcriptions of the contract that share only the types, the sRGB tables and the decoding of stored numbers.
enum class Arithmetic : std::uint8_t {
  integer,   ///< unreduced fractions of big integers: the judge of millions of samples
  rational,  ///< reduced big rationals, rounding by bisection: the judge of the judge, about ten times slower
};

/// Bytes of one texel of one target: the first bytes_per_texel(format) count, the others are 0.
using TexelBytes = std::array<std::byte, 16>;

struct SampleVerdict {
  bool covered = false;  ///< after culling and the fill rule
  bool on_edge = false;  ///< the sample lies exactly on the triangle's border, whoever owns it (culled triangles included)
  float depth = 1;       ///< stored depth, where covered
};

/// One triangle of a draw list under judgement. Keeps references to the list and the frame. Safe to use from several threads.
class TriangleJudge {
 public:
  virtual ~TriangleJudge() = default;

  /// The verdict on the sample of texel (i, j) (any integers: the frame's rectangle is not looked at).
  [[nodiscard]] virtual SampleVerdict verdict(int i, int j) const = 0;

  /// What each of `targets` stores where this triangle is visible at a covered sample (i, j); `bytes` takes targets.size() elements.
  /// `runner_up_depth` is the stored depth for the margins; none: +inf.
  virtual void store(int i, int j, const std::vector<TargetSpec>& targets, std::optional<float> runner_up_depth,
                     TexelBytes* bytes) const = 0;
};

/// The judge of triangle `t` of a list that validate() accepts for this frame; list and frame must outlive it.
[[nodiscard]] std::unique_ptr<TriangleJudge> make_triangle_judge(const DrawList& list, const Frame& frame, std::uint32_t t,
                                                                 Arithmetic arithmetic = Arithmetic::integer);

/// What a target holds where nothing is drawn.
[[nodiscard]] TexelBytes stored_clear(const TargetSpec& target, HalfRounding half_rounding, Arithmetic arithmetic = Arithmetic::integer);

/// A draw list under judgement, for many texels. List and frame must outlive it. Safe to use from several threads.
class Judge {
 public:
  Judge(const DrawList& list, const Frame& frame, Arithmetic arithmetic = Arithmetic::integer);

  /// The bytes of every target of the frame at texel (i, j), after visibility over all triangles.
  [[nodiscard]] std::vector<TexelBytes> texel(int i, int j) const;

  [[nodiscard]] const TriangleJudge& triangle(std::uint32_t t) const { return *triangles_[t]; }

 private:
  const Frame& frame_;
  std::vector<std::unique_ptr<TriangleJudge>> triangles_;
  std::vector<TexelBytes> clears_;
};

/// Judge(list, frame, arithmetic).texel(i, j), for a single texel.
[[nodiscard]] std::vector<TexelBytes> judge_texel(const DrawList& list, const Frame& frame, int i, int j,
                                                  Arithmetic arithmetic = Arithmetic::integer);

}  // namespace etalon::validation::reference
