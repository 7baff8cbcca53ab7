// The meshes M_i and textures T_j of a terrain and its image seen from one view, as two progressive streams: what equation 2 of
// [Horbelt, Balmelli & Vetterli] counts the bits of.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/joint/problem.h"
#include "core/terrain/removal_order.h"
#include "core/terrain/stream_header.h"
#include "core/terrain/terrain_stream.h"
#include "core/wavelet/texture_stream.h"

namespace etalon::joint {

/// How the levels of a texture follow each other.
enum class TexturePyramid : std::uint8_t {
  significance,  ///< section 4: ever more significant coefficients, the largest on the screen first
  distance,      ///< section 2.2: T_i is what is resolvable from d_0·2^(i/k), complete
};
/// Levels that a pyramid of distances can have.
inline constexpr std::size_t kMostDistances = wavelet::kMaxPyramidSteps + 1;

struct LevelOptions {
  std::size_t meshes = 60,
              textures = 32;  ///< at least 2 each; levels that come out equal are one; at most kMostDistances textures by distance
  /// Shares, in geometric progression, of the grid's points and of the coefficients that are significant in the whole texture stream.
  double from = 0.001, to = 0.1;
  double height_unit_m = 0.25;  ///< heights are coded in multiples of this
  terrain::PruningRule pruning = terrain::PruningRule::merging_domains;
  wavelet::Kernel kernel = wavelet::Kernel::irreversible_9_7;
  TexturePyramid pyramid = TexturePyramid::significance;
};

struct JointLevels {
  terrain::HeightField field;  ///< as coded: in height_unit_m
  terrain::Levels levels;
  terrain::TerrainStream mesh_stream;
  std::vector<std::byte> texture_stream;
  std::vector<std::size_t> texture_ends_bytes;  ///< T_j is the first so many bytes
  std::vector<std::size_t> significant;         ///< coefficients of T_j that are known not to be 0
  std::size_t significant_total = 0;            ///< in the whole stream
  wavelet::Delays delays;                       ///< of the texture, from the view
  int pyramid_steps = 0;                        ///< M of the distances d_0 .. d_M; 0: levels by significance
  std::vector<int> texture_steps;  ///< of levels by distance: T_j is from d_(M − texture_steps[j]), the nearest of equal ones
  std::vector<std::uint64_t> mesh_bits,
      texture_bits;  ///< C_M, C_T: 8 × the bytes of joint_stream.h, all heads included, strictly ascending
};

/// The order in which points go is by screen displacement (terrain::screen_weights), that of coefficients by the texel's size on the screen
/// (texel_view.h), both of `view`. `image`: RGB or grey of 8 bits, covering the terrain as its texture coordinates say. InputError.
[[nodiscard]] JointLevels make_joint_levels(const terrain::HeightField& field, const Image& image, const terrain::TerrainView& view,
                                            const LevelOptions& options = {});

/// T_j for j = 0, 1, …: RGB or grey as the image was.
[[nodiscard]] std::vector<Image> texture_levels(const JointLevels& levels);

/// d_i/d_0 = 2^(i/k) of texture level j by distance (at most as exact as wavelet::power_of_two); 1 of levels by significance.
[[nodiscard]] double distance_of(const JointLevels& levels, std::size_t j);

/// The problem of these levels; `error` as in Problem.
[[nodiscard]] Problem problem_of(const JointLevels& levels, std::function<std::uint64_t(std::size_t, std::size_t)> error);

/// Which of a texture's coefficients the view of a mesh stream needs, and when: what encoder and decoder both derive from the streams' headers.
/// None where the mesh's header has no view. `pyramid_steps` of JointLevels: d_M is 2^(10/3) times d_0, so that T_M has a hundredth of T_0's resolvable
/// coefficients (k = 3M/10: the paper's 32 textures of 0.1 % to 10 % have k = 9.3).
[[nodiscard]] wavelet::Delays delays_of(const terrain::StreamHeader& mesh, int texture_width, int texture_height, int levels,
                                        int pyramid_steps);

}  // namespace etalon::joint
