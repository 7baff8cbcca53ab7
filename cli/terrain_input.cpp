#include "cli/terrain_input.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "cli/common_options.h"
#include "core/base/error.h"
#include "core/io/image_file.h"

namespace etalon::cli {
namespace {

constexpr double kSpacing_m = 10;

// The same extent: a side of the image is the DEM's times one number, up to rounding to whole texels.
void require_same_shape(const Image& dem, const Image& image, const std::string& image_path) {
  const std::int64_t dw = dem.width(), dh = dem.height(), difference = image.width() * dh - image.height() * dw;
  if (2 * std::abs(difference) > dw + dh)
    throw InputError(fmt::format("{}: expected the extent of the DEM, whose {}x{} samples have another shape, got {}x{} texels", image_path,
                                 dw, dh, image.width(), image.height()));
}

int grid_bits(int grid) {
  const int bits = std::bit_width(static_cast<unsigned>(std::max(grid, 2) - 1)) - 1;
  if (grid != (1 << bits) + 1 || bits < terrain::kMinGridBits || bits > terrain::kMaxGridBits)
    throw InputError(fmt::format("--grid: expected 2^k + 1 points (5, 9, 17 … 4097), got {}", grid));
  return bits;
}

}  // namespace

void add_terrain_options(CLI::App& verb, TerrainOptions& options) {
  verb.add_option("--grid", options.grid, "Points of the terrain on a side, 2^k + 1 (default: the most that the DEM has)")
      ->type_name("N")
      ->check(CLI::Range(5, 4097));
  verb.add_option("--texture-size", options.texture_size, "Side of the terrain's texture (default: the image's own texels)")
      ->type_name("N")
      ->check(CLI::Range(2, 4096));
  verb.add_option("--height-scale", options.height_scale_m, "Metres of one step of a DEM of 8 or 16 bits (default 1)")
      ->type_name("M")
      ->check(number_between(1e-6, 1e3));
}

std::string terrain_arguments(const TerrainOptions& options) {
  std::string text;
  if (options.grid) text += fmt::format(" --grid {}", *options.grid);
  if (options.texture_size != 0) text += fmt::format(" --texture-size {}", options.texture_size);
  if (options.spacing_m) text += fmt::format(" --spacing {}", *options.spacing_m);
  if (options.height_scale_m != 1) text += fmt::format(" --height-scale {}", options.height_scale_m);
  return text;
}

Image cut_square(const Image& image, int column, int row, int size) {
  const int channels = image.format().channels < 3 ? 1 : 3;
  Image square(size, size, {ChannelType::unorm8, channels});
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) std::copy_n(image.texel(column + x, row + y), channels, square.texel(x, y));
  return square;
}

Image resized_square(const Image& image, int size) {
  const int channels = image.format().channels, from = image.width();
  Image resized(size, size, image.format());
  struct Place {
    int low, high;
    double share;
  };
  const auto place = [&](int n) -> Place {
    const double at = std::clamp((n + 0.5) / size * from - 0.5, 0.0, static_cast<double>(from - 1));
    const int low = static_cast<int>(at);
    return {low, std::min(low + 1, from - 1), at - low};
  };
  for (int y = 0; y < size; ++y) {
    const Place v = place(y);
    for (int x = 0; x < size; ++x) {
      const Place u = place(x);
      for (int c = 0; c < channels; ++c) {
        const auto texel = [&](int i, int j) { return static_cast<double>(image.channels<std::uint8_t>(i, j)[c]); };
        const double low = texel(u.low, v.low) * (1 - u.share) + texel(u.high, v.low) * u.share;
        const double high = texel(u.low, v.high) * (1 - u.share) + texel(u.high, v.high) * u.share;
        resized.channels<std::uint8_t>(x, y)[c] = static_cast<std::uint8_t>(std::floor(low * (1 - v.share) + high * v.share + 0.5));
      }
    }
  }
  return resized;
}

TerrainInput load_terrain(const std::string& dem_path, const std::string& image_path, const TerrainOptions& options) {
  const Image dem = io::read_image(dem_path), image = io::read_image(image_path);
  if (image.format().type != ChannelType::unorm8)
    throw InputError(fmt::format("{}: expected an image of 8 bits a channel, got {}", image_path, to_string(image.format())));
  require_same_shape(dem, image, image_path);
  const int side = std::min(dem.width(), dem.height());
  terrain::DemOptions how;
  how.window = terrain::DemWindow{(dem.width() - side) / 2, (dem.height() - side) / 2, side};
  how.dem_spacing = options.spacing_m.value_or(kSpacing_m);
  how.sample_scale = options.height_scale_m;
  if (options.grid) how.grid_bits = grid_bits(*options.grid);
  TerrainInput input;
  try {
    terrain::DemResult result = terrain::make_height_field(dem, how);
    input.field = std::move(result.field), input.notes = std::move(result.notes), input.warnings = std::move(result.warnings);
  } catch (const InputError& error) {
    const bool is_integer = dem.format().type == ChannelType::unorm16 || dem.format().type == ChannelType::unorm8;
    throw InputError(dem_path + ": " + error.what() +
                     (is_integer && dem.format().channels == 1
                          ? fmt::format("; a step of it is taken as {} m (--height-scale)", how.sample_scale)
                          : ""));
  }
  if (!options.spacing_m) input.notes.push_back(fmt::format("heights are taken as {} m apart (--spacing)", kSpacing_m));
  // Whole texels: the image's window begins and ends at the texels nearest to the DEM's.
  const auto scaled = [](int n, int to, int from) {
    return static_cast<int>((2 * std::int64_t{n} * to + from) / (2 * std::int64_t{from}));
  };
  const int size = std::min({scaled(side, image.width(), dem.width()), image.width(), image.height()});
  const int column = std::min(scaled(how.window->column, image.width(), dem.width()), image.width() - size);
  const int row = std::min(scaled(how.window->row, image.height(), dem.height()), image.height() - size);
  input.image = cut_square(image, column, row, size);
  if (size != image.width() || size != image.height())
    input.notes.push_back(fmt::format("of {}x{} texels, the {}x{} from column {} and row {} (from below) on are taken", image.width(),
                                      image.height(), size, size, column, row));
  if (image.format().channels == 4 || image.format().channels == 2) input.notes.emplace_back("the image's alpha is left out");
  if (options.texture_size != 0 && options.texture_size != size) {
    input.image = resized_square(input.image, options.texture_size);
    input.notes.push_back(fmt::format("{0}x{0} texels are brought to {1}x{1} by bilinear interpolation", size, options.texture_size));
  }
  return input;
}

}  // namespace etalon::cli
