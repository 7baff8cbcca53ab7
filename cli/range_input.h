// SCAN on the command line: a mesh file, or a range image with the image of its colours.
#pragma once

#include <optional>
#include <string>

#include <CLI/App.hpp>

#include "cli/call_files.h"
#include "core/io/mesh_file.h"

namespace etalon::cli {

struct RangeOptions {
  std::string texture;            ///< image of the range image's size: its colours
  std::optional<double> spacing;  ///< model units from sample to sample
  std::optional<double> depth_scale;
  std::optional<double> no_data;
  std::optional<double> max_jump;  ///< model units
};

/// --texture, --spacing, --depth-scale, --no-data, --max-jump.
void add_range_options(CLI::App& verb, RangeOptions& options);
/// The same without --texture.
void add_range_file_options(CLI::App& verb, RangeOptions& options);

/// A range image (.png .tif .exr) triangulated, with the colours of `options.texture` where there is one; else a mesh, a PLY range grid with
/// its jump as asked. Notes say what was made of what. What is read besides `path` is added to `files`. InputError; UsageError where an
/// option has no use for this file.
[[nodiscard]] io::LoadedModel load_scan(const std::string& path, const RangeOptions& options, CallFiles& files);

/// UsageError where `path` is a range image and no image of its colours is named.
void require_colors(const std::string& path, const RangeOptions& options, const std::string& verb);

}  // namespace etalon::cli
