// The judge of surface distances: every sample asks every face, one after the other, in double, in the order that docs/papers/simplify.md#metro states.
// Shares no code with core/math, core/mesh or validation/metrics; it is slow: samples times faces.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace etalon::validation::reference {

/// A triangulated surface, all indices in range, all numbers finite.
struct JudgedSurface {
  std::vector<std::array<float, 3>> positions;      ///< #V
  std::vector<std::array<float, 3>> colors;         ///< #V or empty: red, green, blue
  std::vector<std::array<std::uint32_t, 3>> faces;  ///< #F, at least one
};

/// What a sample of one surface found on the other.
struct JudgedPoint {
  std::size_t face = 0;  ///< of those at least distance the first
  std::array<double, 3> weights{}, point{};
  double distance2 = 0;
};
[[nodiscard]] JudgedPoint judge_nearest(const JudgedSurface& surface, const std::array<double, 3>& p);

struct JudgedDistance {
  std::uint64_t samples = 0, vertex_samples = 0, edge_samples = 0, face_samples = 0;
  double mean = 0, rms = 0, max = 0;
  std::array<double, 3> max_at{};
  bool has_colors = false;
  double colour_mean = 0, colour_rms = 0, colour_max = 0;
};
/// From about `target` samples of `from` to the nearest points of `to`.
[[nodiscard]] JudgedDistance judge_distance(const JudgedSurface& from, const JudgedSurface& to, std::uint64_t target);

}  // namespace etalon::validation::reference
