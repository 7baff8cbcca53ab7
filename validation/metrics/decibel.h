// Decibels for people to read. Decisions compare the integers of image_difference.h; this is only for printing.
#pragma once

#include <cstdint>
#include <optional>

namespace etalon::validation {

/// 10·log10(x) for finite x > 0, from + − × ÷ and frexp alone: the same bits on every platform (libm's log10 may differ in the last one).
/// Error below 1e-12 dB + 4 ulp of the result.
[[nodiscard]] double decibel(double x);

/// Peak signal-to-noise ratio 10·log10(peak² · samples / sse), rounded to 1e-4 dB; nothing where sse is 0 (identical) or there are no samples.
[[nodiscard]] std::optional<double> psnr_db(double sse, std::uint64_t samples, double peak);

}  // namespace etalon::validation
