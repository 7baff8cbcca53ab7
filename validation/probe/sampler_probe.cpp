// The sampler: where it takes the next texel, how fine its weights are, and what a filtered value costs. Coordinates come from a map, exact.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <set>

#include "core/base/rng.h"
#include "validation/probe/device_probe.h"
#include "validation/probe/lookup_sheet.h"
#include "validation/texel_lookup.h"

namespace etalon::validation {
namespace {

constexpr int kTexels = 64;  // a power of two: u·64 costs no rounding
// 16 borders of 64 texels, 4096 coordinates around each: 1/16 texel to both sides in steps of 2^-15. 6 + 15 bits: float32 numbers.
constexpr std::array kBorders{1, 2, 3, 5, 8, 13, 21, 31, 32, 33, 42, 47, 55, 61, 62, 63};
constexpr int kPlaces = 4096, kPlaceBits = 15;
constexpr int kWeightBits = 16;  // of the coordinates between two texels

std::shared_ptr<const Image> strip(bool along_v, ChannelType type, const std::function<double(int)>& value) {
  Image image(along_v ? 1 : kTexels, along_v ? kTexels : 1, {type, 1});
  for (int n = 0; n < kTexels; ++n) {
    if (type == ChannelType::unorm8)
      image.channels<std::uint8_t>(0, 0)[n] = static_cast<std::uint8_t>(value(n));
    else
      image.channels<float>(0, 0)[n] = static_cast<float>(value(n));
  }
  return std::make_shared<const Image>(std::move(image));
}

Vec2f on_axis(bool along_v, double u) { return along_v ? Vec2f{0.5f, static_cast<float>(u)} : Vec2f{static_cast<float>(u), 0.5f}; }

void probe_borders(Renderer& device, bool along_v, NearestFinding& finding) {
  std::vector<Vec2f> coordinates;
  for (const int border : kBorders)
    for (int m = 0; m < kPlaces; ++m)
      coordinates.push_back(on_axis(along_v, (border + std::ldexp(m - kPlaces / 2, -kPlaceBits)) / kTexels));
  const auto texture = strip(along_v, ChannelType::float32, [](int n) { return n; });
  const std::vector<float> texels = look_up_floats(device, texture, {}, coordinates);
  for (std::size_t b = 0; b < kBorders.size(); ++b) {
    const auto first = texels.begin() + static_cast<std::ptrdiff_t>(b) * kPlaces, last = first + kPlaces;
    const auto below = static_cast<float>(kBorders[b] - 1), above = static_cast<float>(kBorders[b]);
    const auto step = std::find(first, last, above);
    const bool is_step = step != first && step != last && std::all_of(first, step, [&](float t) { return t == below; }) &&
                         std::all_of(step, last, [&](float t) { return t == above; });
    finding.steps = finding.steps && is_step;
    const double at = std::ldexp(static_cast<double>(step - first) - kPlaces / 2, -kPlaceBits);
    finding.earliest_texel = std::min(finding.earliest_texel, at);
    finding.latest_texel = std::max(finding.latest_texel, at);
  }
}

// Between two multiples of 2^-16 texel: never on a tie of a coarser grid, which could go either way. 5 + 17 bits.
double place(std::size_t m) { return std::ldexp(static_cast<double>(2 * m + 1), -kWeightBits - 1); }

// Weights between texels 31 and 32.
std::vector<float> ramp(Renderer& device, bool along_v, const std::shared_ptr<const Image>& texture) {
  std::vector<Vec2f> coordinates;
  for (std::size_t m = 0; m < kSheetLookups; ++m) coordinates.push_back(on_axis(along_v, (kTexels / 2 - 0.5 + place(m)) / kTexels));
  return look_up_floats(device, texture, {.filter = Filter::linear}, coordinates);
}

// Whatever is filtered, a weight of B bits changes the result at places that are equal modulo 2^(16−B) only.
void examine_weights(const std::vector<float>& values, LinearFinding& finding, std::uint32_t& changes_or,
                     std::optional<std::uint32_t>& first) {
  for (std::size_t m = 0; m < values.size(); ++m) {
    const double error = std::abs(static_cast<double>(values[m]) - place(m));
    finding.largest_weight_error = std::isfinite(error) ? std::max(finding.largest_weight_error, error) : HUGE_VAL;
    if (m == 0 || values[m] == values[m - 1]) continue;
    if (!first) first = static_cast<std::uint32_t>(m);
    changes_or |= static_cast<std::uint32_t>(m) - *first;
  }
}

constexpr float kSmallestTexel = 0.5f;  // of floats, whose error is relative

std::shared_ptr<const Image> random_texture(ChannelType type) {
  Rng rng(3);
  Image image(kTexels, kTexels, {type, 1});
  for (int n = 0; n < kTexels * kTexels; ++n) {
    if (type == ChannelType::unorm8)
      image.channels<std::uint8_t>(0, 0)[n] = static_cast<std::uint8_t>(rng.below(256));
    else
      image.channels<float>(0, 0)[n] = rng.uniform(kSmallestTexel, 1);
  }
  return std::make_shared<const Image>(std::move(image));
}

void probe_values(Renderer& device, ChannelType type, LinearFinding& finding) {
  Rng rng(4);
  std::vector<Vec2f> coordinates(kSheetLookups);
  for (Vec2f& c : coordinates) {
    c.x = rng.uniform(0, 1);
    c.y = rng.uniform(0, 1);
  }
  const auto texture = random_texture(type);
  const Sampler sampler{.filter = Filter::linear};
  const std::vector<float> values = look_up_floats(device, texture, sampler, coordinates);
  DeviceModel model = measured_model("weights", 1, "");
  const double step = finding.weight_bits ? std::ldexp(1.0, -*finding.weight_bits) : 0;
  (type == ChannelType::unorm8 ? model.weight_error_unorm8_texel : model.weight_error_texel) = step;
  for (std::size_t n = 0; n < values.size(); ++n) {
    const Coordinate at{static_cast<double>(coordinates[n].x), static_cast<double>(coordinates[n].y), 0, 0};
    const Bounded value = linear_choice(plan_lookup(*texture, sampler, at, model), model).value[0];
    const double error = std::abs(static_cast<double>(values[n]) - value.value);
    if (!std::isfinite(error)) {
      finding.largest_value_error = finding.value_error_over_model = HUGE_VAL;
      return;
    }
    finding.largest_value_error = std::max(finding.largest_value_error, error);
    finding.value_error_over_model = std::max(finding.value_error_over_model, error - value.bound);
  }
  if (type != ChannelType::unorm8) finding.value_error_over_model /= static_cast<double>(kSmallestTexel);
}

}  // namespace

NearestFinding probe_nearest(Renderer& device) {
  NearestFinding finding{.steps = true};
  probe_borders(device, false, finding);
  probe_borders(device, true, finding);
  const double early = -finding.earliest_texel;
  // Borders are early by half a step of the coordinates, up to the spacing of the places (ties may go either way).
  for (int bits = 1; finding.steps && finding.latest_texel <= 0 && bits < kPlaceBits - 1; ++bits)
    if (std::abs(early - std::ldexp(1.0, -(bits + 1))) <= std::ldexp(1.0, -kPlaceBits)) finding.fixed_bits = bits;
  return finding;
}

LinearFinding probe_linear(Renderer& device, ChannelType type) {
  LinearFinding finding;
  const double one = type == ChannelType::unorm8 ? 255 : 1;
  std::uint32_t changes = 0;
  std::optional<std::uint32_t> first;
  for (const bool along_v : {false, true})
    examine_weights(ramp(device, along_v, strip(along_v, type, [&](int n) { return n < kTexels / 2 ? 0 : one; })), finding, changes, first);
  const int grid = changes == 0 ? kWeightBits : std::countr_zero(changes);
  if (first && grid > 0) {
    finding.weight_bits = kWeightBits - grid;
    finding.weights_rounded = (*first & ((1u << grid) - 1)) != 0;
  }
  if (type == ChannelType::unorm8) {
    const std::vector<float> values = ramp(device, false, strip(false, type, [](int n) { return n < kTexels / 2 ? 0 : 1; }));
    finding.levels_of_small_step = static_cast<int>(std::set<float>(values.begin(), values.end()).size());
  }
  probe_values(device, type, finding);
  return finding;
}

}  // namespace etalon::validation
