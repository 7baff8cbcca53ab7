#include "validation/diff/worst_unexplained.h"

#include <algorithm>
#include <cmath>

#include "validation/metrics/pixel_comparison.h"

namespace etalon::validation {
namespace {

struct Place {
  int x = 0, y = 0;
  double difference = 0;
};

double largest_difference(const double* a, const double* b, int channels) {
  double largest = 0;
  for (int c = 0; c < channels; ++c) {
    const double d = std::abs(a[c] - b[c]);
    largest = std::max(largest, std::isfinite(d) ? d : 1e300);
  }
  return largest;
}

std::vector<Place> unexplained_places(const Image& classes, const Image& golden, const Image& candidate) {
  const int channels = golden.format().channels;
  std::vector<double> a(static_cast<std::size_t>(golden.width()) * static_cast<std::size_t>(channels)), b(a.size());
  std::vector<Place> places;
  for (int y = 0; y < classes.height(); ++y) {
    row_values(golden, y, channels, a.data());
    row_values(candidate, y, channels, b.data());
    for (int x = 0; x < classes.width(); ++x) {
      if (*classes.channels<std::uint8_t>(x, y) != static_cast<std::uint8_t>(TexelClass::unexplained)) continue;
      const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(x) * channels;
      places.push_back({x, y, largest_difference(a.data() + at, b.data() + at, channels)});
    }
  }
  return places;
}

}  // namespace

std::vector<TexelReport> worst_unexplained(const DiffResult& diff, const DrawnPair& pair, const DrawList& list, const Frame& frame,
                                           const DeviceModel& model, int count) {
  std::vector<Place> places = unexplained_places(diff.class_image, pair.cpu.front(), pair.gl.front());
  std::stable_sort(places.begin(), places.end(), [](const Place& p, const Place& q) { return p.difference > q.difference; });
  constexpr int kApart = kCropSize / 2;
  std::vector<TexelReport> worst;
  for (const Place& place : places) {
    if (static_cast<int>(worst.size()) >= count) break;
    const auto near = [&](const TexelReport& r) { return std::abs(r.x - place.x) <= kApart && std::abs(r.y - place.y) <= kApart; };
    if (std::any_of(worst.begin(), worst.end(), near)) continue;
    worst.push_back(explain_texel(list, frame, model, pair.cpu, pair.gl, place.x, place.y));
  }
  return worst;
}

}  // namespace etalon::validation
