// The verdict on one texel whose bytes differ: which class, by what cause, how close the decision was.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "validation/bounded_triangle.h"

namespace etalon::validation {

/// In order of severity: a texel's class is the worst of its targets'.
enum class TexelClass : std::uint8_t { identical, rounding, tie, unbounded, unexplained };
inline constexpr int kClassCount = 5;

/// What kind of decision an unexplained texel breaks.
enum class Cause : std::uint8_t { none, coverage, depth_order, texel_choice, value };
inline constexpr int kCauseCount = 5;

[[nodiscard]] std::string to_string(TexelClass value);
[[nodiscard]] std::string to_string(Cause value);

/// Margins and bound terms are the oracle's own notes; everything else is compared.
[[nodiscard]] constexpr bool is_compared(TargetContent content) {
  return content != TargetContent::margins && content != TargetContent::bound_terms;
}

struct TexelVerdict {
  TexelClass texel_class = TexelClass::identical;
  Cause cause = Cause::none;
  std::uint32_t triangle = kNoTriangle;            ///< the oracle's visible triangle
  std::uint32_t candidate_triangle = kNoTriangle;  ///< the one that explains the candidate, or that its id target names
  int target = -1;                                 ///< index of the target that decided the class
  double share = 0;   ///< rounding: the largest share of a value bound that was needed; tie: margin / margin bound
  double margin = 0;  ///< tie: distance of the decision from its border (texels, or depth)
  double margin_bound = 0;
};

/// Everything a verdict needs, shared by all threads; images are in the order of frame.targets and may be empty where not given.
struct DiffInput {
  const DrawList& list;
  const Frame& frame;
  const DeviceModel& device;
  std::span<const Image> golden;
  std::span<const Image> candidate;
};

/// Not thread-safe: one per thread (it caches triangles); they may share `grid`.
class TexelExplainer {
 public:
  /// The grid is built on first use, by whichever explainer needs it.
  class SharedGrid {
   public:
    const TriangleGrid& get(const DrawList& list, const Frame& frame);

   private:
    std::once_flag once_;
    std::unique_ptr<TriangleGrid> grid_;
  };

  TexelExplainer(const DiffInput& input, SharedGrid& grid);
  TexelExplainer(const TexelExplainer&) = delete;
  TexelExplainer& operator=(const TexelExplainer&) = delete;

  /// `identical` only where bytes are there to compare; without golden images the candidate is judged against the draw list alone.
  [[nodiscard]] TexelVerdict explain(int x, int y);

  /// One sentence: triangle, exact coordinate, margins, the other choice, verdict.
  [[nodiscard]] std::string describe(int x, int y, const TexelVerdict& verdict);

 private:
  struct Fragment {
    std::uint32_t triangle = kNoTriangle;
    double depth = 1;  // exact
    double bound = 0;
    bool useless = false;
  };
  struct Outcome {
    TexelClass texel_class = TexelClass::unexplained;
    double share = 0, margin = 0, margin_bound = 0;
    int target = -1;
  };
  [[nodiscard]] BoundedTriangle& prepared(std::uint32_t triangle);  // made on first use; valid until the next call
  [[nodiscard]] std::vector<Fragment> fragments(int x, int y);
  [[nodiscard]] std::uint32_t visible(const std::vector<Fragment>& fragments) const;
  // The tie by depth between the oracle's triangle and another: nothing where the gap is beyond the bounds.
  [[nodiscard]] std::optional<Outcome> depth_tie(const std::vector<Fragment>& fragments, std::uint32_t golden, std::uint32_t other) const;
  [[nodiscard]] Outcome check_values(int x, int y, std::uint32_t triangle, double widen);
  [[nodiscard]] Outcome check_color(BoundedTriangle& p, const Sample& s, const TargetSpec& spec, const std::byte* stored, double widen);
  [[nodiscard]] Outcome check_background(const TargetSpec& spec, const std::byte* stored) const;
  [[nodiscard]] Cause cause_of(int x, int y, const std::vector<Fragment>& fragments, std::uint32_t golden);

  const DiffInput& input_;
  SharedGrid& grid_;
  int golden_id_ = -1, candidate_id_ = -1;  // index of the id target where both that image and its spec exist
  std::vector<std::unique_ptr<BoundedTriangle>> cache_;
};

}  // namespace etalon::validation
