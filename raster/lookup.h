// Reading an image at an exact coordinate: nearest and linear, three wraps (docs/contract.md#values). The coordinate is either a
// triangle's interpolated uv or a stored number (the second lookup of an indexing map).
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/draw/draw_list.h"
#include "raster/narrow_split.h"
#include "raster/sample_numbers.h"
#include "raster/storage.h"
#include "raster/texture.h"

namespace etalon::raster {

/// uv of a sample. axis 0 is u, 1 is v.
struct TriangleCoordinate {
  const SampleNumbers& numbers;
  [[nodiscard]] Interval enclose_axis(int axis) const { return numbers.enclose_attribute(static_cast<Attribute>(kU + axis)); }
  template <int kLimbs>
  [[nodiscard]] Quotient<kLimbs> quotient(int axis) const {
    return numbers.quotient<kLimbs>(static_cast<Attribute>(kU + axis));
  }
  /// Limbs for border decisions and linear values with texels of `texel_bits` bits.
  [[nodiscard]] int limbs(int texel_bits) const { return numbers.setup.linear_limbs(texel_bits); }
  [[nodiscard]] Interval enclose_fraction(int axis, int size, std::int64_t index) const {
    return numbers.enclose_fraction(static_cast<Attribute>(kU + axis), size, 0.5, index);
  }
  /// u·size − offset/2; nothing where 128 bits may not hold it.
  [[nodiscard]] std::optional<NarrowSplit> split(int axis, int size, int offset) const {
    const ExactTriple& t = numbers.setup.attribute[kU + axis];
    // Σ weights < 2^weight_bits; times a mantissa, a size of 16 bits, 2 and the scale.
    if (numbers.setup.weight_bits + std::max(t.bits + 17 + std::max(-t.k, 0), t.k + 2) > 125) return std::nullopt;
    __int128 n = 0, d = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const __int128 weight = numbers.e[k] * numbers.setup.w_exact[k];
      n += weight * t.m[k];
      d += weight;
    }
    n = (n << std::max(-t.k, 0)) * size * 2;
    d <<= std::max(t.k, 0);
    return narrow_split(n - offset * d, 2 * d);
  }
};

/// Two numbers read from an indexing map.
struct StoredCoordinate {
  std::array<TexelValue, 2> value;
  [[nodiscard]] Interval enclose_axis(int axis) const {
    const double v = value[static_cast<std::size_t>(axis)].approximate();
    const double error = std::abs(v) * 0x1p-49;
    return {v - error, v + error};
  }
  /// The product with the size is below 2^30 and its fraction keeps the number's own bits.
  [[nodiscard]] Interval enclose_fraction(int axis, int size, std::int64_t index) const {
    const DoubleDouble x = two_product(value[static_cast<std::size_t>(axis)].approximate(), size);
    const bool exact = value[static_cast<std::size_t>(axis)].den == 1;
    const double fraction = (x + two_sum(-static_cast<double>(index), -0.5)).high;
    const double error = (exact ? 0 : std::abs(x.high) * 0x1p-51) + std::abs(fraction) * 0x1p-52;
    return {fraction - error, fraction + error};
  }
  [[nodiscard]] std::optional<NarrowSplit> split(int axis, int size, int offset) const {
    const TexelValue& v = value[static_cast<std::size_t>(axis)];  // |m| < 2^24 where den is 1, and |m| <= den, e = 0 elsewhere
    if (v.e > 40 || v.e < -80) return std::nullopt;
    const __int128 n = (static_cast<__int128>(v.m) << std::max(v.e, 0)) * size * 2, d = static_cast<__int128>(v.den) << std::max(-v.e, 0);
    return narrow_split(n - offset * d, 2 * d);
  }
  template <int kLimbs>
  [[nodiscard]] Quotient<kLimbs> quotient(int axis) const {
    const TexelValue& v = value[static_cast<std::size_t>(axis)];
    return {WideInt<kLimbs>(v.m), WideInt<kLimbs>(v.den), -v.e};
  }
  /// Denominators of 2^149·65535 at most on either axis (a float32 subnormal that nearest lookup kept).
  [[nodiscard]] int limbs(int texel_bits) const {
    const int k0 = std::max(-value[0].e, 0), k1 = std::max(-value[1].e, 0);
    return (k0 + k1 + 2 * 17 + std::max(texel_bits + 17, 72) + 32 + 2 + 63) / 64;
  }
};

/// u·n − offset/2 as a fraction over an unscaled denominator: floor and remainder, exact. offset is 0 (nearest) or 1 (linear).
template <int kLimbs>
struct BorderSplit {
  std::int64_t index;         ///< floor
  WideInt<kLimbs> remainder;  ///< in [0, denominator)
  WideInt<kLimbs> denominator;
};

template <int kLimbs>
[[nodiscard]] BorderSplit<kLimbs> split_at_border(const Quotient<kLimbs>& q, int size, int offset) {
  const WideInt<kLimbs> n = (q.k < 0 ? q.n << -q.k : q.n) * WideInt<kLimbs>(size);
  const WideInt<kLimbs> d = q.k > 0 ? q.d << q.k : q.d;
  const Quotient<kLimbs> x{offset == 0 ? n << 1 : (n << 1) - d, d << 1, 0};
  const std::int64_t index = floor_of(x, enclose(x));
  return {index, x.n - WideInt<kLimbs>(index) * x.d, x.d};
}

/// |u·n − nearest integer| (of u·n − ½ for linear), rounded once to float32.
template <class Coordinate>
[[nodiscard]] float border_distance(const Coordinate& at, int axis, int size, bool linear) {
  float result = 0;
  with_limbs(at.limbs(8), [&]<int kLimbs>() {
    const auto s = split_at_border<kLimbs>(at.template quotient<kLimbs>(axis), size, linear ? 1 : 0);
    const WideInt<kLimbs> rest = s.denominator - s.remainder;
    const Quotient<kLimbs> q{rest < s.remainder ? rest : s.remainder, s.denominator, 0};
    result = to_float32(q, enclose(q));
  });
  return result;
}

/// One lookup: find() decides the texels, store() writes a channel.
class Lookup {
 public:
  Lookup(const Image& image, const Sampler& sampler, bool exact_only, EvaluationCounters& counters)
      : image_(image), sampler_(sampler), exact_only_(exact_only), counters_(counters) {}

  template <class Coordinate>
  void find(const Coordinate& at) {
    for (int axis = 0; axis < 2; ++axis) find_axis(at, axis);
  }

  /// Whether the target takes the texel's stored bytes as they are.
  [[nodiscard]] bool copies(const TargetSpec& target) const {
    const ChannelType type = image_.format().type;
    return sampler_.filter == Filter::nearest && target.format.type == type && target.format.channels <= image_.format().channels &&
           (type == ChannelType::unorm8 || type == ChannelType::unorm16 || type == ChannelType::srgb8);
  }
  void copy(std::byte* texel, const TargetSpec& target) const {
    std::copy_n(image_.texel(x_[0], y_[0]), bytes_per_texel(target.format), texel);
  }

  /// Stores channel c of the looked-up value.
  template <class Coordinate>
  void store(const Coordinate& at, int c, const ChannelStore& to, std::byte* out) {
    if (sampler_.filter == Filter::nearest) return to.store(texel_value(image_, x_[0], y_[0], c, false), out);
    ++counters_.values;
    if (!exact_only_ && decided_ && to.try_store(enclose_linear(c), out)) return;
    if (!exact_only_ && sharpen(at) && to.try_store(enclose_linear(c), out)) {
      ++counters_.narrow;
      return;
    }
    ++counters_.exact_path;
    with_limbs(at.limbs(filtered_texel_bits(image_.format().type)),
               [&]<int kLimbs>() { to.store_exact(exact_linear<kLimbs>(at, c), out); });
  }

  /// Channel c as the coordinate of a second lookup: the stored number, or the linear value rounded once to float32 and canonical.
  template <class Coordinate>
  [[nodiscard]] TexelValue as_coordinate(const Coordinate& at, int c) {
    if (sampler_.filter == Filter::nearest) return texel_value(image_, x_[0], y_[0], c, false);
    float value = 0;
    store(at, c, {ChannelType::float32, false, HalfRounding::nearest_even}, reinterpret_cast<std::byte*>(&value));
    return exact_number(canonical(value));
  }

 private:
  template <class Coordinate>
  void find_axis(const Coordinate& at, int axis) {
    const int size = axis == 0 ? image_.width() : image_.height();
    const Wrap wrap = axis == 0 ? sampler_.wrap_u : sampler_.wrap_v;
    const bool linear = sampler_.filter == Filter::linear;
    const Interval v = at.enclose_axis(axis);
    const double offset = linear ? 0.5 : 0;
    const double lo = v.lo * size - offset, hi = v.hi * size - offset;
    const double floor_lo = std::floor(lo);
    ++counters_.values;
    std::int64_t index = 0;
    std::optional<NarrowSplit> split;
    if (!exact_only_ && floor_lo == std::floor(hi)) {
      index = static_cast<std::int64_t>(floor_lo);
    } else if (!exact_only_ && (split = at.split(axis, size, linear ? 1 : 0))) {
      ++counters_.narrow;
      index = split->index;
    } else {
      ++counters_.exact_path;
      decided_ = false;
      with_limbs(at.limbs(8),
                 [&]<int kLimbs>() { index = split_at_border<kLimbs>(at.template quotient<kLimbs>(axis), size, linear ? 1 : 0).index; });
    }
    index_[static_cast<std::size_t>(axis)] = index;
    auto& texel = axis == 0 ? x_ : y_;
    texel[0] = wrapped(index, size, wrap);
    if (linear) texel[1] = wrapped(index + 1, size, wrap);
    if (split) return set_fraction(axis, *split);
    // Products, the subtraction of ½ and of the index each round once, relative to |u·n| < 2^30: the enclosure grows by 2^-51·(|u·n| + 1).
    const double slack = 0x1p-51 * (std::abs(lo) + 1);
    fraction_[static_cast<std::size_t>(axis)] = {lo - floor_lo - slack, hi - floor_lo + slack};
  }

  void set_fraction(int axis, const NarrowSplit& split) {
    fraction_[static_cast<std::size_t>(axis)] = {split.fraction * (1 - 0x1p-51), split.fraction * (1 + 0x1p-51)};
  }

  // Fractions by other means than a difference of doubles. Past an index that needed wide integers they may lie outside [0, 1]; the
  // interpolant is not that of the next texel there, so those are left alone.
  template <class Coordinate>
  bool sharpen(const Coordinate& at) {
    if (!decided_) return false;
    for (int axis = 0; axis < 2; ++axis) {
      const int size = axis == 0 ? image_.width() : image_.height();
      const auto split = at.split(axis, size, 1);
      if (split) {
        set_fraction(axis, *split);
      } else {
        fraction_[static_cast<std::size_t>(axis)] = at.enclose_fraction(axis, size, index_[static_cast<std::size_t>(axis)]);
      }
    }
    return true;
  }

  // With fractions f ± df, g ± dg: |value error| <= 2·max|t|·(df + dg), and fewer than 16 roundings of at most max|t|·2^-53 each.
  [[nodiscard]] Interval enclose_linear(int c) const {
    const double t00 = texel(0, 0, c), t10 = texel(1, 0, c), t01 = texel(0, 1, c), t11 = texel(1, 1, c);
    const double f = 0.5 * (fraction_[0].lo + fraction_[0].hi), df = 0.5 * (fraction_[0].hi - fraction_[0].lo);
    const double g = 0.5 * (fraction_[1].lo + fraction_[1].hi), dg = 0.5 * (fraction_[1].hi - fraction_[1].lo);
    const double value = (1 - g) * ((1 - f) * t00 + f * t10) + g * ((1 - f) * t01 + f * t11);
    const double largest = std::max({std::abs(t00), std::abs(t10), std::abs(t01), std::abs(t11)});
    const double error = largest * (2 * (df + dg) + 0x1p-48);
    return {value - error, value + error};
  }
  [[nodiscard]] double texel(int dx, int dy, int c) const {
    return texel_value(image_, x_[static_cast<std::size_t>(dx)], y_[static_cast<std::size_t>(dy)], c, true).approximate();
  }

  template <int kLimbs, class Coordinate>
  [[nodiscard]] Quotient<kLimbs> exact_linear(const Coordinate& at, int c) const {
    const auto u = split_at_border<kLimbs>(at.template quotient<kLimbs>(0), image_.width(), 1);
    const auto v = split_at_border<kLimbs>(at.template quotient<kLimbs>(1), image_.height(), 1);
    std::array<TexelValue, 4> t;
    for (std::size_t n = 0; n < 4; ++n) t[n] = texel_value(image_, x_[n & 1], y_[n >> 1], c, true);
    int least = 0;
    bool any = false;
    for (const TexelValue& value : t)
      if (value.m != 0) least = any ? std::min(least, value.e) : value.e, any = true;
    const std::array<WideInt<kLimbs>, 2> fu = {u.denominator - u.remainder, u.remainder}, fv = {v.denominator - v.remainder, v.remainder};
    WideInt<kLimbs> sum;
    for (std::size_t n = 0; n < 4; ++n)
      if (t[n].m != 0) sum += fu[n & 1] * fv[n >> 1] * (WideInt<kLimbs>(t[n].m) << (t[n].e - least));
    return {sum, u.denominator * v.denominator * WideInt<kLimbs>(t[0].den), -least};
  }

  const Image& image_;
  Sampler sampler_;
  bool exact_only_;
  EvaluationCounters& counters_;
  std::array<int, 2> x_{}, y_{};
  std::array<std::int64_t, 2> index_{};  ///< of the first texel, before the wrap
  std::array<Interval, 2> fraction_{};
  bool decided_ = true;
};

}  // namespace etalon::raster
