#include "validation/selftest/scene_parts.h"

#include <algorithm>
#include <utility>

#include "core/base/error.h"

namespace etalon::validation {
namespace {

// Finite, of at most 1.25 in magnitude where positive and ¼ where negative, as the float32 texels are.
std::uint16_t random_half(Rng& rng) {
  const bool negative = rng.below(6) == 0;
  const std::uint64_t largest = negative ? 0x3400 : 0x3D00;
  return static_cast<std::uint16_t>(rng.below(largest + 1) | (negative ? 0x8000u : 0u));
}

void fill_channel(Image& image, int x, int y, int c, Rng& rng) {
  switch (image.format().type) {
    case ChannelType::unorm8:
    case ChannelType::srgb8: image.channels<std::uint8_t>(x, y)[c] = static_cast<std::uint8_t>(rng.below(256)); break;
    case ChannelType::unorm16: image.channels<std::uint16_t>(x, y)[c] = static_cast<std::uint16_t>(rng.below(65536)); break;
    case ChannelType::half: image.channels<std::uint16_t>(x, y)[c] = random_half(rng); break;
    case ChannelType::float32: image.channels<float>(x, y)[c] = rng.uniform(-0.25f, 1.25f); break;
    case ChannelType::uint32: image.channels<std::uint32_t>(x, y)[c] = static_cast<std::uint32_t>(rng.next()); break;
  }
}

// 2^e for e in [-126, 127], without libm.
float power_of_two(int e) {
  float result = 1;
  for (; e > 0; --e) result *= 2;
  for (; e < 0; ++e) result /= 2;
  return result;
}

std::int32_t random_position(Rng& rng, int size_texel, const Frame& frame, const VertexRange& range) {
  const int bits = frame.state.subtexel_bits;
  const std::int64_t reach = std::int64_t{std::min(range.reach_texel, frame.guard)} << bits;
  const std::int64_t position = rng.between(-reach, (std::int64_t{size_texel} << bits) + reach);
  const std::int64_t step = range.on_lattice ? std::int64_t{1} << (bits - 1) : 1;
  return static_cast<std::int32_t>(position / step * step);
}

float random_w(Rng& rng, VertexRange::W kind, float equal_w) {
  switch (kind) {
    case VertexRange::W::one: return 1;
    case VertexRange::W::equal: return equal_w;
    case VertexRange::W::perspective: return rng.uniform(0.25f, 4);
    case VertexRange::W::mixed: return rng.coin() ? 1.0f : rng.uniform(0.25f, 4);
    case VertexRange::W::wild: break;
  }
  const int exponent = static_cast<int>(rng.between(-20, 19));
  return power_of_two(exponent) * rng.uniform(1, 2);
}

}  // namespace

std::shared_ptr<const Image> noise_image(int width, int height, PixelFormat format, Rng& rng) {
  auto image = std::make_shared<Image>(width, height, format);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < format.channels; ++c) fill_channel(*image, x, y, c, rng);
  return image;
}

RasterVertex random_vertex(Rng& rng, const Frame& frame, const VertexRange& range, float equal_w) {
  RasterVertex vertex;
  vertex.x = random_position(rng, frame.width, frame, range);
  vertex.y = random_position(rng, frame.height, frame, range);
  vertex.z = rng.uniform(0, 1);
  vertex.w = random_w(rng, range.w, equal_w);
  // Braces: between parentheses compilers choose the order of the calls.
  vertex.uv = Vec2f{rng.uniform(range.uv_low, range.uv_high), rng.uniform(range.uv_low, range.uv_high)};
  const auto color = [&] { return rng.uniform(range.color_low, range.color_high); };
  vertex.color = Vec4f{color(), color(), color(), color()};
  return vertex;
}

Draw& open_draw(DrawList& list, Shading shading) {
  list.draws.push_back({.first_triangle = static_cast<std::uint32_t>(list.triangles.size()), .triangle_count = 0, .shading = shading});
  return list.draws.back();
}

void add_triangle(DrawList& list, const RasterVertex& a, const RasterVertex& b, const RasterVertex& c) {
  const auto first = static_cast<std::uint32_t>(list.vertices.size());
  list.vertices.insert(list.vertices.end(), {a, b, c});
  list.triangles.push_back({first, first + 1, first + 2});
  ++list.draws.back().triangle_count;
}

void add_rectangle(DrawList& list, const std::array<RasterVertex, 4>& corners) {
  const auto first = static_cast<std::uint32_t>(list.vertices.size());
  list.vertices.insert(list.vertices.end(), corners.begin(), corners.end());
  list.triangles.push_back({first, first + 1, first + 2});
  list.triangles.push_back({first, first + 2, first + 3});
  list.draws.back().triangle_count += 2;
}

void add_random_triangles(DrawList& list, Rng& rng, const Frame& frame, const VertexRange& range, int count) {
  for (int t = 0; t < count; ++t) {
    const float equal_w = rng.uniform(0.25f, 4);
    const RasterVertex a = random_vertex(rng, frame, range, equal_w);
    const RasterVertex b = random_vertex(rng, frame, range, equal_w);
    const RasterVertex c = random_vertex(rng, frame, range, equal_w);
    add_triangle(list, a, b, c);
  }
}

void add_cover(DrawList& list, Rng& rng, const Frame& frame, const VertexRange& range) {
  const float equal_w = rng.uniform(0.25f, 4);
  std::array<RasterVertex, 4> corners;
  const int reach = std::min(range.reach_texel, frame.guard);
  for (std::size_t k = 0; k < 4; ++k) {
    corners[k] = random_vertex(rng, frame, range, equal_w);
    corners[k].x = subtexels(k == 0 || k == 3 ? -reach : frame.width + reach, frame);
    corners[k].y = subtexels(k < 2 ? -reach : frame.height + reach, frame);
  }
  add_rectangle(list, corners);
}

std::int32_t subtexels(double x_texel, const Frame& frame) {
  const double scaled = x_texel * static_cast<double>(std::int64_t{1} << frame.state.subtexel_bits);
  const auto result = static_cast<std::int32_t>(scaled);
  ETALON_CHECK(static_cast<double>(result) == scaled, std::to_string(x_texel) + " texels are no whole number of sub-texels");
  return result;
}

std::uint32_t add_image(DrawList& list, std::shared_ptr<const Image> image) {
  list.images.push_back(std::move(image));
  return static_cast<std::uint32_t>(list.images.size() - 1);
}

Sampler random_sampler(Rng& rng, Filter filter) {
  return Sampler{filter, static_cast<Wrap>(rng.below(3)), static_cast<Wrap>(rng.below(3))};
}

Sampler random_sampler(Rng& rng) {
  const Filter filter = rng.coin() ? Filter::linear : Filter::nearest;
  return random_sampler(rng, filter);
}

std::vector<TargetSpec> all_targets() {
  std::vector<TargetSpec> targets;
  for (const PixelFormat format :
       {PixelFormat{ChannelType::unorm8, 4}, PixelFormat{ChannelType::srgb8, 4}, PixelFormat{ChannelType::unorm16, 3},
        PixelFormat{ChannelType::half, 4}, PixelFormat{ChannelType::float32, 2}, PixelFormat{ChannelType::unorm8, 1}})
    targets.push_back({TargetContent::color, format, {0.25f, 0.5f, 0.75f, 1}});
  targets.push_back({TargetContent::triangle_id, kR32ui});
  targets.push_back({TargetContent::barycentrics, {ChannelType::float32, 3}});
  targets.push_back({TargetContent::barycentrics, {ChannelType::half, 3}});
  targets.push_back({TargetContent::coordinate, kRg32f});
  targets.push_back({TargetContent::coordinate, {ChannelType::unorm16, 2}});
  targets.push_back({TargetContent::depth, kR32f});
  targets.push_back({TargetContent::margins, kRgba32f});
  targets.push_back({TargetContent::bound_terms, kRg32f});
  return targets;
}

}  // namespace etalon::validation
