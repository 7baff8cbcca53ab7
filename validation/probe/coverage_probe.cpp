// Sub-texel bits, snap rounding and fill rule: triangles whose positions are far finer than any grid, drawn by the device, and by the exact
// rasterizer from positions snapped in each possible way.
#include <algorithm>
#include <array>
#include <vector>

#include "core/base/rng.h"
#include "raster/cpu_renderer.h"
#include "validation/probe/device_probe.h"

namespace etalon::validation {
namespace {

constexpr int kBits = 16;  // of the positions that the device is given
constexpr std::int32_t kOne = 1 << kBits;
constexpr int kCell = 16, kColumns = 8;
// Frame and guard fit a viewport of 256 texels, in which a position of 16 bits is a float32 number exactly (8 + 16 bits).
constexpr int kFrame = kCell * kColumns, kGuard = 64;
constexpr int kBand = 4;  // rows to a triangle that begins outside

constexpr std::array kRoundings{SnapRounding::nearest_even, SnapRounding::half_up, SnapRounding::half_away, SnapRounding::toward_zero,
                                SnapRounding::floor};
constexpr std::array kRules{FillRule::left_ymin, FillRule::left_ymax, FillRule::right_ymin, FillRule::right_ymax};

struct Place {
  std::int32_t x = 0, y = 0;
};

struct Description {
  int bits = 0;
  SnapRounding snap = SnapRounding::nearest_even;
  FillRule rule = FillRule::left_ymin;
};

void add_triangle(DrawList& list, const std::array<Place, 3>& corners) {
  const auto first = static_cast<std::uint32_t>(list.vertices.size());
  for (const Place& p : corners) list.vertices.push_back({.x = p.x, .y = p.y});
  list.triangles.push_back({first, first + 1, first + 2});
}

// A few steps of half a grid of `bits` bits from a sample: a tie of that grid for odd steps, and a snapped edge passes through the sample or
// beside it, so that a whole row of texels answers.
std::int32_t beside(std::int32_t sample, int bits, Rng& rng) {
  return sample + static_cast<std::int32_t>(rng.between(-3, 3)) * (1 << (kBits - 1 - bits));
}

std::array<Place, 3> random_triangle(Place cell, Rng& rng) {
  std::array<Place, 3> t;
  for (Place& p : t)
    p = {cell.x + static_cast<std::int32_t>(rng.below(kCell * kOne)), cell.y + static_cast<std::int32_t>(rng.below(kCell * kOne))};
  return t;
}

// Corners on samples: every edge passes through some.
std::array<Place, 3> lattice_triangle(Place cell, Rng& rng) {
  std::array<Place, 3> t;
  for (Place& p : t)
    p = {cell.x + static_cast<std::int32_t>(rng.below(kCell)) * kOne + kOne / 2,
         cell.y + static_cast<std::int32_t>(rng.below(kCell)) * kOne + kOne / 2};
  return t;
}

// A horizontal and a vertical leg, in any of the four directions.
std::array<Place, 3> legs_triangle(Place cell, int bits, Rng& rng) {
  const auto sample = [&](std::int32_t origin) { return origin + 7 * kOne + kOne / 2; };
  const Place corner{beside(sample(cell.x), bits, rng), beside(sample(cell.y), bits, rng)};
  const std::int32_t dx = rng.coin() ? 6 * kOne : -6 * kOne, dy = rng.coin() ? 6 * kOne : -6 * kOne;
  return {{corner, {corner.x + dx, corner.y}, {corner.x, corner.y + dy}}};
}

// An edge from left of (or below) the frame whose middle is at a sample: roundings that treat negative positions otherwise move it.
std::array<Place, 3> negative_triangle(int row, int bits, bool transposed, Rng& rng) {
  const std::int32_t along = static_cast<std::int32_t>(rng.between(8, 60)) * kOne + kOne / 2;
  const std::int32_t across = (row * kBand + 1) * kOne + kOne / 2;
  const auto outside = static_cast<std::int32_t>(rng.between(1, 60)) * kOne;
  const std::int32_t height = kOne;
  std::array<Place, 3> t{{{beside(-outside, bits, rng), across - height},
                          {2 * along + outside, across + height},
                          {along, across + (rng.coin() ? height : -height)}}};
  if (transposed)
    for (Place& p : t) std::swap(p.x, p.y);
  return t;
}

DrawList scene(int n, Rng& rng) {
  DrawList list;
  if (n % 2 == 1) {
    for (int row = 0; row < kFrame / kBand; ++row) add_triangle(list, negative_triangle(row, 1 + (n + row) % 15, n % 4 == 3, rng));
  } else {
    for (int k = 0; k < kColumns * kColumns; ++k) {
      const Place cell{k % kColumns * kCell * kOne, k / kColumns * kCell * kOne};
      if (k % 4 == 0)
        add_triangle(list, random_triangle(cell, rng));
      else if (k % 4 == 1)
        add_triangle(list, lattice_triangle(cell, rng));
      else
        add_triangle(list, legs_triangle(cell, 1 + (k / 2 + n) % 15, rng));
    }
  }
  list.draws = {{.triangle_count = static_cast<std::uint32_t>(list.triangles.size())}};
  return list;
}

Frame frame_of(const RasterState& state) {
  Frame frame;
  frame.width = frame.height = kFrame;
  frame.guard = kGuard;
  frame.state = state;
  frame.targets = {{.content = TargetContent::triangle_id, .format = kR32ui}};
  return frame;
}

std::int32_t snapped(std::int32_t x, int bits, SnapRounding rounding) {
  const int shift = kBits - bits;
  if (shift == 0) return x;
  const std::int32_t below = x >> shift, rest = x - (below << shift), half = 1 << (shift - 1);
  switch (rounding) {
    case SnapRounding::nearest_even: return below + (rest > half || (rest == half && (below & 1) != 0) ? 1 : 0);
    case SnapRounding::half_up: return below + (rest >= half ? 1 : 0);
    case SnapRounding::half_away: return below + (rest > half || (rest == half && x > 0) ? 1 : 0);
    case SnapRounding::toward_zero: return below + (x < 0 && rest != 0 ? 1 : 0);
    case SnapRounding::floor: return below;
  }
  return below;
}

DrawList snapped(DrawList list, int bits, SnapRounding rounding) {
  for (RasterVertex& v : list.vertices) v.x = snapped(v.x, bits, rounding), v.y = snapped(v.y, bits, rounding);
  return list;
}

std::uint64_t differing(const Image& a, const Image& b) {
  const std::uint32_t *p = a.channels<std::uint32_t>(0, 0), *q = b.channels<std::uint32_t>(0, 0);
  std::uint64_t count = 0;
  for (std::size_t n = 0; n < a.texel_count(); ++n) count += p[n] != q[n] ? 1 : 0;
  return count;
}

template <class T>
std::optional<T> common(const std::vector<Description>& list, T Description::*member) {
  if (list.empty()) return std::nullopt;
  const bool same = std::all_of(list.begin(), list.end(), [&](const Description& d) { return d.*member == list.front().*member; });
  return same ? std::optional<T>(list.front().*member) : std::nullopt;
}

}  // namespace

CoverageFinding probe_coverage(Renderer& device, const ProbeOptions& options) {
  Rng rng(1);
  std::vector<DrawList> lists;
  std::vector<Image> drawn;
  CoverageFinding finding;
  RasterState given = device.supported_state({.subtexel_bits = kBits});
  given.subtexel_bits = kBits;
  for (int n = 0; n < options.coverage_frames; ++n) {
    lists.push_back(scene(n, rng));
    drawn.push_back(device.render(lists.back(), frame_of(given)).front());
    finding.triangles += lists.back().triangles.size();
    finding.texels += drawn.back().texel_count();
  }

  raster::CpuRenderer exact;
  std::vector<Description> agreeing;
  std::uint64_t fewest = finding.texels + 1;
  for (int bits = 1; bits <= kBits; ++bits) {
    if (options.progress) options.progress("coverage", bits, kBits);
    for (const SnapRounding rounding : kRoundings) {
      std::array<std::uint64_t, kRules.size()> counts{};
      for (std::size_t n = 0; n < lists.size(); ++n) {
        // What is already worse than the nearest so far need not be counted to the end.
        if (std::all_of(counts.begin(), counts.end(), [&](std::uint64_t count) { return count > fewest; })) break;
        const DrawList list = snapped(lists[n], bits, rounding);
        for (std::size_t r = 0; r < kRules.size(); ++r)
          if (counts[r] <= fewest)
            counts[r] += differing(drawn[n], exact.render(list, frame_of({.subtexel_bits = bits, .fill_rule = kRules[r]})).front());
      }
      for (std::size_t r = 0; r < kRules.size(); ++r) {
        if (counts[r] < fewest) {
          fewest = counts[r];
          finding.nearest_bits = bits, finding.nearest_snap = rounding, finding.nearest_rule = kRules[r];
        }
        if (counts[r] == 0) agreeing.push_back({bits, rounding, kRules[r]});
      }
    }
  }
  finding.differing = fewest;
  finding.subtexel_bits = common(agreeing, &Description::bits);
  finding.snap = common(agreeing, &Description::snap);
  finding.fill_rule = common(agreeing, &Description::rule);
  return finding;
}

}  // namespace etalon::validation
