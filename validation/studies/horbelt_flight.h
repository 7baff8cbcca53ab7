// A flight over a terrain at one budget of bits: for each frame the pair that marginal analysis chooses for its view.
// Does not: read or write files.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/draw/renderer.h"
#include "core/joint/joint_levels.h"
#include "core/joint/problem.h"

namespace etalon::validation {

struct FlightOptions {
  std::size_t frames = 12;  ///< 0: none
  int width = 320, height = 240;
  std::uint64_t budget_bits = 0;  ///< for mesh and texture together
  joint::LevelOptions levels;
  std::function<void(std::size_t done)> before_frame;  ///< may be empty
};

struct FlightFrame {
  terrain::TerrainView view;
  joint::Pair pair;
  std::uint64_t mesh_bits = 0, texture_bits = 0;
  std::optional<double> psnr_db;  ///< RGB, whole frame; none: equal to the full pair's picture
  std::size_t evaluations = 0;    ///< of the search
  bool is_over_budget = false;    ///< even the smallest pair is: it is taken
  Image picture;                  ///< RGB unorm8
};

/// The views of a flight from the south-west over the south to the north-east, a little above the highest point, looking at the middle and ahead.
/// From + − × ÷ only. `frames` >= 1.
[[nodiscard]] std::vector<terrain::TerrainView> flight_views(const terrain::HeightField& field, std::size_t frames, int width, int height);

/// Every frame by slope, the levels made for its view. InputError as TerrainProblem.
[[nodiscard]] std::vector<FlightFrame> fly_over(Renderer& renderer, const terrain::HeightField& field, const Image& image,
                                                const FlightOptions& options);

/// All pictures on one sheet, row by row from the top, four to a row, with a border of two texels. RGB unorm8; pictures of one size, at least one.
[[nodiscard]] Image contact_sheet(const std::vector<FlightFrame>& frames);

}  // namespace etalon::validation
