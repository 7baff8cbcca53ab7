// Streams that are cut, damaged or made up: refused, or some picture; never a crash and never much memory.
#include <doctest/doctest.h>

#include <cstdlib>

#include "core/base/error.h"
#include "core/base/rng.h"
#include "core/wavelet/checksum.h"
#include "core/wavelet/texture_stream.h"
#include "tests/wavelet/sample_textures.h"

using namespace etalon;
using namespace etalon::wavelet;

namespace {

constexpr DecodeLimits kSmall{.max_texels = 4096};

// Its checksum made right again, so that the body is decoded under a damaged header.
void repair_header(std::vector<std::byte>& stream) {
  const std::size_t end = 13 + ((std::to_integer<int>(stream[5]) & 2) != 0 ? 4 : 0);
  if (stream.size() < end + 2) return;
  Crc32 crc;
  for (std::size_t i = 0; i < end; ++i) crc.add(std::to_integer<std::uint8_t>(stream[i]));
  stream[end] = static_cast<std::byte>(crc.value() & 0xFF);
  stream[end + 1] = static_cast<std::byte>((crc.value() >> 8) & 0xFF);
}

// True if it was decoded.
bool decodes(const std::vector<std::byte>& stream, const Delays& delays) {
  try {
    const TextureHeader header = read_texture_header(stream, kSmall);
    const DecodedTexture decoded = decode_texture(stream, header.has_delays ? delays : Delays{}, kSmall);
    CHECK(decoded.image.width() == header.width);
    CHECK(decoded.image.height() == header.height);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

TEST_CASE("hostile streams: every truncation is refused within the header and a picture behind it") {
  const Image image = test::landscape_texture(33, 21);
  for (const Kernel kernel : {Kernel::reversible_5_3, Kernel::irreversible_9_7}) {
    const std::vector<std::byte> whole = encode_texture(image, {.kernel = kernel}).bytes;
    for (std::size_t n = 0; n <= whole.size(); ++n)
      CHECK(decodes({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(n)}, {}) == (n >= 15));
  }
}

TEST_CASE("hostile streams: each field of the header is checked, and named with its byte") {
  const std::vector<std::byte> good = encode_texture(test::landscape_texture(16, 16)).bytes;
  const auto refusal = [&](std::size_t at, int value, bool is_repaired = true) -> std::string {
    std::vector<std::byte> bad = good;
    bad[at] = static_cast<std::byte>(value);
    if (is_repaired) repair_header(bad);
    try {
      (void)decode_texture(bad, {}, kSmall);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  CHECK(refusal(0, 'x') == "texture stream: byte 0: expected the signature eTWS");
  CHECK(refusal(4, 2) == "texture stream: byte 4: expected version 1, got 2");
  CHECK(refusal(5, 16) == "texture stream: byte 5: expected flags below 16, got 16");
  CHECK(refusal(6, 0) == "texture stream: byte 6: expected 1 to 12 levels, got 0");
  CHECK(refusal(6, 13) == "texture stream: byte 6: expected 1 to 12 levels, got 13");
  CHECK(refusal(8, 255) == "texture stream: byte 7: expected at most 4096 texels (and 32768 a side), got 65296 x 16");
  CHECK(refusal(11, 0) == "texture stream: byte 11: expected a step exponent of -6 to 6, got -64");
  CHECK(refusal(12, 255) == "texture stream: byte 12: expected a top exponent up to 40, got 191");
  CHECK(refusal(12, 255, false) == "texture stream: byte 13: the header's checksum is wrong");
  CHECK(refusal(11, 64) == "");
}

TEST_CASE("hostile streams: mutants are refused or decode to some picture") {
  const Image image = test::landscape_texture(37, 29);
  const Delays delays = make_delays(
      37, 29, 2, [](const Subband& band, int x, int y) -> int { return (x + y) % 9 == 0 ? kNeverSent : 7 * band.level * (x % 5); });
  std::vector<std::vector<std::byte>> seeds;
  for (const Kernel kernel : {Kernel::reversible_5_3, Kernel::irreversible_9_7}) {
    seeds.push_back(encode_texture(image, {.kernel = kernel, .levels = 2}).bytes);
    seeds.push_back(encode_texture(image, {.kernel = kernel, .levels = 2, .delays = delays}).bytes);
  }
  Rng rng(2026);
  const char* full = std::getenv("ETALON_FULL");
  const int mutants = full != nullptr && *full != '\0' ? 1'000'000 : 20'000;
  int decoded = 0, refused = 0;
  for (int i = 0; i < mutants; ++i) {
    std::vector<std::byte> stream = seeds[rng.below(seeds.size())];
    stream.resize(1 + rng.below(std::min<std::size_t>(stream.size(), rng.coin() ? 60 : 600)));
    for (std::uint64_t n = 1 + rng.below(8); n > 0; --n) {
      const std::size_t at = rng.below(rng.coin() ? std::min<std::size_t>(stream.size(), 20) : stream.size());
      stream[at] = static_cast<std::byte>(rng.next() & 0xFF);
    }
    if (stream.size() > 5 && rng.below(4) != 0) {
      const std::string_view magic = "eTWS\1";
      for (std::size_t k = 0; k < magic.size(); ++k) stream[k] = static_cast<std::byte>(magic[k]);
      stream[5] &= std::byte{15};
      if (stream.size() > 15 && rng.below(4) != 0) {
        for (const std::size_t high : {std::size_t{8}, std::size_t{10}}) stream[high] = std::byte{0};
        stream[6] = static_cast<std::byte>(1 + rng.below(4));
        stream[11] = static_cast<std::byte>(60 + rng.below(8));
        stream[12] = static_cast<std::byte>(60 + rng.below(44));
      }
      repair_header(stream);
    }
    (decodes(stream, delays) ? decoded : refused) += 1;
  }
  // Both must occur often, or the mutants test nothing.
  CHECK(decoded > mutants / 10);
  CHECK(refused > mutants / 10);
}
