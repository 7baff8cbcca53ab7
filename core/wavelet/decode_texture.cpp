#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/float_environment.h"
#include "core/wavelet/plane_coder.h"
#include "core/wavelet/prefix_decoder.h"
#include "core/wavelet/reconstruct.h"
#include "core/wavelet/stream_header.h"
#include "core/wavelet/texture_stream.h"

namespace etalon::wavelet {
namespace {

struct PrefixesEnd {};

// Takes bits while they follow from the current prefix; then hands out its picture and goes on with the next.
class Reader {
 public:
  Reader(std::span<const std::byte> body, std::span<const std::size_t> prefixes, std::function<void(std::size_t)> on_end)
      : prefixes_(prefixes), on_end_(std::move(on_end)), decoder_(body, prefixes.front()) {}

  bool code(bool, AdaptiveBit& context) {
    const std::uint32_t probability = context.probability();
    while (!decoder_.is_determined(probability)) [[unlikely]] next_prefix();
    const bool bit = decoder_.decode(probability);
    context.learn(bit);
    return bit;
  }
  void on_significant() { ++significant_; }
  [[nodiscard]] std::size_t significant() const { return significant_; }
  [[nodiscard]] std::size_t needed_bytes() const { return decoder_.needed_bytes(); }
  [[nodiscard]] std::size_t index() const { return index_; }

 private:
  void next_prefix() {
    on_end_(index_);
    if (++index_ == prefixes_.size()) throw PrefixesEnd{};
    decoder_.set_known_bytes(prefixes_[index_]);
  }
  std::span<const std::size_t> prefixes_;
  std::function<void(std::size_t)> on_end_;
  PrefixDecoder decoder_;
  std::size_t index_ = 0, significant_ = 0;
};

}  // namespace

void decode_prefixes(std::span<const std::byte> stream, std::span<const std::size_t> prefix_bytes, const Delays& delays,
                     const std::function<void(std::size_t, DecodedTexture)>& on_prefix, const DecodeLimits& limits) {
  const DefaultFloatEnvironment environment;
  const TextureHeader header = read_texture_header(stream, limits);
  require_delays_fit(delays, header.width, header.height, header.levels);
  if (delays.empty() == header.has_delays || (header.has_delays && delays.checksum() != header.delays_checksum))
    throw InputError(fmt::format("texture stream: expected {}, got {}",
                                 header.has_delays ? fmt::format("delays of checksum {:08x}", header.delays_checksum) : "no delays",
                                 delays.empty() ? "none" : fmt::format("delays of checksum {:08x}", delays.checksum())));
  if (prefix_bytes.empty()) return;
  std::vector<std::size_t> body_prefixes;
  for (const std::size_t bytes : prefix_bytes) {
    if (bytes < header.bytes || bytes > stream.size() || (!body_prefixes.empty() && bytes - header.bytes < body_prefixes.back()))
      throw InputError(
          fmt::format("texture stream: expected ascending prefixes of {} to {} bytes, got {}", header.bytes, stream.size(), bytes));
    body_prefixes.push_back(bytes - header.bytes);
  }

  const std::vector<Subband> bands = make_subbands(header.width, header.height, header.levels, header.kernel);
  std::vector<BandState> states = fresh_states(header, bands, delays);
  const std::vector<Pass> passes = make_passes(states);
  Reader* running = nullptr;
  Reader reader(stream.subspan(header.bytes), body_prefixes, [&](std::size_t i) {
    on_prefix(i, {reconstruct(header, states), running->significant(), false});
  });
  running = &reader;
  const std::vector<BandTruth> no_truths;
  try {
    PlaneCoder(states, no_truths, reader).run(passes);
    // The rest of the prefixes hold the whole stream, unless its last bits needed none of the bytes that a prefix lacks.
    const Image image = reconstruct(header, states);
    for (std::size_t i = reader.index(); i < prefix_bytes.size(); ++i) on_prefix(i, {image, reader.significant(), true});
  } catch (const PrefixesEnd&) {
  }
}

DecodedTexture decode_texture(std::span<const std::byte> prefix, const Delays& delays, const DecodeLimits& limits) {
  DecodedTexture result;
  const std::size_t bytes = prefix.size();
  decode_prefixes(
      prefix, {&bytes, 1}, delays, [&](std::size_t, DecodedTexture decoded) { result = std::move(decoded); }, limits);
  return result;
}

}  // namespace etalon::wavelet
