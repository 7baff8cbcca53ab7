#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/draw/channel_maxima.h"
#include "core/draw/draw_list.h"
#include "core/math/half.h"

namespace etalon {
namespace {

constexpr int kMaxFrame = 16384;

[[noreturn]] void refuse(const std::string& message) { throw InputError("draw list: " + message); }

void validate_target(const TargetSpec& target, std::size_t n) {
  const PixelFormat f = target.format;
  const auto expect = [&](bool good, const char* expected) {
    if (!good) refuse(fmt::format("target {} ({}): expected {}, got {}", n, to_string(target.content), expected, to_string(f)));
  };
  if (f.channels < 1 || f.channels > 4) refuse(fmt::format("target {}: expected 1 to 4 channels, got {}", n, f.channels));
  const bool number = f.type != ChannelType::uint32;
  switch (target.content) {
    case TargetContent::color: expect(number, "any format but uint32"); break;
    case TargetContent::triangle_id: expect(f == kR32ui, "r uint32"); break;
    case TargetContent::barycentrics: expect(number && f.channels == 3, "3 channels, not uint32"); break;
    case TargetContent::coordinate: expect(number && f.channels == 2, "2 channels, not uint32"); break;
    case TargetContent::depth: expect(f == kR32f, "r float32"); break;
    case TargetContent::margins: expect(f == kRgba32f, "rgba float32"); break;
    case TargetContent::bound_terms: expect(f == kRg32f, "rg float32"); break;
  }
  for (const float c : target.clear)
    if (!std::isfinite(c)) refuse(fmt::format("target {}: expected a finite clear value, got {}", n, c));
}

}  // namespace

void validate(const Frame& frame) {
  if (frame.width < 1 || frame.height < 1 || frame.guard < 0 || frame.width > kMaxFrame || frame.height > kMaxFrame ||
      std::max(frame.width, frame.height) + 2 * static_cast<std::int64_t>(frame.guard) > kMaxFrame)
    refuse(fmt::format("frame: expected 1 to {0} texels a side, with twice the guard at most {0}, got {1}x{2} with guard {3}", kMaxFrame,
                       frame.width, frame.height, frame.guard));
  if (frame.state.subtexel_bits < 1 || frame.state.subtexel_bits > 16)
    refuse(fmt::format("sub-texel bits: expected 1 to 16, got {}", frame.state.subtexel_bits));
  for (std::size_t n = 0; n < frame.targets.size(); ++n) validate_target(frame.targets[n], n);
}

namespace {

constexpr std::size_t kBlock = 16384;

// What a vertex must obey; positions in sub-texels.
struct VertexLimits {
  std::int64_t lo, x_hi, y_hi;
  explicit VertexLimits(const Frame& frame)
      : lo(-(std::int64_t{frame.guard} << frame.state.subtexel_bits)),
        x_hi((std::int64_t{frame.width} + frame.guard) << frame.state.subtexel_bits),
        y_hi((std::int64_t{frame.height} + frame.guard) << frame.state.subtexel_bits) {}

  // All at once, without a branch; false for NaN.
  [[nodiscard]] bool hold(const RasterVertex& v) const {
    constexpr float most = 0x1p40f;
    int good = 1;
    for (const bool holds : {v.x >= lo, v.x <= x_hi, v.y >= lo, v.y <= y_hi, v.z >= 0, v.z <= 1, v.w >= 0x1p-20f, v.w <= 0x1p20f,
                             std::abs(v.uv.x) <= most, std::abs(v.uv.y) <= most, std::abs(v.color[0]) <= most, std::abs(v.color[1]) <= most,
                             std::abs(v.color[2]) <= most, std::abs(v.color[3]) <= most})
      good &= static_cast<int>(holds);
    return good != 0;
  }

  void refuse_vertex(const RasterVertex& v, std::size_t n) const {
    if (v.x < lo || v.x > x_hi || v.y < lo || v.y > y_hi)
      refuse(
          fmt::format("vertex {}: expected a position in [{}, {}] x [{}, {}] sub-texels, got ({}, {})", n, lo, x_hi, lo, y_hi, v.x, v.y));
    if (!(v.z >= 0 && v.z <= 1)) refuse(fmt::format("vertex {}: expected z in [0, 1], got {}", n, v.z));
    if (!(v.w >= 0x1p-20f && v.w <= 0x1p20f)) refuse(fmt::format("vertex {}: expected w in [2^-20, 2^20], got {}", n, v.w));
    const auto attribute_ok = [](float a) { return std::abs(a) <= 0x1p40f; };
    if (!attribute_ok(v.uv.x) || !attribute_ok(v.uv.y))
      refuse(fmt::format("vertex {}: expected finite uv of at most 2^40, got ({}, {})", n, v.uv.x, v.uv.y));
    for (int c = 0; c < 4; ++c)
      if (!attribute_ok(v.color[c])) refuse(fmt::format("vertex {}: expected a finite colour of at most 2^40, got {}", n, v.color[c]));
  }
};

// Largest |u| and |v| of the vertices.
using UvMaxima = std::array<float, 2>;

UvMaxima validate_vertices(const DrawList& list, const Frame& frame) {
  const VertexLimits limits(frame);
  struct Block {
    bool good = true;
    UvMaxima uv{};
  };
  std::vector<Block> blocks((list.vertices.size() + kBlock - 1) / kBlock);
  parallel_for_blocks(list.vertices.size(), kBlock, [&](std::size_t begin, std::size_t end) {
    Block block;
    for (std::size_t n = begin; n < end; ++n) {
      const RasterVertex& v = list.vertices[n];
      block.good &= limits.hold(v);
      block.uv = {std::max(block.uv[0], std::abs(v.uv.x)), std::max(block.uv[1], std::abs(v.uv.y))};
    }
    blocks[begin / kBlock] = block;
  });
  UvMaxima uv{};
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    for (std::size_t n = b * kBlock; !blocks[b].good && n < list.vertices.size(); ++n) limits.refuse_vertex(list.vertices[n], n);
    uv = {std::max(uv[0], blocks[b].uv[0]), std::max(uv[1], blocks[b].uv[1])};
  }
  return uv;
}

void validate_triangles(const DrawList& list) {
  std::vector<std::uint32_t> largest((list.triangles.size() + kBlock - 1) / kBlock, 0);
  parallel_for_blocks(list.triangles.size(), kBlock, [&](std::size_t begin, std::size_t end) {
    std::uint32_t most = 0;
    for (std::size_t t = begin; t < end; ++t)
      for (const std::uint32_t corner : list.triangles[t]) most = std::max(most, corner);
    largest[begin / kBlock] = most;
  });
  for (std::size_t b = 0; b < largest.size(); ++b)
    for (std::size_t t = b * kBlock; largest[b] >= list.vertices.size() && t < list.triangles.size(); ++t)
      for (const std::uint32_t corner : list.triangles[t])
        if (corner >= list.vertices.size())
          refuse(fmt::format("triangle {}: expected vertex indices below {}, got {}", t, list.vertices.size(), corner));
}

// The number in channel c of a float or half texel.
double number_at(const Image& image, int x, int y, int c) {
  return image.format().type == ChannelType::half ? half_to_double(image.channels<std::uint16_t>(x, y)[c])
                                                  : double{image.channels<float>(x, y)[c]};
}

// What the images of a list hold, each scanned once however many draws use it.
class ImageRanges {
 public:
  ImageRanges(const DrawList& list, bool known_good) : list_(list), known_good_(known_good), maxima_(list.images.size()) {}

  // Refuses where channel c exceeds limits[c], naming the first such texel.
  void check(std::uint32_t index, const ChannelMaxima& limits) {
    if (known_good_) return;
    const Image& image = *list_.images[index];
    auto& maxima = maxima_[index];
    if (!maxima) maxima = channel_maxima(image);
    for (std::size_t c = 0; c < static_cast<std::size_t>(image.format().channels); ++c)
      if (!((*maxima)[c] <= limits[c])) name_texel(index, static_cast<int>(c), limits[c]);
  }

 private:
  void name_texel(std::uint32_t index, int c, double limit) const {
    const Image& image = *list_.images[index];
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x)
        if (const double value = number_at(image, x, y, c); !(std::abs(value) <= limit))
          refuse(fmt::format("image {}, texel ({}, {}): expected a finite number of at most {}, got {}", index, x, y, limit, value));
  }
  const DrawList& list_;
  bool known_good_;
  std::vector<std::optional<ChannelMaxima>> maxima_;
};

void validate_image(const DrawList& list, std::size_t draw, std::uint32_t index, const char* role, int least_channels) {
  if (index >= list.images.size() || list.images[index] == nullptr || list.images[index]->empty())
    refuse(fmt::format("draw {}: expected an image as {}, got none", draw, role));
  const Image& image = *list.images[index];
  if (image.format().type == ChannelType::uint32) refuse(fmt::format("draw {}: {} is uint32, which cannot be looked up", draw, role));
  if (image.format().channels < least_channels)
    refuse(fmt::format("draw {}: expected {} with at least {} channels, got {}", draw, role, least_channels, image.format().channels));
}

// |u|·size < 2^30 for all vertices of the draw: interpolation cannot leave their range. `uv_most` is of the whole list.
void validate_lookup_range(const DrawList& list, const UvMaxima& uv_most, const Draw& draw, std::size_t n, const Image& image) {
  if (double{uv_most[0]} * image.width() < 0x1p30 && double{uv_most[1]} * image.height() < 0x1p30) return;
  for (std::uint32_t t = draw.first_triangle; t < draw.first_triangle + draw.triangle_count; ++t)
    for (const std::uint32_t corner : list.triangles[t]) {
      const Vec2f uv = list.vertices[corner].uv;
      if (std::abs(double{uv.x}) * image.width() >= 0x1p30 || std::abs(double{uv.y}) * image.height() >= 0x1p30)
        refuse(fmt::format("draw {}, triangle {}: expected |uv| times the image's size below 2^30, got ({}, {})", n, t, uv.x, uv.y));
    }
}

void validate_draw(const DrawList& list, const UvMaxima& uv_most, std::size_t n, ImageRanges& ranges) {
  const Draw& draw = list.draws[n];
  if (draw.shading == Shading::vertex_color) return;
  const auto texel_limit = [](const Sampler& sampler) {
    return sampler.filter == Filter::linear ? 0x1p40 : static_cast<double>(std::numeric_limits<float>::max());
  };
  validate_image(list, n, draw.texture, "texture", 1);
  const double texture_limit = texel_limit(draw.sampler);
  ranges.check(draw.texture, {texture_limit, texture_limit, texture_limit, texture_limit});
  const Image& texture = *list.images[draw.texture];
  if (draw.shading == Shading::texture) return validate_lookup_range(list, uv_most, draw, n, texture);
  validate_image(list, n, draw.indexing_map, "indexing map", 2);
  // |u|·width < 2^30, so at most the float32 below; the other channels are not used as coordinates.
  const double map_limit = texel_limit(draw.map_sampler);
  const auto coordinate_limit = [](int size) { return std::min(0x1p40, 0x1p30 / size * (1 - 0x1p-24)); };
  ranges.check(draw.indexing_map, {std::min(map_limit, coordinate_limit(texture.width())),
                                   std::min(map_limit, coordinate_limit(texture.height())), map_limit, map_limit});
  validate_lookup_range(list, uv_most, draw, n, *list.images[draw.indexing_map]);
}

void validate_list(const DrawList& list, const Frame& frame, bool images_known_good) {
  validate(frame);
  const UvMaxima uv_most = validate_vertices(list, frame);
  validate_triangles(list);
  std::uint64_t next = 0;
  ImageRanges ranges(list, images_known_good);
  for (std::size_t n = 0; n < list.draws.size(); ++n) {
    if (list.draws[n].first_triangle != next)
      refuse(fmt::format("draw {}: expected to begin at triangle {}, got {}", n, next, list.draws[n].first_triangle));
    next += list.draws[n].triangle_count;
    if (next > list.triangles.size()) refuse(fmt::format("draw {}: ends at triangle {} of {}", n, next, list.triangles.size()));
    validate_draw(list, uv_most, n, ranges);
  }
  if (next != list.triangles.size()) refuse(fmt::format("the draws end at triangle {} of {}", next, list.triangles.size()));
  if (list.triangles.size() >= kNoTriangle) refuse("more than 2^32 - 2 triangles");
  if (!list.source_faces.empty() && list.source_faces.size() != list.triangles.size())
    refuse(fmt::format("source faces: expected none or {}, got {}", list.triangles.size(), list.source_faces.size()));
}

}  // namespace

void validate(const DrawList& list, const Frame& frame) { validate_list(list, frame, false); }

void validate_geometry(const DrawList& list, const Frame& frame) { validate_list(list, frame, true); }

}  // namespace etalon
