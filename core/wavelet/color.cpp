#include "core/wavelet/color.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/parallel.h"

namespace etalon::wavelet {
namespace {

constexpr double kRed = 0.299, kGreen = 0.587, kBlue = 0.114;
constexpr double kRedOfCr = 2 * (1 - kRed), kBlueOfCb = 2 * (1 - kBlue);
constexpr double kGreenOfCr = kRedOfCr * kRed / kGreen, kGreenOfCb = kBlueOfCb * kBlue / kGreen;

void require_bytes(PixelFormat format) {
  const bool bytes = format.type == ChannelType::unorm8 || format.type == ChannelType::srgb8;
  if (!bytes || (format.channels != 1 && format.channels != 3))
    throw InputError(fmt::format("texture: expected 1 or 3 channels of 8 bits, got {}", to_string(format)));
}

template <class Body>
void for_rows(int height, const Body& body) {
  parallel_for_blocks(static_cast<std::size_t>(height), 32, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) body(static_cast<int>(y));
  });
}

std::uint8_t to_byte(std::int32_t x) { return static_cast<std::uint8_t>(std::clamp<std::int64_t>(std::int64_t{x} + 128, 0, 255)); }
// NaN cannot come out of finite coefficients; the comparison would send it to 0.
std::uint8_t to_byte(double x) {
  const double shifted = x + 128.5;
  return static_cast<std::uint8_t>(shifted > 0 ? (shifted < 255 ? shifted : 255) : 0);
}

// Two's complement, since hostile coefficients may be any numbers.
std::int32_t wrap(std::int64_t x) { return static_cast<std::int32_t>(static_cast<std::uint32_t>(static_cast<std::uint64_t>(x))); }

}  // namespace

std::vector<Plane<std::int32_t>> reversible_planes(const Image& image) {
  require_bytes(image.format());
  const int channels = image.format().channels;
  std::vector<Plane<std::int32_t>> planes(static_cast<std::size_t>(channels), {image.width(), image.height()});
  for_rows(image.height(), [&](int y) {
    const auto* texel = image.channels<std::uint8_t>(0, y);
    std::int32_t* luma = planes[0].row(y);
    if (channels == 1) {
      for (int x = 0; x < image.width(); ++x) luma[x] = texel[x] - 128;
      return;
    }
    std::int32_t *u = planes[1].row(y), *v = planes[2].row(y);
    for (int x = 0; x < image.width(); ++x, texel += 3) {
      const std::int32_t r = texel[0], g = texel[1], b = texel[2];
      luma[x] = ((r + 2 * g + b) >> 2) - 128;
      u[x] = b - g;
      v[x] = r - g;
    }
  });
  return planes;
}

Image reversible_image(const std::vector<Plane<std::int32_t>>& planes, PixelFormat format) {
  require_bytes(format);
  Image image(planes[0].width, planes[0].height, format);
  for_rows(image.height(), [&](int y) {
    auto* texel = image.channels<std::uint8_t>(0, y);
    const std::int32_t* luma = planes[0].row(y);
    if (format.channels == 1) {
      for (int x = 0; x < image.width(); ++x) texel[x] = to_byte(luma[x]);
      return;
    }
    const std::int32_t *u = planes[1].row(y), *v = planes[2].row(y);
    for (int x = 0; x < image.width(); ++x, texel += 3) {
      const std::int64_t g = luma[x] - ((std::int64_t{u[x]} + v[x]) >> 2);
      texel[0] = to_byte(wrap(v[x] + g));
      texel[1] = to_byte(wrap(g));
      texel[2] = to_byte(wrap(u[x] + g));
    }
  });
  return image;
}

std::vector<Plane<double>> irreversible_planes(const Image& image) {
  require_bytes(image.format());
  const int channels = image.format().channels;
  std::vector<Plane<double>> planes(static_cast<std::size_t>(channels), {image.width(), image.height()});
  for_rows(image.height(), [&](int y) {
    const auto* texel = image.channels<std::uint8_t>(0, y);
    double* luma = planes[0].row(y);
    if (channels == 1) {
      for (int x = 0; x < image.width(); ++x) luma[x] = texel[x] - 128.0;
      return;
    }
    double *cb = planes[1].row(y), *cr = planes[2].row(y);
    for (int x = 0; x < image.width(); ++x, texel += 3) {
      const double r = texel[0] - 128.0, g = texel[1] - 128.0, b = texel[2] - 128.0;
      const double light = kRed * r + kGreen * g + kBlue * b;
      luma[x] = light;
      cb[x] = (b - light) / kBlueOfCb;
      cr[x] = (r - light) / kRedOfCr;
    }
  });
  return planes;
}

Image irreversible_image(const std::vector<Plane<double>>& planes, PixelFormat format) {
  require_bytes(format);
  Image image(planes[0].width, planes[0].height, format);
  for_rows(image.height(), [&](int y) {
    auto* texel = image.channels<std::uint8_t>(0, y);
    const double* luma = planes[0].row(y);
    if (format.channels == 1) {
      for (int x = 0; x < image.width(); ++x) texel[x] = to_byte(luma[x]);
      return;
    }
    const double *cb = planes[1].row(y), *cr = planes[2].row(y);
    for (int x = 0; x < image.width(); ++x, texel += 3) {
      texel[0] = to_byte(luma[x] + kRedOfCr * cr[x]);
      texel[1] = to_byte(luma[x] - kGreenOfCb * cb[x] - kGreenOfCr * cr[x]);
      texel[2] = to_byte(luma[x] + kBlueOfCb * cb[x]);
    }
  });
  return image;
}

double channel_norm(int channel, int channels, Kernel kernel) {
  if (channels == 1) return 1;
  if (channel == 0) return std::sqrt(3.0);
  if (kernel == Kernel::reversible_5_3) return std::sqrt(11.0 / 16);  // e.g. U: B +3/4, G −1/4, R −1/4
  const double own = channel == 1 ? kBlueOfCb : kRedOfCr, green = channel == 1 ? kGreenOfCb : kGreenOfCr;
  return std::sqrt(own * own + green * green);
}

}  // namespace etalon::wavelet
