#include "core/procedural/range_scan.h"

#include <array>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/procedural/noise.h"
#include "core/procedural/scan_shapes.h"

namespace etalon::procedural {

namespace {

constexpr int kSide = 256;
constexpr double kTop = 127;  ///< no form reaches it
constexpr double kLeastCosine = 0.1;
constexpr double kNoise = 0.03;  ///< mm, standard deviation

constexpr std::array kKinds = {RangeKind::shuttle, RangeKind::hand, RangeKind::soldier, RangeKind::teapot, RangeKind::telephone};

struct Form {
  std::string_view name;
  Field field;
  double spacing;  ///< mm; a number of few bits, so that sample positions are exact
};

const Form& form_of(RangeKind kind) {
  static constexpr std::array<Form, 5> kForms = {{{"shuttle", shuttle_field, 0.8125},
                                                  {"hand", hand_field, 0.8125},
                                                  {"soldier", soldier_field, 0.8125},
                                                  {"teapot", teapot_field, 0.8125},
                                                  {"telephone", telephone_field, 0.8125}}};
  const auto index = static_cast<std::size_t>(kind);
  ETALON_CHECK(index < kForms.size(), "kind of range image");
  return kForms[index];
}

/// The first zero on the way down from kTop; negative where there is none above the support.
double depth_at(Field field, double x, double y) {
  double above = kTop, z = kTop;
  while (true) {
    const double d = field({x, y, z});
    if (d < 0) break;
    above = z;
    z -= std::fmax(0.6 * d, 0.02);
    if (z < 0) return -1;
  }
  double below = z;
  for (int i = 0; i < 24; ++i) {
    const double middle = 0.5 * (above + below);
    (field({x, y, middle}) < 0 ? below : above) = middle;
  }
  return 0.5 * (above + below);
}

/// The sum of four uniform numbers: near enough to a normal one, variance 1.
double unit_noise(int i, int j, RangeKind kind) {
  const std::uint64_t bits = lattice_hash(i, j, 0, 0x5CA9 + static_cast<std::uint64_t>(kind));
  double sum = 0;
  for (int k = 0; k < 4; ++k) sum += static_cast<double>((bits >> (16 * k)) & 0xFFFF) / 65535 - 0.5;
  return sum * 1.7320508075688772;  // four variances of 1/12
}

float sample(RangeKind kind, const Form& form, int i, int j) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  const double x = (i + 0.5 - kSide / 2) * form.spacing, y = (j + 0.5 - kSide / 2) * form.spacing;
  const double z = depth_at(form.field, x, y);
  if (!(z > 0.5)) return kNone;
  if (field_normal(form.field, {x, y, z}, 0.05).z < kLeastCosine) return kNone;
  const double measured = z + kNoise * unit_noise(i, j, kind);
  return static_cast<float>(std::floor(measured / kRangeStep + 0.5) * kRangeStep);
}

}  // namespace

std::span<const RangeKind> range_kinds() { return kKinds; }

std::string_view range_name(RangeKind kind) { return form_of(kind).name; }

RangeImage make_range_scan(RangeKind kind) {
  const Form& form = form_of(kind);
  RangeImage range{.width = kSide, .height = kSide, .spacing = form.spacing, .z = std::vector<float>(std::size_t{kSide} * kSide)};
  parallel_for(kSide, [&](std::size_t j) {
    for (int i = 0; i < kSide; ++i) range.z[j * kSide + static_cast<std::size_t>(i)] = sample(kind, form, i, static_cast<int>(j));
  });
  return range;
}

}  // namespace etalon::procedural
