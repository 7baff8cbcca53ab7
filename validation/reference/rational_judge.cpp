#include "validation/reference/rational_judge.h"

#include <array>
#include <cstring>
#include <limits>

#include "validation/reference/rational.h"
#include "validation/reference/srgb_table.h"
#include "validation/reference/stored_number.h"

namespace etalon::validation::reference {

namespace {

using Q = BigRational;
using Color = std::array<Q, 4>;

Q input(float value) { return rational_of_float32(as_input(value)); }

// A linear function of the position in sub-texels: at(x, y) = c + gx·x + gy·y.
struct LinearFunction {
  Q c, gx, gy;
  [[nodiscard]] Q at(const Q& x, const Q& y) const { return c + gx * x + gy * y; }
};

// E = dx·(py − a.y) − dy·(px − a.x) as a function of (px, py).
LinearFunction edge_function(const RasterVertex& a, const RasterVertex& b) {
  const Q dx = Q(b.x) - a.x, dy = Q(b.y) - a.y;
  return {dy * a.x - dx * a.y, -dy, dx};
}

// A vertex and the function of the edge opposite to it, for a triangle in counter-clockwise order.
struct Corner {
  const RasterVertex* vertex;
  LinearFunction opposite;
};

int wrapped_index(const Q& index, int n, Wrap wrap) {
  const auto i = numerator(index).convert_to<long long>();
  if (wrap == Wrap::clamp) return static_cast<int>(i < 0 ? 0 : i > n - 1 ? n - 1 : i);
  if (wrap == Wrap::repeat) {
    const Q times = floor_of(index / n);
    return numerator(index - times * n).convert_to<int>();
  }
  // Mirrored: the image and its mirror image side by side, repeated.
  const Q times = floor_of(index / (2 * n));
  const int k = numerator(index - times * (2 * n)).convert_to<int>();
  return k < n ? k : 2 * n - 1 - k;
}

Color texel(const Image& image, int x, int y, bool filtered) {
  Color color{0, 0, 0, 1};
  for (int c = 0; c < image.format().channels; ++c) {
    Q& value = color[static_cast<std::size_t>(c)];
    switch (image.format().type) {
      case ChannelType::unorm8: value = Q(image.channels<std::uint8_t>(x, y)[c], 255); break;
      case ChannelType::unorm16: value = Q(image.channels<std::uint16_t>(x, y)[c], 65535); break;
      case ChannelType::srgb8: {
        const int stored = image.channels<std::uint8_t>(x, y)[c];
        value = c == 3 ? Q(stored, 255) : rational_of_float32(srgb_decode()[static_cast<std::size_t>(stored)]);
        break;
      }
      case ChannelType::half: value = rational_of_half(image.channels<std::uint16_t>(x, y)[c]); break;
      case ChannelType::float32: value = rational_of_float32(image.channels<float>(x, y)[c]); break;
      case ChannelType::uint32: throw_check_failed(__FILE__, __LINE__, "a texture holds numbers", to_string(image.format()));
    }
    if (filtered && abs(value) < Q(1, 1LL << 40)) value = 0;
  }
  return color;
}

Color sampled(const Image& image, const Sampler& sampler, const Q& u, const Q& v) {
  const int width = image.width(), height = image.height();
  if (sampler.filter == Filter::nearest)
    return texel(image, wrapped_index(floor_of(u * width), width, sampler.wrap_u),
                 wrapped_index(floor_of(v * height), height, sampler.wrap_v), false);
  const Q x = u * width - Q(1, 2), y = v * height - Q(1, 2);
  const Q i0 = floor_of(x), j0 = floor_of(y), f = x - i0, g = y - j0;
  const int x0 = wrapped_index(i0, width, sampler.wrap_u), x1 = wrapped_index(i0 + 1, width, sampler.wrap_u);
  const int y0 = wrapped_index(j0, height, sampler.wrap_v), y1 = wrapped_index(j0 + 1, height, sampler.wrap_v);
  const Color t00 = texel(image, x0, y0, true), t10 = texel(image, x1, y0, true);
  const Color t01 = texel(image, x0, y1, true), t11 = texel(image, x1, y1, true);
  Color value;
  for (std::size_t c = 0; c < 4; ++c) value[c] = (1 - f) * (1 - g) * t00[c] + f * (1 - g) * t10[c] + (1 - f) * g * t01[c] + f * g * t11[c];
  return value;
}

class RationalJudge final : public TriangleJudge {
 public:
  RationalJudge(const DrawList& list, const Frame& frame, std::uint32_t t) : list_(list), state_(frame.state), t_(t) {
    const RasterVertex* v[3];
    for (std::size_t k = 0; k < 3; ++k) v[k] = &list.vertices[list.triangles[t][k]];
    area_ = edge_function(*v[0], *v[1]).at(v[2]->x, v[2]->y);
    if (area_ < 0) std::swap(v[1], v[2]);
    for (std::size_t k = 0; k < 3; ++k) corners_[k] = {v[k], edge_function(*v[(k + 1) % 3], *v[(k + 2) % 3])};
  }

  SampleVerdict verdict(int i, int j) const override {
    if (area_ == 0) return {};
    const auto [x, y] = sample(i, j);
    bool owned = true, on_edge = false;
    for (const Corner& corner : corners_) {
      const Q e = corner.opposite.at(x, y);
      if (e < 0) return {};
      if (e > 0) continue;
      on_edge = true;
      const auto dx = numerator(corner.opposite.gy).convert_to<long long>(), dy = -numerator(corner.opposite.gx).convert_to<long long>();
      owned = owned && owns_edge(state_.fill_rule, dx, dy);
    }
    const bool culled = (state_.cull == CullMode::clockwise && area_ < 0) || (state_.cull == CullMode::counter_clockwise && area_ > 0);
    if (!owned || culled) return {false, on_edge, 1};
    return {true, on_edge, nearest_float32(depth(x, y))};
  }

  void store(int i, int j, const std::vector<TargetSpec>& targets, std::optional<float> runner_up_depth, TexelBytes* bytes) const override {
    const auto [x, y] = sample(i, j);
    for (const TargetSpec& target : targets) *bytes++ = stored(target, x, y, runner_up_depth);
  }

 private:
  // A number of the texel's centre, in sub-texels.
  [[nodiscard]] std::pair<Q, Q> sample(int i, int j) const {
    const Q texel_size(1 << state_.subtexel_bits);
    return {(i + Q(1, 2)) * texel_size, (j + Q(1, 2)) * texel_size};
  }

  // Perspective-correct: the linear functions Σ E_i·a_i/w_i and Σ E_i/w_i, which are those of the contract divided by w_0·w_1·w_2.
  template <class Attribute>
  [[nodiscard]] LinearFunction over_w(Attribute attribute) const {
    LinearFunction sum{0, 0, 0};
    for (const Corner& corner : corners_) {
      const Q scale = attribute(corner) / rational_of_float32(corner.vertex->w);
      sum = {sum.c + corner.opposite.c * scale, sum.gx + corner.opposite.gx * scale, sum.gy + corner.opposite.gy * scale};
    }
    return sum;
  }
  [[nodiscard]] LinearFunction one_over_w() const {
    return over_w([](const Corner&) { return Q(1); });
  }
  template <class Attribute>
  [[nodiscard]] Q perspective(const Q& x, const Q& y, Attribute attribute) const {
    return over_w(attribute).at(x, y) / one_over_w().at(x, y);
  }
  [[nodiscard]] Q coordinate(const Q& x, const Q& y, int axis) const {
    return perspective(x, y, [axis](const Corner& corner) { return input(corner.vertex->uv[axis]); });
  }
  // A quotient's derivative: (n / d)' = (n' − (n / d)·d') / d.
  [[nodiscard]] Q coordinate_slopes(const Q& x, const Q& y, int axis) const {
    const LinearFunction n = over_w([axis](const Corner&corner) { return input(corner.vertex->uv[axis]); }), d = one_over_w();
    const Q value = n.at(x, y) / d.at(x, y);
    return abs(Q((n.gx - value * d.gx) / d.at(x, y))) + abs(Q((n.gy - value * d.gy) / d.at(x, y)));
  }

  [[nodiscard]] Q depth(const Q& x, const Q& y) const {
    Q n = 0, d = 0;
    for (const Corner& corner : corners_) {
      const Q e = corner.opposite.at(x, y);
      n += e * input(corner.vertex->z);
      d += e;
    }
    return n / d;
  }
  // Depth is linear, Σ E_i being constant: twice the area.
  [[nodiscard]] Q depth_slopes() const {
    Q gx = 0, gy = 0;
    for (const Corner& corner : corners_) {
      gx += corner.opposite.gx * input(corner.vertex->z);
      gy += corner.opposite.gy * input(corner.vertex->z);
    }
    return (abs(gx) + abs(gy)) / abs(area_);
  }

  [[nodiscard]] Color color(const Q& x, const Q& y) const {
    const Draw& draw = draw_holding(list_, t_);
    if (draw.shading == Shading::vertex_color) {
      Color value;
      for (int c = 0; c < 4; ++c)
        value[static_cast<std::size_t>(c)] = perspective(x, y, [c](const Corner& corner) { return input(corner.vertex->color[c]); });
      return value;
    }
    Q u = coordinate(x, y, 0), v = coordinate(x, y, 1);
    if (draw.shading == Shading::indexed) {
      const Color found = sampled(*list_.images[draw.indexing_map], draw.map_sampler, u, v);
      u = found[0], v = found[1];
      if (draw.map_sampler.filter == Filter::linear) u = input(nearest_float32(u)), v = input(nearest_float32(v));
    }
    return sampled(*list_.images[draw.texture], draw.sampler, u, v);
  }

  [[nodiscard]] Color weights(const Q& x, const Q& y) const {
    Color b;
    for (std::size_t k = 0; k < 3; ++k) {
      const RasterVertex* mine = &list_.vertices[list_.triangles[t_][k]];
      // Positions identify a corner: a triangle with area has three different ones.
      b[k] =
          perspective(x, y, [mine](const Corner& corner) { return Q(corner.vertex->x == mine->x && corner.vertex->y == mine->y ? 1 : 0); });
    }
    return b;
  }

  [[nodiscard]] std::array<float, 4> margins(const Q& x, const Q& y, std::optional<float> runner_up_depth) const {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    Q nearest_squared = -1;
    for (const Corner& corner : corners_) {
      const Q e = corner.opposite.at(x, y),
              squared = e * e / (corner.opposite.gx * corner.opposite.gx + corner.opposite.gy * corner.opposite.gy);
      if (nearest_squared < 0 || squared < nearest_squared) nearest_squared = squared;
    }
    // √s against y >= 0 is s against y².
    const float edge = nearest_float32([&](const Q& length) { return nearest_squared.compare(length * length); });
    std::array<float, 4> value{edge, kInfinity, kInfinity, kInfinity};
    const FirstLookup lookup = first_lookup(list_, draw_holding(list_, t_));
    if (lookup.image != nullptr) {
      const Q shift = lookup.sampler.filter == Filter::linear ? Q(1, 2) : Q(0);
      for (int axis = 0; axis < 2; ++axis) {
        const Q at = coordinate(x, y, axis) * (axis == 0 ? lookup.image->width() : lookup.image->height()) - shift;
        const Q nearest_integer = floor_of(at + Q(1, 2));
        value[static_cast<std::size_t>(1 + axis)] = nearest_float32(Q(abs(Q(at - nearest_integer))));
      }
    }
    if (runner_up_depth)
      value[3] = nearest_float32(Q(rational_of_float32(*runner_up_depth) - rational_of_float32(nearest_float32(depth(x, y)))));
    return value;
  }

  [[nodiscard]] std::array<float, 2> bound_terms(const Q& x, const Q& y) const {
    const Q texel_size(1 << state_.subtexel_bits);
    const FirstLookup lookup = first_lookup(list_, draw_holding(list_, t_));
    float uv = 0;
    if (lookup.image != nullptr) {
      const Q u = coordinate_slopes(x, y, 0) * lookup.image->width(), v = coordinate_slopes(x, y, 1) * lookup.image->height();
      uv = nearest_float32(Q(texel_size * (u < v ? v : u)));
    }
    return {uv, nearest_float32(Q(depth_slopes() * texel_size))};
  }

  [[nodiscard]] TexelBytes stored(const TargetSpec& target, const Q& x, const Q& y, std::optional<float> runner_up_depth) const {
    TexelBytes bytes{};
    Color value;
    switch (target.content) {
      case TargetContent::triangle_id: std::memcpy(bytes.data(), &t_, 4); return bytes;
      case TargetContent::margins: {
        const auto found = margins(x, y, runner_up_depth);
        std::memcpy(bytes.data(), found.data(), sizeof found);
        return bytes;
      }
      case TargetContent::bound_terms: {
        const auto found = bound_terms(x, y);
        std::memcpy(bytes.data(), found.data(), sizeof found);
        return bytes;
      }
      case TargetContent::color: value = color(x, y); break;
      case TargetContent::barycentrics: value = weights(x, y); break;
      case TargetContent::coordinate: value = {coordinate(x, y, 0), coordinate(x, y, 1)}; break;
      case TargetContent::depth: value = {depth(x, y)}; break;
    }
    for (int c = 0; c < target.format.channels; ++c)
      store_rational(value[static_cast<std::size_t>(c)], target.format, c, state_.half_rounding, bytes.data());
    return bytes;
  }

  const DrawList& list_;
  const RasterState& state_;
  std::uint32_t t_;
  Q area_;
  std::array<Corner, 3> corners_;
};

}  // namespace

std::unique_ptr<TriangleJudge> make_rational_judge(const DrawList& list, const Frame& frame, std::uint32_t t) {
  return std::make_unique<RationalJudge>(list, frame, t);
}

TexelBytes rational_clear(const TargetSpec& target, HalfRounding half_rounding) {
  TexelBytes bytes{};
  if (target.content == TargetContent::triangle_id) {
    bytes.fill(std::byte{0});
    for (std::size_t k = 0; k < 4; ++k) bytes[k] = std::byte{0xFF};
    return bytes;
  }
  if (target.content == TargetContent::margins || target.content == TargetContent::bound_terms) return bytes;
  for (int c = 0; c < target.format.channels; ++c) {
    const Q clear = target.content == TargetContent::depth ? Q(1) : rational_of_float32(target.clear[static_cast<std::size_t>(c)]);
    store_rational(clear, target.format, c, half_rounding, bytes.data());
  }
  return bytes;
}

}  // namespace etalon::validation::reference
