#include "raster/sample_values.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "raster/lookup.h"
#include "raster/sample_numbers.h"

namespace etalon::raster {
namespace {

template <class T>
void put(T value, std::byte* at) {
  std::memcpy(at, &value, sizeof value);
}

ChannelStore channel_store(const TargetSpec& target, int channel, const Frame& frame) {
  return {target.format.type, channel == 3, frame.state.half_rounding};
}

std::byte* channel_at(std::byte* texel, const TargetSpec& target, int channel) {
  return texel + channel * bytes_per_channel(target.format.type);
}

void store_attribute(SampleNumbers& numbers, Attribute a, const ChannelStore& store, std::byte* out) {
  ++numbers.counters.values;
  if (!numbers.exact_only && store.try_store(numbers.enclose_attribute(a), out)) return;
  ++numbers.counters.exact_path;
  with_limbs(numbers.setup.scalar_limbs(a), [&]<int kLimbs>() { store.store_exact(numbers.quotient<kLimbs>(a), out); });
}

void store_barycentric(SampleNumbers& numbers, int vertex, const ChannelStore& store, std::byte* out) {
  ++numbers.counters.values;
  if (!numbers.exact_only && store.try_store(numbers.enclose_barycentric(vertex), out)) return;
  ++numbers.counters.exact_path;
  with_limbs(numbers.setup.scalar_limbs(kDepth), [&]<int kLimbs>() { store.store_exact(numbers.barycentric<kLimbs>(vertex), out); });
}

void store_color(SampleNumbers& numbers, const DrawList& list, const Draw& draw, const TargetSpec& target, const Frame& frame,
                 std::byte* texel) {
  if (draw.shading == Shading::vertex_color) {
    for (int c = 0; c < target.format.channels; ++c)
      store_attribute(numbers, static_cast<Attribute>(kRed + c), channel_store(target, c, frame), channel_at(texel, target, c));
    return;
  }
  const Image& texture = *list.images[draw.texture];
  const auto store_all = [&](const auto& coordinate) {
    Lookup lookup(texture, draw.sampler, numbers.exact_only, numbers.counters);
    lookup.find(coordinate);
    if (lookup.copies(target)) return lookup.copy(texel, target);
    for (int c = 0; c < target.format.channels; ++c)
      lookup.store(coordinate, c, channel_store(target, c, frame), channel_at(texel, target, c));
  };
  const TriangleCoordinate at_uv{numbers};
  if (draw.shading == Shading::texture) return store_all(at_uv);
  Lookup map(*list.images[draw.indexing_map], draw.map_sampler, numbers.exact_only, numbers.counters);
  map.find(at_uv);
  store_all(StoredCoordinate{{map.as_coordinate(at_uv, 0), map.as_coordinate(at_uv, 1)}});
}

// Distance of the sample to edge k in sub-texels, E / √(dx² + dy²), rounded once.
float edge_distance(const SampleNumbers& numbers, int k) {
  const Edges& edges = numbers.setup.edges;
  const __int128 dx = edges.dx[k], dy = edges.dy[k];
  const __int128 length_squared = dx * dx + dy * dy;
  const auto e = static_cast<__int128>(numbers.e[k]);
  if (e == 0) return 0;
  // Two conversions, √ and ÷: below 4·2^-53 relative.
  const double distance = static_cast<double>(e) / std::sqrt(static_cast<double>(length_squared));
  const float lo = static_cast<float>(distance * (1 - 0x1p-50)), hi = static_cast<float>(distance * (1 + 0x1p-50));
  if (lo == hi) return lo;
  // E/√L against the middle t = m·2^x of two neighbouring floats, m an integer of 26 bits: E² against m²·L·2^2x.
  const TexelValue below = exact_number(lo), above = exact_number(hi);
  const int scale = std::min(below.e, above.e);
  const WideInt<8> e_wide(e), m((below.m << (below.e - scale)) + (above.m << (above.e - scale)));
  const int side = compare(Quotient<8>{e_wide * e_wide, m * m * WideInt<8>(length_squared), 2 * (scale - 1)}, 1.0);
  if (side != 0) return side < 0 ? lo : hi;
  return (std::bit_cast<std::uint32_t>(lo) & 1) == 0 ? lo : hi;
}

void store_margins(SampleNumbers& numbers, const DrawList& list, const Draw& draw, SampleDepth depth, std::byte* texel) {
  const float edge = std::min({edge_distance(numbers, 0), edge_distance(numbers, 1), edge_distance(numbers, 2)});
  float u = std::numeric_limits<float>::infinity(), v = u;
  if (draw.shading != Shading::vertex_color) {
    const bool indexed = draw.shading == Shading::indexed;
    const Image& image = *list.images[indexed ? draw.indexing_map : draw.texture];
    const bool linear = (indexed ? draw.map_sampler : draw.sampler).filter == Filter::linear;
    const TriangleCoordinate at_uv{numbers};
    u = border_distance(at_uv, 0, image.width(), linear);
    v = border_distance(at_uv, 1, image.height(), linear);
  }
  const std::array<float, 4> values = {edge, u, v, depth.gap};
  std::memcpy(texel, values.data(), sizeof values);
}

void store_bound_terms(SampleNumbers& numbers, const DrawList& list, const Draw& draw, std::byte* texel) {
  float uv = 0;
  if (draw.shading != Shading::vertex_color) {
    const Image& image = *list.images[draw.shading == Shading::indexed ? draw.indexing_map : draw.texture];
    with_limbs(numbers.setup.gradient_limbs(), [&]<int kLimbs>() {
      uv = std::max(numbers.gradient<kLimbs>(kU, image.width()), numbers.gradient<kLimbs>(kV, image.height()));
    });
  }
  const std::array<float, 2> values = {uv, numbers.depth_gradient()};
  std::memcpy(texel, values.data(), sizeof values);
}

}  // namespace

void store_target(const DrawList& list, const Draw& draw, const Frame& frame, const TargetSpec& target, const TriangleSetup& setup,
                  std::uint32_t triangle, int i, int j, SampleDepth depth, Evaluation evaluation, std::byte* texel,
                  EvaluationCounters& counters) {
  SampleNumbers numbers(setup, i, j, evaluation == Evaluation::exact, counters);
  switch (target.content) {
    case TargetContent::color: store_color(numbers, list, draw, target, frame, texel); break;
    case TargetContent::triangle_id: put(triangle, texel); break;
    case TargetContent::barycentrics:
      for (int c = 0; c < 3; ++c) store_barycentric(numbers, c, channel_store(target, c, frame), channel_at(texel, target, c));
      break;
    case TargetContent::coordinate:
      for (int c = 0; c < 2; ++c)
        store_attribute(numbers, static_cast<Attribute>(kU + c), channel_store(target, c, frame), channel_at(texel, target, c));
      break;
    case TargetContent::depth: put(depth.stored, texel); break;
    case TargetContent::margins: store_margins(numbers, list, draw, depth, texel); break;
    case TargetContent::bound_terms: store_bound_terms(numbers, list, draw, texel); break;
  }
}

void store_sample(const DrawList& list, const Draw& draw, const Frame& frame, const TriangleSetup& setup, std::uint32_t triangle, int i,
                  int j, SampleDepth depth, Evaluation evaluation, std::byte* const* texels, EvaluationCounters& counters) {
  for (std::size_t n = 0; n < frame.targets.size(); ++n)
    store_target(list, draw, frame, frame.targets[n], setup, triangle, i, j, depth, evaluation, texels[n], counters);
}

void store_clear(const Frame& frame, std::byte* const* texels) {
  for (std::size_t n = 0; n < frame.targets.size(); ++n) {
    const TargetSpec& target = frame.targets[n];
    switch (target.content) {
      case TargetContent::triangle_id: put(kNoTriangle, texels[n]); break;
      case TargetContent::depth: put(1.0f, texels[n]); break;
      case TargetContent::margins:
      case TargetContent::bound_terms: std::memset(texels[n], 0, static_cast<std::size_t>(bytes_per_texel(target.format))); break;
      default:
        for (int c = 0; c < target.format.channels; ++c)
          channel_store(target, c, frame).store(exact_number(target.clear[static_cast<std::size_t>(c)]), channel_at(texels[n], target, c));
    }
  }
}

}  // namespace etalon::raster
