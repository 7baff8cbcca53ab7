#include "tests/validation/probe/simulated_device.h"

#include <algorithm>
#include <cmath>

#include "core/math/half.h"
#include "validation/bounded_triangle.h"

namespace etalon::test {
namespace {

double rounded(double x, SnapRounding rounding) {
  switch (rounding) {
    case SnapRounding::nearest_even: return std::nearbyint(x);
    case SnapRounding::half_up: return std::floor(x + 0.5);
    case SnapRounding::half_away: return std::round(x);
    case SnapRounding::toward_zero: return std::trunc(x);
    case SnapRounding::floor: return std::floor(x);
  }
  return x;
}

double texel(const Image& image, double i, double j) {
  const int x = static_cast<int>(std::clamp(i, 0.0, image.width() - 1.0)), y = static_cast<int>(std::clamp(j, 0.0, image.height() - 1.0));
  if (image.format().type == ChannelType::unorm8) return image.channels<std::uint8_t>(x, y)[0] / 255.0;
  return static_cast<double>(image.channels<float>(x, y)[0]);
}

}  // namespace

DrawList SimulatedDevice::on_own_grid(DrawList list, int bits) const {
  const auto snap = [&](std::int32_t x) {
    return static_cast<std::int32_t>(rounded(std::ldexp(x, arithmetic_.subtexel_bits - bits), arithmetic_.snap));
  };
  for (RasterVertex& v : list.vertices) v.x = snap(v.x), v.y = snap(v.y);
  return list;
}

double SimulatedDevice::looked_up(const Image& image, const Sampler& sampler, double u, double v) const {
  double x = u * image.width(), y = v * image.height();
  if (sampler.filter == Filter::nearest) {
    if (arithmetic_.coordinate_bits > 0) {
      const double scale = std::ldexp(1.0, arithmetic_.coordinate_bits);
      x = std::floor(x * scale + 0.5) / scale, y = std::floor(y * scale + 0.5) / scale;
    }
    return texel(image, std::floor(x), std::floor(y));
  }
  if (arithmetic_.weight_bits > 0) {
    const double scale = std::ldexp(1.0, arithmetic_.weight_bits);
    // Half to even, as processors round: of ties every other one goes the other way.
    const auto fixed = [&](double t) { return (arithmetic_.weights_rounded ? std::nearbyint(t * scale) : std::floor(t * scale)) / scale; };
    x = fixed(x - 0.5), y = fixed(y - 0.5);
  } else {
    x -= 0.5, y -= 0.5;
  }
  const double i = std::floor(x), j = std::floor(y), f = x - i, g = y - j;
  const double value = (1 - g) * ((1 - f) * texel(image, i, j) + f * texel(image, i + 1, j)) +
                       g * ((1 - f) * texel(image, i, j + 1) + f * texel(image, i + 1, j + 1));
  const bool as_byte = arithmetic_.byte_results && image.format().type == ChannelType::unorm8;
  return as_byte ? std::floor(value * 255 + 0.5) / 255 : value;
}

// Everything that is shaded covers the frame, texel by texel: the lookup's own result is copied through the exact storage.
Image SimulatedDevice::shaded(const DrawList& list, const Frame& frame, const TargetSpec& target) {
  Frame plain = frame;
  plain.targets = {{.content = TargetContent::coordinate, .format = kRg32f}};
  const Image uv = exact_.render(list, plain).front();
  const Draw& draw = list.draws.front();
  Image values(frame.width, frame.height, kR32f);
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      double u = static_cast<double>(uv.channels<float>(x, y)[0]), v = static_cast<double>(uv.channels<float>(x, y)[1]);
      if (draw.shading == Shading::indexed) {
        const Image& map = *list.images[draw.indexing_map];
        const float* entry =
            map.channels<float>(static_cast<int>(std::floor(u * map.width())), static_cast<int>(std::floor(v * map.height())));
        u = static_cast<double>(entry[0]), v = static_cast<double>(entry[1]);
      }
      *values.channels<float>(x, y) = static_cast<float>(looked_up(*list.images[draw.texture], draw.sampler, u, v));
    }
  }
  if (target.format.type == ChannelType::float32) return values;
  if (arithmetic_.half_up_halves && target.format.type == ChannelType::half) {
    Image halves(frame.width, frame.height, target.format);
    for (std::size_t n = 0; n < values.texel_count(); ++n) {
      const double value = static_cast<double>(values.channels<float>(0, 0)[n]);
      const std::uint16_t below = half_toward_zero(value);
      const double lo = half_to_double(below), hi = half_to_double(static_cast<std::uint16_t>(below + 1));
      const bool up = (below & 0x7FFF) < 0x7BFF && std::abs(value) >= std::abs(lo + hi) / 2;
      halves.channels<std::uint16_t>(0, 0)[n] = static_cast<std::uint16_t>(below + (up ? 1 : 0));
    }
    return halves;
  }
  DrawList copy = list;
  copy.images = {std::make_shared<const Image>(std::move(values))};
  copy.draws.front() = {.triangle_count = draw.triangle_count, .shading = Shading::texture, .texture = 0};
  plain.targets = {target};
  return exact_.render(copy, plain).front();
}

void SimulatedDevice::disturb(Image& coordinates, const Image& ids, const DrawList& list, const Frame& frame) const {
  const validation::DeviceModel shape = validation::measured_model("shape", 1, "");
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      const std::uint32_t id = *ids.channels<std::uint32_t>(x, y);
      if (id == kNoTriangle) continue;
      validation::BoundedTriangle triangle(list, id, frame, shape);
      const validation::Coordinate at = triangle.coordinate(triangle.evaluator().sample(x, y));
      if (!std::isfinite(at.error_u)) continue;
      const double value = at.u + arithmetic_.interpolation_error * at.error_u;
      coordinates.channels<float>(x, y)[0] = static_cast<float>(value);
    }
  }
}

std::vector<Image> SimulatedDevice::render(const DrawList& list, const Frame& frame) {
  Frame own = frame;
  own.state.subtexel_bits = arithmetic_.subtexel_bits;
  own.state.fill_rule = arithmetic_.fill_rule;
  own.state.half_rounding = arithmetic_.half_rounding;
  const DrawList snapped = on_own_grid(list, frame.state.subtexel_bits);
  if (frame.targets.front().content == TargetContent::color) return {shaded(snapped, own, frame.targets.front())};
  std::vector<Image> images = exact_.render(snapped, own);
  for (std::size_t n = 0; n < images.size(); ++n) {
    if (frame.targets[n].content == TargetContent::triangle_id && arithmetic_.dropped_edge_texel) {
      auto* ids = images[n].channels<std::uint32_t>(0, 0);
      auto* drawn = std::find_if(ids, ids + images[n].texel_count(), [](std::uint32_t id) { return id != kNoTriangle; });
      if (drawn != ids + images[n].texel_count()) *drawn = kNoTriangle;
    }
    if (frame.targets[n].content == TargetContent::coordinate && arithmetic_.interpolation_error != 0) {
      Frame id_frame = own;
      id_frame.targets = {{.content = TargetContent::triangle_id, .format = kR32ui}};
      disturb(images[n], exact_.render(snapped, id_frame).front(), snapped, own);
    }
  }
  return images;
}

}  // namespace etalon::test
