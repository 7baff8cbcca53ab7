#include "core/wavelet/encode_plan.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/wavelet/color.h"
#include "core/wavelet/lifting.h"
#include "core/wavelet/stream_header.h"

namespace etalon::wavelet {
namespace {

template <class Integer>
std::uint32_t signed_magnitude(Integer magnitude, bool negative) {
  const auto m = static_cast<std::uint32_t>(magnitude);
  return negative && m != 0 ? m | kSignBit : m;
}

std::vector<BandTruth> coded_integers(const Image& image, const TextureHeader& header, const std::vector<Subband>& bands) {
  std::vector<BandTruth> truths;
  const auto gather = [&](const auto& plane, int channel, const auto& convert) {
    for (const Subband& band : bands) {
      BandTruth truth;
      truth.reserve(static_cast<std::size_t>(band.width) * static_cast<std::size_t>(band.height));
      const double step = quantisation_step(header, band, channel);
      for (int y = 0; y < band.height; ++y)
        for (int x = 0; x < band.width; ++x) truth.push_back(convert(plane.row(band.y0 + y)[band.x0 + x], step));
      truths.push_back(std::move(truth));
    }
  };
  if (header.kernel == Kernel::reversible_5_3) {
    std::vector<Plane<std::int32_t>> planes = reversible_planes(image);
    for (std::size_t c = 0; c < planes.size(); ++c) {
      forward(planes[c], header.levels);
      gather(planes[c], static_cast<int>(c), [](std::int32_t v, double) { return signed_magnitude(std::abs(v), v < 0); });
    }
  } else {
    std::vector<Plane<double>> planes = irreversible_planes(image);
    for (std::size_t c = 0; c < planes.size(); ++c) {
      forward(planes[c], header.levels);
      gather(planes[c], static_cast<int>(c), [](double v, double step) { return signed_magnitude(std::floor(std::abs(v) / step), v < 0); });
    }
  }
  return truths;
}

int top_exponent_of(const std::vector<BandTruth>& truths, const std::vector<double>& gains) {
  int top = -kMaxLevels;
  for (std::size_t b = 0; b < truths.size(); ++b) {
    std::uint32_t all = 0;
    for (const std::uint32_t t : truths[b]) all |= t & ~kSignBit;
    int exponent = 0;
    std::frexp(gains[b], &exponent);
    if (all != 0) top = std::max(top, static_cast<int>(std::bit_width(all)) + exponent - 1);
  }
  return top;
}

// The plane at which each coefficient and each block becomes significant; how many coefficients do.
std::size_t set_top_planes(BandState& state, const BandTruth& truth) {
  if (state.grids.empty()) return 0;
  std::size_t significant = 0;
  BlockGrid& leaves = state.grids[0];
  leaves.top_plane.assign(truth.size(), kNoPlane);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const std::uint32_t magnitude = truth[i] & ~kSignBit;
    const int delay = state.delays.empty() ? 0 : state.delays[i];
    if (magnitude == 0 || delay == kNeverSent) continue;
    leaves.top_plane[i] = static_cast<std::int16_t>(static_cast<int>(std::bit_width(magnitude)) - 1 - delay);
    ++significant;
  }
  for (std::size_t k = 1; k < state.grids.size(); ++k) {
    const BlockGrid& fine = state.grids[k - 1];
    BlockGrid& grid = state.grids[k];
    grid.top_plane.assign(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height), kNoPlane);
    for (int y = 0; y < fine.height; ++y) {
      for (int x = 0; x < fine.width; ++x) {
        std::int16_t& top = grid.top_plane[grid.index(make_place(x / 2, y / 2))];
        top = std::max(top, fine.top_plane[fine.index(make_place(x, y))]);
      }
    }
  }
  return significant;
}

TextureHeader make_header(const Image& image, const EncodeOptions& options) {
  if (image.empty()) throw InputError("texture stream: expected an image, got an empty one");
  TextureHeader header{
      .kernel = options.kernel, .levels = options.levels, .width = image.width(), .height = image.height(), .format = image.format()};
  if (header.levels == 0) header.levels = default_levels(image.width(), image.height());
  if (header.levels < 1 || header.levels > kMaxLevels)
    throw InputError(fmt::format("texture stream: expected 1 to {} levels, got {}", kMaxLevels, header.levels));
  if (options.kernel == Kernel::irreversible_9_7) header.step_exponent = options.step_exponent;
  if (header.step_exponent < kMinStepExponent || header.step_exponent > kMaxStepExponent)
    throw InputError(fmt::format("texture stream: expected a step exponent of {} to {}, got {}", kMinStepExponent, kMaxStepExponent,
                                 header.step_exponent));
  require_delays_fit(options.delays, image.width(), image.height(), header.levels);
  header.has_delays = !options.delays.empty();
  if (header.has_delays) header.delays_checksum = options.delays.checksum();
  return header;
}

}  // namespace

EncodePlan plan_encoding(const Image& image, const EncodeOptions& options) {
  EncodePlan plan;
  plan.header = make_header(image, options);
  plan.bands = make_subbands(image.width(), image.height(), plan.header.levels, plan.header.kernel);
  plan.truths = coded_integers(image, plan.header, plan.bands);
  plan.header.top_exponent = top_exponent_of(plan.truths, coded_gains(plan.header, plan.bands));
  plan.states = fresh_states(plan.header, plan.bands, options.delays);
  for (std::size_t b = 0; b < plan.states.size(); ++b) plan.significant_total += set_top_planes(plan.states[b], plan.truths[b]);
  plan.passes = make_passes(plan.states);
  return plan;
}

}  // namespace etalon::wavelet
