#include "cli/adapt_images.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "core/adapt/analytic_map.h"
#include "core/adapt/chain_index.h"
#include "core/base/error.h"
#include "core/io/image_file.h"

namespace etalon::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::pair<const char*, ChannelType> kTypes[] = {
    {"float32", ChannelType::float32}, {"half", ChannelType::half}, {"unorm16", ChannelType::unorm16}, {"unorm8", ChannelType::unorm8}};

Image with_third_channel(const Image& map) {
  Image result(map.width(), map.height(), {map.format().type, 3});
  const auto channel_bytes = static_cast<std::size_t>(bytes_per_channel(map.format().type));
  for (std::size_t n = 0; n < map.texel_count(); ++n)
    std::memcpy(result.bytes().data() + n * 3 * channel_bytes, map.bytes().data() + n * 2 * channel_bytes, 2 * channel_bytes);
  return result;
}

}  // namespace

Image LevelImages::adapted(Image image, const std::string& what) {
  adapt::Gutter gutter(borders, image.width(), image.height());
  adapt::AdaptOptions how{.filter = filter, .gutter = &gutter, .progress = {}};
  how.progress = [&](std::size_t done, std::size_t total) { console.progress(what, static_cast<int>(done), static_cast<int>(total)); };
  const adapt::AdaptCounts counts = adapt::adapt_map(renderer, sequence, sequence.size(), level, image, how);
  adaptations = counts.adaptations, packs = counts.packs;
  const adapt::Gutter::Size gutter_size = gutter.size();
  images.push_back({{"what", what},
                    {"width", image.width()},
                    {"height", image.height()},
                    {"adaptations", counts.adaptations},
                    {"packs", counts.packs},
                    {"texels_written", counts.texels > 0 || counts.packs == 0 ? Json(counts.texels) : Json()},  // a device does not count
                    {"uncovered", counts.uncovered},
                    {"doubled", counts.doubled},
                    {"gutter_written", counts.gutter},
                    {"gutter_texels", gutter_size.texels},
                    {"gutter_contested", gutter_size.contested}});
  return image;
}

Image LevelImages::map(int width, int height, ChannelType type, const std::string& what) {
  Image by_splits = adapted(adapt::identity_map(width, height, type), what);
  if (!analytic) return by_splits;
  adapt::Gutter charts(borders, width, height);
  charts.follow_borders(level);
  return adapt::analytic_with_gutter(sequence, level, by_splits, charts, [&](int done, int total) { console.progress(what, done, total); });
}

ChannelType map_type_named(const std::string& name) {
  const auto* const found = std::find_if(std::begin(kTypes), std::end(kTypes), [&](const auto& type) { return name == type.first; });
  ETALON_CHECK(found != std::end(kTypes), "a format that the command line lets through");
  return found->second;
}

void write_map(const std::filesystem::path& path, const Image& map) {
  const bool floating = map.format().type == ChannelType::float32 || map.format().type == ChannelType::half;
  io::write_image(path, floating ? map : with_third_channel(map));
}

Json map_errors(const LevelImages& level, const Image& map) {
  constexpr int kAlong = 128;
  const int width = map.width(), height = map.height();
  adapt::Gutter charts(level.borders, width, height);
  charts.follow_borders(level.level);
  const adapt::ChainIndex chain(level.sequence, level.level, level.sequence.size());
  std::vector<double> errors;
  const auto stride = [](int size) { return (size + kAlong - 1) / kAlong; };
  for (int y = stride(height) / 2; y < height; y += stride(height))
    for (int x = stride(width) / 2; x < width; x += stride(width)) {
      if (!charts.in_chart(x, y)) continue;
      const Vec2d truth = chain.follow({(x + 0.5) / width, (y + 0.5) / height}), at = adapt::map_coordinate(map, x, y);
      const double dx = (at.x - truth.x) * width, dy = (at.y - truth.y) * height;
      errors.push_back(std::sqrt(dx * dx + dy * dy));
    }
  if (errors.empty()) return nullptr;
  std::sort(errors.begin(), errors.end());
  return {{"median", errors[errors.size() / 2]}, {"p99", errors[errors.size() * 99 / 100]}, {"max", errors.back()}};
}

std::filesystem::path later_texture_path(const std::filesystem::path& model, std::size_t number) {
  return model.parent_path() / fmt::format("{}_texture_{}.png", model.stem().string(), number);
}

void require_texture(const Image& texture, const std::string& name) {
  const ChannelType type = texture.format().type;
  if ((type != ChannelType::unorm8 && type != ChannelType::unorm16) || texture.format().channels == 2)
    throw InputError(fmt::format("{}: a texture to adapt: expected 1, 3 or 4 channels of 8 or 16 bits (it is written as PNG), got {}", name,
                                 to_string(texture.format())));
}

}  // namespace etalon::cli
