// Range images in image files: PNG and TIFF of 8, 16 or 32 bits, half or float, and EXR; one channel of depths.
// Grids of points in PLY files (`range_grid`) are read by
// read_mesh too (mesh_file.h), with the usual jump.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/image/image.h"
#include "core/io/mesh_file.h"
#include "core/mesh/range_image.h"

namespace etalon::io {

inline constexpr std::size_t kMaxRangeSamples = std::size_t{1} << 26;  ///< 8192 × 8192; its triangulation takes some 7 GB

struct RangeFileOptions {
  std::optional<double> spacing;  ///< model units from sample to sample; by default the file's own (EXR, attribute `rangeSpacing`)
  double depth_scale = 1;         ///< model units of one step of depth; below 0 where the file's numbers grow away from the sensor
  std::optional<double> no_data;  ///< the stored number that means "no sample"; by default 0 of integers; of reals only what is not finite
};

struct LoadedRange {
  RangeImage range;
  std::vector<std::string> notes;  ///< one line each: 8-bit depths, a plane
};

/// Whether the extension is that of an image: .png .tif .tiff .exr, in any case.
[[nodiscard]] bool names_range_image(const std::filesystem::path& path);

/// Depth = stored number · depth_scale, in double, rounded once to float32; integers count as they are stored (0 to 65535, not 0 to 1). The
/// file's top row is the highest y. EXR: the channel Z, else Y, else the only one. Samples that are not finite are none.
/// InputError: as read_image; more than one channel; more than kMaxRangeSamples; no spacing; spacing or depth_scale out of range; a depth
/// beyond float32; no sample at all.
[[nodiscard]] LoadedRange read_range_image(const std::filesystem::path& path, const RangeFileOptions& options = {});

/// A PLY file as read_mesh reads it; the triangles of a range grid end where depth jumps by more than `max_jump` (model units, above 0; by
/// default four times the median distance of neighbours in a row). InputError.
[[nodiscard]] LoadedModel read_range_ply(const std::filesystem::path& path, std::optional<double> max_jump = {});

/// Atomically. .exr: channel Z, float32, attribute `rangeSpacing`; .tif, .tiff: float32; no sample: NaN. .png: 16 bits, z/step, no sample: 0.
/// WriteError where z/step is no integer from 1 to 65535, the extension is another, or the file cannot be written.
void write_range_image(const std::filesystem::path& path, const RangeImage& range, double step);

/// 3 bytes a texel as triangulate() takes them: grey is repeated, alpha dropped, unorm16 and reals (kept in [0, 1]) rounded to the nearest
/// of 256 steps. InputError, beginning with `name`, for two channels, uint32, or a real that is no number.
[[nodiscard]] std::vector<std::byte> color_bytes(const Image& image, const std::string& name);

}  // namespace etalon::io
