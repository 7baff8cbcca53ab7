#include "cli/range_input.h"

#include <cstddef>
#include <filesystem>
#include <vector>

#include <fmt/format.h>

#include "cli/common_options.h"
#include "cli/model_input.h"
#include "cli/usage_error.h"
#include "cli/work_bytes.h"
#include "core/base/error.h"
#include "core/io/image_file.h"
#include "core/io/range_file.h"
#include "validation/report/json_report.h"

namespace etalon::cli {
namespace {

constexpr double kLongest = 1e30;  ///< a length that float32 holds, and the sum of any number of which a double

void refuse_useless(const std::string& path, const RangeOptions& options) {
  const char* option = !options.texture.empty() ? "--texture"
                       : options.spacing        ? "--spacing"
                       : options.depth_scale    ? "--depth-scale"
                                                : nullptr;
  if (option == nullptr && options.no_data) option = "--no-data";
  if (option != nullptr) throw UsageError(fmt::format("{}: is of range images (.png .tif .exr), got the mesh {}", option, path));
}

std::vector<std::byte> colors_of(const std::string& path, const std::string& texture, const RangeImage& range) {
  const Image image = io::read_image(texture);
  if (image.width() != range.width || image.height() != range.height)
    throw InputError(
        fmt::format("{}: expected {}x{} as {} has, got {}x{}", texture, range.width, range.height, path, image.width(), image.height()));
  return io::color_bytes(image, texture);
}

io::LoadedModel load_range_image(const std::string& path, const RangeOptions& options, CallFiles& files) {
  io::LoadedRange loaded =
      io::read_range_image(path, {.spacing = options.spacing, .depth_scale = options.depth_scale.value_or(1), .no_data = options.no_data});
  const RangeImage& range = loaded.range;
  std::vector<std::byte> colors;
  if (!options.texture.empty()) {
    files.add_input(options.texture, "--texture");
    colors = colors_of(path, options.texture, range);
  }
  io::LoadedModel model;
  model.mesh = naming_the_model(path, [&] { return triangulate(range, colors, {.max_jump = options.max_jump}); });
  model.notes = std::move(loaded.notes);
  if (model.mesh.face_count() == 0)
    throw InputError(fmt::format("{}: a range image: expected neighbours without a jump in depth above {:.6g}, got none", path,
                                 options.max_jump.value_or(4 * range.spacing)));
  model.notes.push_back(fmt::format("{}: a range image of {}x{} samples, {} of them there, as {}",
                                    std::filesystem::path(path).filename().string(), range.width, range.height,
                                    validation::grouped(sample_count(range)), counted(model.mesh.face_count(), "triangle")));
  return model;
}

bool is_ply(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return extension == ".ply";
}

}  // namespace

void add_range_options(CLI::App& verb, RangeOptions& options) {
  verb.add_option("--texture", options.texture, "Of a range image: the image of its colours, of the same size")
      ->type_name("IMAGE")
      ->check(not_empty());
  add_range_file_options(verb, options);
}

void add_range_file_options(CLI::App& verb, RangeOptions& options) {
  verb.add_option("--spacing", options.spacing,
                  "Of a range image: model units from sample to sample (EXR: default its attribute rangeSpacing)")
      ->type_name("D")
      ->check(number_between(1e-30, kLongest));
  verb.add_option("--depth-scale", options.depth_scale,
                  "Of a range image: model units of one step of stored depth (default 1); below 0 where numbers grow away from the sensor")
      ->type_name("S")
      ->check(number_between(-kLongest, kLongest));
  verb.add_option("--no-data", options.no_data,
                  "Of a range image: the stored number that means no sample (default 0 of integers; reals: only what is not finite)")
      ->type_name("V")
      ->check(number_between(-kLongest, kLongest));
  verb.add_option("--max-jump", options.max_jump,
                  "Of a range image or grid: the largest difference in depth that a triangle spans, model units (default 4 spacings)")
      ->type_name("D")
      ->check(number_between(1e-30, kLongest));
}

void require_colors(const std::string& path, const RangeOptions& options, const std::string& verb) {
  if (io::names_range_image(path) && options.texture.empty())
    throw UsageError(fmt::format("{}: {}: a range image has no colours of its own: expected --texture IMAGE", verb, path));
}

io::LoadedModel load_scan(const std::string& path, const RangeOptions& options, CallFiles& files) {
  if (io::names_range_image(path)) return load_range_image(path, options, files);
  refuse_useless(path, options);
  if (options.max_jump && !is_ply(path)) throw UsageError("--max-jump: is of range images and PLY range grids, got " + path);
  return is_ply(path) && options.max_jump ? io::read_range_ply(path, options.max_jump) : io::read_mesh(path, kMinSimplifyBytesPerFace);
}

}  // namespace etalon::cli
