// "1024x768" or "1024": the size of a frame on the command line.
#pragma once

#include <string>

namespace etalon::cli {

struct FrameSize {
  int width = 0;
  int height = 0;
  friend bool operator==(const FrameSize&, const FrameSize&) = default;
};

/// Frame and guard band of 2048 texels on each side must fit in 16384 (docs/contract.md#input).
inline constexpr int kMaxFrameSize = 16384 - 2 * 2048;

/// `text`: WxH or one number for a square, each 1..largest, decimal digits only. UsageError says what was expected and got.
[[nodiscard]] FrameSize parse_size(const std::string& text, int largest = kMaxFrameSize);

}  // namespace etalon::cli
