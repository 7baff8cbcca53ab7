#include "core/io/range_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string_view>

#include "core/base/error.h"
#include "core/io/exr_file.h"
#include "core/io/image_file.h"
#include "core/io/input_error.h"
#include "core/io/inputs.h"
#include "core/math/half.h"

namespace etalon::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSpacingAttribute = "rangeSpacing";

std::string lower_extension(const fs::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension;
}

/// One channel of stored numbers, and the spacing where the file names it.
struct Stored {
  Image depths;
  std::optional<double> spacing;
};

std::optional<double> parse_spacing(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !(value > 0) || !std::isfinite(value)) return std::nullopt;
  return value;
}

Stored stored_in_exr(const ExrContent& content, const std::string& name) {
  std::vector<std::string> names;
  for (const ExrLayer& layer : content.layers) names.insert(names.end(), layer.channel_names.begin(), layer.channel_names.end());
  std::string channel = names.size() == 1 ? names[0] : "Z";
  if (channel == "Z" && std::find(names.begin(), names.end(), "Z") == names.end() &&
      std::find(names.begin(), names.end(), "Y") != names.end())
    channel = "Y";
  Stored stored{channels_image(content, {channel}, name), {}};
  if (const auto it = content.attributes.find(kSpacingAttribute); it != content.attributes.end())
    stored.spacing = parse_spacing(it->second);
  return stored;
}

Stored read_stored(const fs::path& path, const std::string& name) {
  const FileBytes content = read_file(path);
  if (content.text().starts_with("\x76\x2f\x31\x01")) return stored_in_exr(decode_exr(content.bytes(), name), name);
  Stored stored{decode_image(content.bytes(), name), {}};
  if (stored.depths.format().channels != 1)
    fail_file(name, fmt::format("a range image: expected one channel, got {}", to_string(stored.depths.format())));
  return stored;
}

/// The stored number of a channel: integers as they are.
double number_at(const std::byte* at, ChannelType type) {
  const auto as = [&]<class T>(T value) {
    std::memcpy(&value, at, sizeof value);
    return value;
  };
  switch (type) {
    case ChannelType::unorm8:
    case ChannelType::srgb8: return std::to_integer<int>(*at);
    case ChannelType::unorm16: return as(std::uint16_t{});
    case ChannelType::half: return half_to_double(as(std::uint16_t{}));
    case ChannelType::float32: return double{as(0.0f)};
    case ChannelType::uint32: return as(std::uint32_t{});
  }
  return 0;
}

bool is_real(ChannelType type) { return type == ChannelType::half || type == ChannelType::float32; }

void read_depths(const Image& stored, const RangeFileOptions& options, const std::string& name, RangeImage& range) {
  const ChannelType type = stored.format().type;
  const std::optional<double> no_data = options.no_data || is_real(type) ? options.no_data : std::optional(0.0);
  const auto size = static_cast<std::size_t>(bytes_per_channel(type));
  range.z.assign(stored.texel_count(), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < range.z.size(); ++i) {
    const double number = number_at(stored.bytes().data() + i * size, type);
    if (!std::isfinite(number) || number == no_data) continue;
    range.z[i] = static_cast<float>(number * options.depth_scale);
    if (!std::isfinite(range.z[i]))
      fail_file(name, fmt::format("sample {}: expected a depth within float32, got {:.6g}·{:.6g}", i, number, options.depth_scale));
  }
}

double spacing_of(const RangeFileOptions& options, const Stored& stored, const std::string& name) {
  const std::optional<double> spacing = options.spacing ? options.spacing : stored.spacing;
  if (!spacing) fail_file(name, "a range image: expected the spacing of its samples, got none");
  if (!(*spacing > 0) || !std::isfinite(*spacing)) fail_file(name, fmt::format("spacing: expected a length above 0, got {}", *spacing));
  return *spacing;
}

/// Notes on depths that tell little.
void look_at(const RangeImage& range, ChannelType type, const std::string& name, std::vector<std::string>& notes) {
  if (bytes_per_channel(type) == 1)
    notes.push_back(fmt::format("{}: depths of 8 bits: the surface has steps; expected 16 bits or more", name));
  float lo = std::numeric_limits<float>::infinity(), hi = -lo;
  for (const float z : range.z) {
    if (!std::isfinite(z)) continue;
    lo = std::min(lo, z);
    hi = std::max(hi, z);
  }
  if (lo == hi) notes.push_back(fmt::format("{}: every sample has the depth {}: a plane", name, lo));
}

Image steps_image(const RangeImage& range, double step, const std::string& name) {
  Image image(range.width, range.height, {ChannelType::unorm16, 1});
  for (int j = 0; j < range.height; ++j)
    for (int i = 0; i < range.width; ++i) {
      if (!std::isfinite(range.at(i, j))) continue;
      const double steps = double{range.at(i, j)} / step;
      if (!(steps >= 1 && steps <= 65535) || steps != std::floor(steps))
        throw WriteError(fmt::format("{}: cannot write: depth {}: expected 1 to 65535 whole steps of {}", name, range.at(i, j), step));
      *image.channels<std::uint16_t>(i, j) = static_cast<std::uint16_t>(steps);
    }
  return image;
}

Image depths_image(const RangeImage& range) {
  Image image(range.width, range.height, kR32f);
  std::memcpy(image.bytes().data(), range.z.data(), range.z.size() * sizeof(float));
  return image;
}

std::uint8_t color_byte_at(const std::byte* at, ChannelType type, const std::string& name) {
  const double number = number_at(at, type);
  if (type == ChannelType::unorm8 || type == ChannelType::srgb8) return static_cast<std::uint8_t>(number);
  const double value = type == ChannelType::unorm16 ? number / 65535 : number;
  if (std::isnan(value)) fail_file(name, "colours: expected numbers, got a NaN");
  return static_cast<std::uint8_t>(std::floor(std::clamp(value, 0.0, 1.0) * 255 + 0.5));
}

}  // namespace

bool names_range_image(const fs::path& path) {
  const std::string extension = lower_extension(path);
  return extension == ".png" || extension == ".tif" || extension == ".tiff" || extension == ".exr";
}

LoadedRange read_range_image(const fs::path& path, const RangeFileOptions& options) {
  const std::string name = path.string();
  if (options.depth_scale == 0 || !std::isfinite(options.depth_scale))
    fail_file(name, fmt::format("depth scale: expected a number other than 0, got {}", options.depth_scale));
  const Stored stored = read_stored(path, name);
  const Image& depths = stored.depths;
  if (depths.texel_count() > kMaxRangeSamples)
    fail_file(name,
              fmt::format("a range image: expected at most {} samples, got {}x{}", kMaxRangeSamples, depths.width(), depths.height()));
  LoadedRange loaded;
  loaded.range.width = depths.width();
  loaded.range.height = depths.height();
  loaded.range.spacing = spacing_of(options, stored, name);
  read_depths(depths, options, name, loaded.range);
  if (sample_count(loaded.range) == 0)
    fail_file(name, fmt::format("a range image: expected samples, got none in {}x{}", depths.width(), depths.height()));
  look_at(loaded.range, depths.format().type, path.filename().string(), loaded.notes);
  return loaded;
}

void write_range_image(const fs::path& path, const RangeImage& range, double step) {
  const std::string name = path.string(), extension = lower_extension(path);
  ETALON_CHECK(range.z.size() == static_cast<std::size_t>(range.width) * static_cast<std::size_t>(range.height),
               "samples of a range image");
  if (extension == ".png") return write_image(path, steps_image(range, step, name));
  if (extension == ".tif" || extension == ".tiff") return write_image(path, depths_image(range));
  if (extension != ".exr")
    throw WriteError(
        fmt::format("{}: cannot write: range image: expected .png, .tif, .tiff or .exr, got '{}'", name, printable(extension)));
  write_exr(path, {{{{"Z"}, depths_image(range)}}, {{kSpacingAttribute, fmt::format("{}", range.spacing)}}});
}

std::vector<std::byte> color_bytes(const Image& image, const std::string& name) {
  const auto [type, channels] = image.format();
  if (image.empty() || channels == 2 || type == ChannelType::uint32)
    fail_file(name, fmt::format("colours: expected grey, rgb or rgba, got {}", image.empty() ? "none" : to_string(image.format())));
  const auto size = static_cast<std::size_t>(bytes_per_channel(type)), stride = static_cast<std::size_t>(bytes_per_texel(image.format()));
  std::vector<std::byte> rgb(3 * image.texel_count());
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    const std::byte* texel = image.bytes().data() + i / 3 * stride;
    rgb[i] = static_cast<std::byte>(color_byte_at(texel + (channels == 1 ? 0 : i % 3) * size, type, name));
  }
  return rgb;
}

}  // namespace etalon::io
