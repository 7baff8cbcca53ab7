#include "core/wavelet/band_state.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace etalon::wavelet {
namespace {

int exponent_of(double x) {
  int exponent = 0;
  std::frexp(x, &exponent);
  return exponent;
}

void set_delays(BandState& state, const Delays& delays) {
  const Subband& band = state.band;
  BlockGrid& leaves = state.grids[0];
  state.delays.resize(static_cast<std::size_t>(band.width) * static_cast<std::size_t>(band.height));
  leaves.first_plane.assign(state.delays.size(), kNoPlane);
  leaves.last_plane.assign(state.delays.size(), std::numeric_limits<std::int16_t>::max());
  for (int y = 0; y < band.height; ++y) {
    for (int x = 0; x < band.width; ++x) {
      const std::size_t i = leaves.index(make_place(x, y));
      const std::int16_t delay = delays.at(band.x0 + x, band.y0 + y);
      state.delays[i] = delay;
      if (delay == kNeverSent || state.planes == 0) continue;
      leaves.first_plane[i] = static_cast<std::int16_t>(state.planes - 1 - delay);
      leaves.last_plane[i] = static_cast<std::int16_t>(-delay);
    }
  }
  for (std::size_t k = 1; k < state.grids.size(); ++k) {
    const BlockGrid& fine = state.grids[k - 1];
    BlockGrid& grid = state.grids[k];
    const std::size_t count = static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height);
    grid.first_plane.assign(count, kNoPlane);
    grid.last_plane.assign(count, std::numeric_limits<std::int16_t>::max());
    for (int y = 0; y < fine.height; ++y) {
      for (int x = 0; x < fine.width; ++x) {
        const std::size_t from = fine.index(make_place(x, y)), to = grid.index(make_place(x / 2, y / 2));
        grid.first_plane[to] = std::max(grid.first_plane[to], fine.first_plane[from]);
        grid.last_plane[to] = std::min(grid.last_plane[to], fine.last_plane[from]);
      }
    }
  }
  const BlockGrid& root = state.grids.back();
  state.first_plane = root.first_plane[0];
  state.last_plane = root.last_plane[0];
  if (state.first_plane >= state.last_plane) state.wakes.resize(static_cast<std::size_t>(state.first_plane - state.last_plane) + 1);
}

}  // namespace

BandState make_band_state(const Subband& band, int channel, double gain, int planes, const Delays& delays) {
  BandState state{.band = band, .channel = channel, .gain = gain, .planes = planes};
  state.first_plane = planes - 1;
  if (band.width == 0 || band.height == 0) {
    state.planes = 0;
    state.first_plane = -1;
    return state;
  }
  BlockGrid grid{.width = band.width, .height = band.height};
  state.known.resize(grid.bordered_size());
  state.known_plane.resize(static_cast<std::size_t>(band.width) * static_cast<std::size_t>(band.height));
  state.grids.push_back(std::move(grid));
  while (state.grids.back().width > 1 || state.grids.back().height > 1) {
    BlockGrid coarser{.width = (state.grids.back().width + 1) / 2, .height = (state.grids.back().height + 1) / 2};
    coarser.is_significant.resize(coarser.bordered_size());
    state.grids.push_back(std::move(coarser));
  }
  if (!delays.empty()) set_delays(state, delays);
  state.pending.resize(state.grids.size());
  if (state.first_plane >= state.last_plane) state.pending.back().push_back(make_place(0, 0));
  return state;
}

std::vector<BandState> make_band_states(const std::vector<Subband>& bands, const std::vector<double>& gains, int channels, int top_exponent,
                                        const Delays& delays) {
  std::vector<BandState> states;
  states.reserve(bands.size() * static_cast<std::size_t>(channels));
  for (int c = 0; c < channels; ++c) {
    for (const Subband& band : bands) {
      const double gain = gains[states.size()];
      // gain >= 2^(exponent − 1), so magnitudes of less than 2^top_exponent / gain are below 2^(top_exponent − exponent + 1).
      states.push_back(make_band_state(band, c, gain, std::clamp(top_exponent - exponent_of(gain) + 1, 0, 31), delays));
    }
  }
  for (std::size_t i = 0; i < states.size(); ++i) {
    BandState& state = states[i];
    const std::size_t b = i % bands.size();
    const auto relate = [&](const BandState& other, const BandState*& link, int& shift) {
      if (other.grids.empty() || state.grids.empty()) return;
      link = &other;
      shift = exponent_of(state.gain / other.gain * 1.4142135623730951) - 1;
    };
    if (b >= 4) relate(states[i - 3], state.parent, state.parent_shift);
    if (state.channel > 0) relate(states[b], state.luma, state.luma_shift);
  }
  return states;
}

std::vector<Pass> make_passes(const std::vector<BandState>& bands) {
  struct Keyed {
    int exponent;
    double mantissa;
    Pass pass;
  };
  std::vector<Keyed> keyed;
  for (std::size_t b = 0; b < bands.size(); ++b) {
    int exponent = 0;
    const double mantissa = std::frexp(bands[b].gain, &exponent);
    for (int plane = bands[b].first_plane; plane >= bands[b].last_plane; --plane) {
      for (const bool refines : {false, true})
        keyed.push_back({exponent + plane, mantissa, {static_cast<std::uint32_t>(b), static_cast<std::int16_t>(plane), refines}});
    }
  }
  std::ranges::sort(keyed, [](const Keyed& a, const Keyed& b) {
    return std::tuple(-a.exponent, -a.mantissa, a.pass.refines, a.pass.band) <
           std::tuple(-b.exponent, -b.mantissa, b.pass.refines, b.pass.band);
  });
  std::vector<Pass> passes;
  passes.reserve(keyed.size());
  for (const Keyed& k : keyed) passes.push_back(k.pass);
  return passes;
}

}  // namespace etalon::wavelet
