#include "validation/texel_diff.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <tuple>

#include "core/base/error.h"
#include "core/base/parallel.h"

namespace etalon::validation {

namespace {

constexpr std::size_t kRowsPerBlock = 16;

void check_images(const Frame& frame, std::span<const Image> images, const char* side) {
  if (images.size() != frame.targets.size()) {
    throw InputError(fmt::format("{} images: expected {}, one per target, got {}", side, frame.targets.size(), images.size()));
  }
  for (std::size_t i = 0; i < images.size(); ++i) {
    const Image& image = images[i];
    if (image.empty()) continue;
    if (image.width() != frame.width || image.height() != frame.height || image.format() != frame.targets[i].format) {
      throw InputError(fmt::format("{} image {} ({}): expected {} × {} {}, got {} × {} {}", side, i, to_string(frame.targets[i].content),
                                   frame.width, frame.height, to_string(frame.targets[i].format), image.width(), image.height(),
                                   to_string(image.format())));
    }
  }
}

void check_input(const Frame& frame, std::span<const Image> golden, std::span<const Image> candidate) {
  check_images(frame, golden, "golden");
  check_images(frame, candidate, "candidate");
  for (std::size_t i = 0; i < frame.targets.size(); ++i) {
    if (is_compared(frame.targets[i].content) && !golden[i].empty() && !candidate[i].empty()) return;
  }
  throw InputError("nothing to compare: no target is given on both sides");
}

// Most severe first; equal severity by share, then by position, so that any merge order gives the same list.
bool worse(const TexelReport& a, const TexelReport& b) {
  return std::make_tuple(-static_cast<int>(a.verdict.texel_class), -a.verdict.share, a.y, a.x) <
         std::make_tuple(-static_cast<int>(b.verdict.texel_class), -b.verdict.share, b.y, b.x);
}

void keep_worst(std::vector<TexelReport>& worst, TexelReport report, std::size_t count) {
  if (count == 0 || (worst.size() == count && !worse(report, worst.back()))) return;
  worst.insert(std::upper_bound(worst.begin(), worst.end(), report, worse), std::move(report));
  if (worst.size() > count) worst.pop_back();
}

std::string hex_of(const Image& image, int x, int y) {
  if (image.empty()) return {};
  std::string text;
  const int size = bytes_per_channel(image.format().type);
  for (int c = 0; c < image.format().channels; ++c) {
    if (c > 0) text += ' ';
    for (int b = size - 1; b >= 0; --b) text += fmt::format("{:02x}", static_cast<unsigned>(image.texel(x, y)[c * size + b]));
  }
  return text;
}

void complete(TexelReport& report, TexelExplainer& explainer, const DiffInput& input) {
  for (std::size_t i = 0; i < input.frame.targets.size(); ++i) {
    report.golden_bytes.push_back(hex_of(input.golden[i], report.x, report.y));
    report.candidate_bytes.push_back(hex_of(input.candidate[i], report.x, report.y));
  }
  report.sentence = explainer.describe(report.x, report.y, report.verdict);
}

struct BlockResult {
  ClassCounts counts;
  std::array<std::uint64_t, kCauseCount> unexplained_by{};
  std::vector<TexelReport> worst;
  double rounding_share = 0, tie_share = 0;
};

// Texels of the row whose bytes differ in some compared target.
void find_differences(const DiffInput& input, int y, std::vector<std::uint8_t>& differs) {
  std::fill(differs.begin(), differs.end(), std::uint8_t{0});
  for (std::size_t i = 0; i < input.frame.targets.size(); ++i) {
    const Image &a = input.golden[i], &b = input.candidate[i];
    if (!is_compared(input.frame.targets[i].content) || a.empty() || b.empty()) continue;
    const auto size = static_cast<std::size_t>(bytes_per_texel(a.format()));
    const std::byte *row_a = a.texel(0, y), *row_b = b.texel(0, y);
    if (std::memcmp(row_a, row_b, size * differs.size()) == 0) continue;
    for (std::size_t x = 0; x < differs.size(); ++x) differs[x] |= std::memcmp(row_a + x * size, row_b + x * size, size) != 0;
  }
}

}  // namespace

std::uint64_t ClassCounts::total() const {
  std::uint64_t sum = 0;
  for (const std::uint64_t n : texels) sum += n;
  return sum;
}

ClassCounts& ClassCounts::operator+=(const ClassCounts& other) {
  for (std::size_t i = 0; i < texels.size(); ++i) texels[i] += other.texels[i];
  return *this;
}

DiffResult diff_images(const DrawList& list, const Frame& frame, const DeviceModel& device, std::span<const Image> golden,
                       std::span<const Image> candidate, const DiffOptions& options) {
  check_input(frame, golden, candidate);
  const DiffInput input{list, frame, device, golden, candidate};
  const auto worst_count = static_cast<std::size_t>(std::max(0, options.worst_count));
  DiffResult result;
  result.bound_origin = device.origin;
  result.bound_valid_for = device.valid_for;
  if (options.keep_class_image) result.class_image = Image(frame.width, frame.height, {ChannelType::unorm8, 1});

  TexelExplainer::SharedGrid grid;
  const std::size_t rows = static_cast<std::size_t>(frame.height);
  std::vector<BlockResult> blocks((rows + kRowsPerBlock - 1) / kRowsPerBlock);
  parallel_for_blocks(rows, kRowsPerBlock, [&](std::size_t begin, std::size_t end) {
    BlockResult& block = blocks[begin / kRowsPerBlock];
    TexelExplainer explainer(input, grid);
    std::vector<std::uint8_t> differs(static_cast<std::size_t>(frame.width));
    for (std::size_t row = begin; row < end; ++row) {
      const int y = static_cast<int>(row);
      find_differences(input, y, differs);
      for (int x = 0; x < frame.width; ++x) {
        if (differs[static_cast<std::size_t>(x)] == 0) {
          ++block.counts[TexelClass::identical];
          continue;
        }
        TexelReport report{.x = x, .y = y, .verdict = explainer.explain(x, y)};
        const TexelVerdict& verdict = report.verdict;
        ++block.counts[verdict.texel_class];
        if (verdict.texel_class == TexelClass::unexplained) ++block.unexplained_by[static_cast<std::size_t>(verdict.cause)];
        if (verdict.texel_class == TexelClass::rounding) block.rounding_share = std::max(block.rounding_share, verdict.share);
        if (verdict.texel_class == TexelClass::tie) block.tie_share = std::max(block.tie_share, verdict.share);
        if (options.keep_class_image) *result.class_image.channels<std::uint8_t>(x, y) = static_cast<std::uint8_t>(verdict.texel_class);
        keep_worst(block.worst, std::move(report), worst_count);
      }
    }
  });
  for (BlockResult& block : blocks) {
    result.counts += block.counts;
    for (std::size_t i = 0; i < kCauseCount; ++i) result.unexplained_by[i] += block.unexplained_by[i];
    result.largest_rounding_share = std::max(result.largest_rounding_share, block.rounding_share);
    result.largest_tie_share = std::max(result.largest_tie_share, block.tie_share);
    for (TexelReport& report : block.worst) keep_worst(result.worst, std::move(report), worst_count);
  }
  TexelExplainer explainer(input, grid);
  for (TexelReport& report : result.worst) complete(report, explainer, input);
  return result;
}

TexelReport explain_texel(const DrawList& list, const Frame& frame, const DeviceModel& device, std::span<const Image> golden,
                          std::span<const Image> candidate, int x, int y) {
  check_input(frame, golden, candidate);
  if (x < 0 || x >= frame.width || y < 0 || y >= frame.height) {
    throw InputError(fmt::format("texel ({}, {}) is outside the frame of {} × {}", x, y, frame.width, frame.height));
  }
  const DiffInput input{list, frame, device, golden, candidate};
  TexelExplainer::SharedGrid grid;
  TexelExplainer explainer(input, grid);
  TexelReport report{.x = x, .y = y, .verdict = explainer.explain(x, y)};
  complete(report, explainer, input);
  return report;
}

std::string format_counts(const DiffResult& result) {
  std::string text;
  const auto total = static_cast<double>(std::max<std::uint64_t>(1, result.counts.total()));
  for (int c = 0; c < kClassCount; ++c) {
    const auto cls = static_cast<TexelClass>(c);
    text += fmt::format("{:<12}{:>14}  {:>10.6f} %\n", to_string(cls), result.counts[cls],
                        100 * static_cast<double>(result.counts[cls]) / total);
  }
  if (result.counts[TexelClass::unexplained] > 0) {
    text += fmt::format("unexplained by: coverage {}, depth order {}, texel choice {}, value {}\n", result.unexplained_by[1],
                        result.unexplained_by[2], result.unexplained_by[3], result.unexplained_by[4]);
  }
  text += fmt::format("largest share of a bound: rounding {:.3f}, tie {:.3f}; bounds {} for {}\n", result.largest_rounding_share,
                      result.largest_tie_share, to_string(result.bound_origin), result.bound_valid_for);
  return text;
}

}  // namespace etalon::validation
