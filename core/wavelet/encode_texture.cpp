#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "core/base/arithmetic_coder.h"
#include "core/base/error.h"
#include "core/base/float_environment.h"
#include "core/wavelet/encode_plan.h"
#include "core/wavelet/plane_coder.h"
#include "core/wavelet/prefix_decoder.h"
#include "core/wavelet/stream_header.h"
#include "core/wavelet/texture_stream.h"

namespace etalon::wavelet {
namespace {

struct CodingEnds {};

// Bytes that must have settled after a bit, at the most, until the bits before them follow from the settled bytes alone.
constexpr std::size_t kWindowBytes = 4;

class Writer {
 public:
  Writer(std::size_t max_bytes, std::size_t max_significant) : max_bytes_(max_bytes), max_significant_(max_significant) {}

  bool code(bool truth, AdaptiveBit& context) {
    if (encoder_.settled_bytes() >= stop_at_) throw CodingEnds{};
    encoder_.encode(truth, context);
    return truth;
  }
  void on_significant() {
    if (++significant_ == max_significant_) stop_at_ = std::min(stop_at_, encoder_.settled_bytes() + kWindowBytes);
  }
  [[nodiscard]] std::string finish(bool is_complete) {
    if (is_complete) {
      const std::size_t end = encoder_.settled_bytes() + kWindowBytes;
      while (encoder_.settled_bytes() < end) encoder_.encode_even(0, 8);
    }
    const std::size_t settled = encoder_.settled_bytes();
    std::string bytes = encoder_.finish();
    bytes.resize(std::min(settled, max_bytes_));
    return bytes;
  }

 private:
  ArithmeticEncoder encoder_;
  std::size_t max_bytes_, max_significant_, significant_ = 0, stop_at_ = max_bytes_;
};

// Reads the encoder's own stream to see how many bytes each point needs.
class PointReader {
 public:
  PointReader(std::span<const std::byte> bytes, std::span<const std::size_t> targets) : decoder_(bytes, bytes.size()), targets_(targets) {}

  bool code(bool, AdaptiveBit& context) {
    if (points.size() == targets_.size() || !decoder_.is_determined(context.probability())) throw CodingEnds{};
    const bool bit = decoder_.decode(context.probability());
    context.learn(bit);
    return bit;
  }
  void on_significant() {
    ++significant_;
    while (points.size() < targets_.size() && targets_[points.size()] == significant_)
      points.push_back({decoder_.needed_bytes(), significant_});
  }
  std::vector<StreamPoint> points;

 private:
  PrefixDecoder decoder_;
  std::span<const std::size_t> targets_;
  std::size_t significant_ = 0;
};

// The same for points at the ends of passes.
class PassEndReader {
 public:
  PassEndReader(std::span<const std::byte> bytes, std::span<const std::size_t> ends) : decoder_(bytes, bytes.size()), ends_(ends) {
    record();
  }

  bool code(bool, AdaptiveBit& context) {
    if (points.size() == ends_.size() || !decoder_.is_determined(context.probability())) throw CodingEnds{};
    const bool bit = decoder_.decode(context.probability());
    context.learn(bit);
    return bit;
  }
  void on_significant() { ++significant_; }
  void on_pass_end() { ++passes_, record(); }
  std::vector<StreamPoint> points;

 private:
  void record() {
    while (points.size() < ends_.size() && ends_[points.size()] == passes_) points.push_back({decoder_.needed_bytes(), significant_});
  }
  PrefixDecoder decoder_;
  std::span<const std::size_t> ends_;
  std::size_t passes_ = 0, significant_ = 0;
};

// For each delay the number of passes up to the last with bits of coefficients of no longer delay: bit b >= 0 comes at plane b − delay.
std::vector<std::size_t> pass_ends(const std::vector<int>& delays, const std::vector<Pass>& passes) {
  std::vector<std::size_t> ends;
  for (const int delay : delays) {
    if (delay < 0 || delay > kMaxDelay)
      throw InputError(fmt::format("texture stream: expected delays of 0 to {}, got {}", kMaxDelay, delay));
    std::size_t end = passes.size();
    while (end > 0 && passes[end - 1].plane < -delay) --end;
    if (!ends.empty() && end < ends.back()) throw InputError("texture stream: expected ascending delays");
    ends.push_back(end);
  }
  return ends;
}

std::vector<std::size_t> point_targets(const std::vector<double>& shares, std::size_t total) {
  std::vector<std::size_t> targets;
  double before = 0;
  for (const double share : shares) {
    if (!(share > 0) || !(share <= 1) || share < before)
      throw InputError(fmt::format("texture stream: expected ascending shares in (0, 1], got {} after {}", share, before));
    before = share;
    const auto target = static_cast<std::size_t>(std::ceil(share * static_cast<double>(total)));
    if (total > 0) targets.push_back(std::clamp<std::size_t>(target, 1, total));
  }
  return targets;
}

template <class PointReader>
std::vector<StreamPoint> read_points(const EncodePlan& plan, const EncodeOptions& options, PointReader reader) {
  std::vector<BandState> states = fresh_states(plan.header, plan.bands, options.delays);
  const std::vector<BandTruth> no_truths;
  try {
    PlaneCoder(states, no_truths, reader).run(plan.passes);
  } catch (const CodingEnds&) {
  }
  return std::move(reader.points);
}

}  // namespace

EncodedTexture encode_texture(const Image& image, const EncodeOptions& options) {
  const DefaultFloatEnvironment environment;
  EncodePlan plan = plan_encoding(image, options);
  if (!options.significant_shares.empty() && !options.complete_delays.empty())
    throw InputError("texture stream: expected points by shares or by delays, got both");
  const std::vector<std::size_t> targets = point_targets(options.significant_shares, plan.significant_total),
                                 ends = pass_ends(options.complete_delays, plan.passes);

  EncodedTexture result;
  result.significant_total = plan.significant_total;
  result.bytes = header_bytes(plan.header);
  const std::size_t header_size = result.bytes.size();
  if (options.max_bytes != 0 && options.max_bytes < header_size)
    throw InputError(fmt::format("texture stream: expected a limit of at least {} bytes, got {}", header_size, options.max_bytes));
  Writer writer(options.max_bytes == 0 ? std::numeric_limits<std::size_t>::max() : options.max_bytes - header_size,
                options.stops_at_last_share && !targets.empty() ? targets.back() : 0);
  result.is_complete = true;
  try {
    PlaneCoder(plan.states, plan.truths, writer).run(plan.passes);
  } catch (const CodingEnds&) {
    result.is_complete = false;
  }
  const std::string body = writer.finish(result.is_complete);
  const auto settled = std::as_bytes(std::span(body));
  std::size_t used = settled.size();
  if (!targets.empty()) result.points = read_points(plan, options, PointReader(settled, targets));
  if (!ends.empty()) result.points = read_points(plan, options, PassEndReader(settled, ends));
  if (options.stops_at_last_share && !targets.empty() && !result.is_complete && result.points.size() == targets.size())
    used = result.points.back().bytes;
  for (StreamPoint& point : result.points) point.bytes += header_size;
  result.bytes.insert(result.bytes.end(), settled.begin(), settled.begin() + static_cast<std::ptrdiff_t>(used));
  return result;
}

}  // namespace etalon::wavelet
