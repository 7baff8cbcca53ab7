// Table 1 of [Chen & Chuang 2006]: how many adaptations share a pass, and what that saves; several objects in one pass; adapting while
// collapsing.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/adapt/adapt_sequence.h"
#include "core/draw/renderer.h"
#include "core/progressive/progressive_mesh.h"

namespace etalon::validation {

/// A row of the paper's Table 1. Times in milliseconds: Pentium 4, 3 GHz, GeForce 6800 GT.
struct ChenPaperRow {
  std::string model;
  std::size_t faces = 0, base_faces = 0, adaptations = 0;
  double single_ms = 0;
  std::size_t packs = 0;
  double packed_ms = 0, speedup = 0, adapted_ms = 0, plain_ms = 0;
};
/// Parasaur head (whose face count is misprinted: 7,835, of which 3,611 collapses leave at least 613; Figure 12 has 7,685), bunny head.
[[nodiscard]] const std::array<ChenPaperRow, 2>& chen_paper_rows();

/// Average times of one adaptation, in milliseconds of wall clock: of the passes alone, which are made beforehand.
struct ChenTimes {
  std::string renderer;
  double single_ms = 0;           ///< a pass for each
  double packed_ms = 0;           ///< packs
  std::size_t singles_timed = 0;  ///< adaptations that single_ms is the mean of, evenly spread
};

struct ChenPacking {
  std::size_t faces = 0, base_faces = 0;
  std::size_t adaptations = 0;    ///< collapses with cells
  std::size_t packs = 0;          ///< by the safe rule, which is executed
  std::size_t printed_packs = 0;  ///< by the rule as printed, which is not
  std::uint64_t texels = 0;       ///< written in all
  bool same_bytes = false;        ///< packed and one by one leave the same map
  ChenTimes exact;
  std::optional<ChenTimes> device;
  double levels_ms = 0;    ///< from the finest level to the base, collapse by collapse, no texture
  double adapted_ms = 0;   ///< the same, then packing, making and drawing all passes
  double together_ms = 0;  ///< the same, mesh and map at once
};

/// From the finest level to the base, on an indexing map of float32. `device` may be null; there at most `device_singles` adaptations are
/// timed one by one.
[[nodiscard]] ChenPacking measure_packing(progressive::ProgressiveMesh& mesh, const adapt::AdaptSequence& sequence, Renderer& exact,
                                          Renderer* device, int map_size, std::size_t device_singles);

/// Whether no cell reaches within `margin` (of 1) of the texture's edge.
[[nodiscard]] bool keeps_off_edges(const adapt::AdaptSequence& sequence, double margin);

/// Several objects whose maps lie in one atlas, one above the other: the n-th packs of all are one pass. Exactly what each has alone but for
/// the rounding of coordinates in the atlas, where none reaches the map's edge.
struct ChenSharing {
  std::vector<std::string> names;
  std::vector<std::size_t> packs;      ///< of each alone
  std::size_t passes = 0;              ///< together
  std::uint64_t texels = 0;            ///< of the atlas
  std::uint64_t differing = 0;         ///< of those, not the same as each alone
  double largest = 0;                  ///< of their differences, in texels of a map
  double apart_ms = 0, shared_ms = 0;  ///< exact rasterizer
  std::optional<double> device_apart_ms, device_shared_ms;
};
[[nodiscard]] ChenSharing measure_sharing(const std::vector<std::string>& names, const std::vector<const adapt::AdaptSequence*>& sequences,
                                          Renderer& exact, Renderer* device, int map_size);

}  // namespace etalon::validation
