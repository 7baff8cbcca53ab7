#include "validation/joint/coordinate_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/draw/scene.h"

namespace etalon::validation {
namespace {

constexpr int kWeightBits = 24;
constexpr std::size_t kBlock = 8192;

struct Axis {
  std::uint32_t texel;
  double weight;  ///< of the second texel
};

// x = a·n − ½ is exact in double: a has 24 bits, n at most 15, and where x is not clamped a·n >= ½, so that x has no bit below 2^-40.
double lookup_place(float a, int size) { return static_cast<double>(a) * size - 0.5; }

// Clamping makes both texels one: as well the inner pair with all weight on it.
Axis lookup_axis(float a, int size) {
  const double x = lookup_place(a, size);
  if (!(x > 0)) return {0, 0};
  if (x >= size - 1) return {static_cast<std::uint32_t>(size - 2), 1};
  const auto below = static_cast<std::int32_t>(x);
  return {static_cast<std::uint32_t>(below), x - below};
}

struct Weight {
  std::int64_t value;  ///< in multiples of 2^-24
  bool is_rounded;
};
Weight rounded_weight(const Axis& axis) {
  const double scaled = axis.weight * (1u << kWeightBits), value = std::nearbyint(scaled);
  return {static_cast<std::int64_t>(value), value != scaled};
}

// Nearest, ties to even.
std::uint8_t rounded_sum(std::int64_t sum) {
  constexpr std::int64_t kHalf = std::int64_t{1} << (2 * kWeightBits - 1);
  return static_cast<std::uint8_t>((sum + kHalf - 1 + ((sum >> (2 * kWeightBits)) & 1)) >> (2 * kWeightBits));
}

// Where a rounded weight leaves it open: the same in multiples of 2^-80.
std::uint8_t exact_value(float u, float v, int width, int height, const std::array<int, 4>& texels) {
  __extension__ using Int128 = __int128;
  constexpr int kBits = 40;
  const auto weight = [](float a, int size) -> std::int64_t {
    const double x = lookup_place(a, size);
    if (!(x > 0)) return 0;
    if (x >= size - 1) return std::int64_t{1} << kBits;
    return static_cast<std::int64_t>((x - std::floor(x)) * static_cast<double>(std::int64_t{1} << kBits));
  };
  const Int128 one = Int128{1} << kBits, fx = weight(u, width), fy = weight(v, height);
  const Int128 low = texels[0] * (one - fx) + texels[1] * fx, high = texels[2] * (one - fx) + texels[3] * fx;
  const Int128 sum = low * (one - fy) + high * fy, half = Int128{1} << (2 * kBits - 1);
  return static_cast<std::uint8_t>((sum + half - 1 + ((sum >> (2 * kBits)) & 1)) >> (2 * kBits));
}

}  // namespace

DrawnCoordinates draw_coordinates(Renderer& renderer, const Mesh& mesh, const PictureFrame& picture) {
  Frame frame{.width = picture.width, .height = picture.height, .guard = 2048, .state = {}, .targets = {}};
  frame.targets = {{TargetContent::coordinate, kRg32f, {}}, {TargetContent::triangle_id, kR32ui, {}}};
  frame.state = renderer.supported_state(frame.state);
  std::vector<Image> images = renderer.render(make_scene(mesh, {Material{}}, picture.camera, frame), frame);
  return {std::make_shared<const Image>(std::move(images[0])), std::move(images[1])};
}

void hide_what_both_show(DrawnCoordinates& one, DrawnCoordinates& other) {
  const std::size_t texels = one.ids.texel_count();
  ETALON_CHECK(texels == other.ids.texel_count(), fmt::format("{} and {} texels", texels, other.ids.texel_count()));
  auto *const id = one.ids.channels<std::uint32_t>(0, 0), *const other_id = other.ids.channels<std::uint32_t>(0, 0);
  const auto *const uv = one.coordinates->channels<float>(0, 0), *const other_uv = other.coordinates->channels<float>(0, 0);
  parallel_for_blocks(texels, kBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      if (id[n] == kNoTriangle || other_id[n] == kNoTriangle || std::memcmp(uv + 2 * n, other_uv + 2 * n, 2 * sizeof(float)) != 0) continue;
      id[n] = other_id[n] = kNoTriangle;
    }
  });
}

LookupPass lookup_pass(const Renderer& renderer, std::shared_ptr<const Image> texture, std::shared_ptr<const Image> coordinates) {
  LookupPass pass;
  pass.frame = Frame{.width = coordinates->width(), .height = coordinates->height(), .guard = 2048, .state = {}, .targets = {}};
  pass.frame.targets = {{TargetContent::color, kRgba8, {}}};
  pass.frame.state.depth_test = false;
  pass.frame.state = renderer.supported_state(pass.frame.state);
  for (int corner = 0; corner < 4; ++corner) {
    const int right = corner & 1, up = corner >> 1;
    RasterVertex vertex;
    vertex.x = snap(right * pass.frame.width, pass.frame.state), vertex.y = snap(up * pass.frame.height, pass.frame.state);
    vertex.uv = {static_cast<float>(right), static_cast<float>(up)};
    pass.list.vertices.push_back(vertex);
  }
  pass.list.triangles = {{0, 1, 3}, {0, 3, 2}};
  const Sampler nearest{Filter::nearest, Wrap::clamp, Wrap::clamp}, linear{Filter::linear, Wrap::clamp, Wrap::clamp};
  pass.list.draws = {{.first_triangle = 0,
                      .triangle_count = 2,
                      .shading = Shading::indexed,
                      .texture = 0,
                      .sampler = linear,
                      .indexing_map = 1,
                      .map_sampler = nearest}};
  pass.list.images = {std::move(texture), std::move(coordinates)};
  return pass;
}

Image draw_in_two_passes(Renderer& renderer, const Mesh& mesh, std::shared_ptr<const Image> texture, const PictureFrame& frame) {
  DrawnCoordinates drawn = draw_coordinates(renderer, mesh, frame);
  const LookupPass pass = lookup_pass(renderer, std::move(texture), drawn.coordinates);
  Image picture = std::move(renderer.render(pass.list, pass.frame).front());
  for (int y = 0; y < frame.height; ++y)
    for (int x = 0; x < frame.width; ++x)
      if (*drawn.ids.channels<std::uint32_t>(x, y) == kNoTriangle) std::fill_n(picture.texel(x, y), 4, std::byte{0});
  return picture;
}

CoordinatePicture::CoordinatePicture(DrawnCoordinates drawn, int texture_width, int texture_height)
    : coordinates_(std::move(drawn.coordinates)), texture_width_(texture_width), texture_height_(texture_height) {
  if (texture_width < 2 || texture_height < 2)
    throw InputError(fmt::format("texture: expected at least 2x2 texels, got {}x{}", texture_width, texture_height));
  const auto* uv = coordinates_->channels<float>(0, 0);
  const auto* ids = drawn.ids.channels<std::uint32_t>(0, 0);
  const std::size_t texels = coordinates_->texel_count(), blocks = texels / kBlock + 1;
  std::vector<std::size_t> starts(blocks + 1);  // covered texels before each block
  parallel_for_blocks(texels, kBlock, [&](std::size_t begin, std::size_t end) {
    starts[begin / kBlock + 1] =
        static_cast<std::size_t>(std::count_if(ids + begin, ids + end, [](std::uint32_t id) { return id != kNoTriangle; }));
  });
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  at_.resize(starts.back()), texel_.resize(starts.back()), fx_.resize(starts.back()), fy_.resize(starts.back());
  parallel_for_blocks(texels, kBlock, [&](std::size_t begin, std::size_t end) {
    std::size_t to = starts[begin / kBlock];
    for (std::size_t n = begin; n < end; ++n) {
      if (ids[n] == kNoTriangle) continue;
      const Axis x = lookup_axis(uv[2 * n], texture_width), y = lookup_axis(uv[2 * n + 1], texture_height);
      at_[to] = static_cast<std::uint32_t>(n);
      texel_[to] = y.texel * static_cast<std::uint32_t>(texture_width) + x.texel;
      fx_[to] = static_cast<float>(x.weight), fy_[to] = static_cast<float>(y.weight);
      ++to;
    }
  });
}

// Lookup n in integers.
std::array<std::uint8_t, 3> CoordinatePicture::color(const std::uint8_t* texels, std::size_t n) const {
  constexpr std::int64_t kFraction = (std::int64_t{1} << (2 * kWeightBits)) - 1, kHalf = (kFraction + 1) / 2;
  // Two weights off by at most 2^-25 each, values to 255: the sum is off by less than 2^-16; where half is nearer than that it is left open.
  constexpr std::int64_t kOpen = (kFraction + 1) >> 16;
  const auto* const uv = coordinates_->channels<float>(0, 0) + 2 * std::size_t{at_[n]};
  const Weight x = rounded_weight(lookup_axis(uv[0], texture_width_)), y = rounded_weight(lookup_axis(uv[1], texture_height_));
  const std::uint8_t* const low = texels + 4 * std::size_t{texel_[n]};
  const std::uint8_t* const high = low + 4 * static_cast<std::size_t>(texture_width_);
  std::array<std::uint8_t, 3> color;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::int64_t a = (std::int64_t{low[c]} << kWeightBits) + x.value * (low[c + 4] - low[c]);
    const std::int64_t b = (std::int64_t{high[c]} << kWeightBits) + x.value * (high[c + 4] - high[c]);
    const std::int64_t sum = (a << kWeightBits) + y.value * (b - a);
    color[c] = rounded_sum(sum);
    const std::int64_t beyond_half = (sum & kFraction) - kHalf;
    if ((x.is_rounded || y.is_rounded) && beyond_half <= kOpen && beyond_half >= -kOpen) [[unlikely]]
      color[c] = exact_value(uv[0], uv[1], texture_width_, texture_height_, {low[c], low[c + 4], high[c], high[c + 4]});
  }
  return color;
}

void CoordinatePicture::require_texture(const Image& texture) const {
  ETALON_CHECK(texture.format() == kRgba8 && texture.width() == texture_width_ && texture.height() == texture_height_,
               fmt::format("{}x{}", texture.width(), texture.height()));
}

Image CoordinatePicture::picture(const Image& texture) const {
  require_texture(texture);
  Image picture(coordinates_->width(), coordinates_->height(), kRgba8);
  const auto* const texels = texture.channels<std::uint8_t>(0, 0);
  auto* const out = picture.channels<std::uint8_t>(0, 0);
  parallel_for_blocks(at_.size(), kBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      std::uint8_t* const texel = out + 4 * std::size_t{at_[n]};
      std::ranges::copy(color(texels, n), texel);
      texel[3] = 255;
    }
  });
  return picture;
}

Image opaque_rgba(const Image& image) {
  const PixelFormat format = image.format();
  if ((format.type != ChannelType::unorm8 && format.type != ChannelType::srgb8) || image.empty())
    throw InputError("texture: expected channels of 8 bits");
  Image result(image.width(), image.height(), kRgba8);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const auto* from = image.channels<std::uint8_t>(x, y);
      auto* to = result.channels<std::uint8_t>(x, y);
      const bool is_grey = format.channels < 3;
      to[0] = from[0], to[1] = from[is_grey ? 0 : 1], to[2] = from[is_grey ? 0 : 2], to[3] = 255;
    }
  return result;
}

Image without_alpha(const Image& picture) {
  ETALON_CHECK(picture.format() == kRgba8, to_string(picture.format()));
  Image rgb(picture.width(), picture.height(), kRgb8);
  for (int y = 0; y < rgb.height(); ++y)
    for (int x = 0; x < rgb.width(); ++x) std::copy_n(picture.texel(x, y), 3, rgb.texel(x, y));
  return rgb;
}

}  // namespace etalon::validation
