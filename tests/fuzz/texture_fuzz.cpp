// libFuzzer on texture streams (wavelets): as the bytes are, and with the header's checksum made right; half of the bytes decode too.
#include <vector>

#include "core/wavelet/checksum.h"
#include "core/wavelet/texture_stream.h"
#include "tests/fuzz/fuzz_target.h"

using namespace etalon;
using namespace etalon::test;

namespace {

constexpr wavelet::DecodeLimits kLimits{.max_texels = 1 << 11};

void read(std::span<const std::byte> bytes) {
  is_read("texture stream: ", [&] {
    const wavelet::TextureHeader header = wavelet::read_texture_header(bytes, kLimits);
    const wavelet::DecodedTexture whole = wavelet::decode_texture(bytes, {}, kLimits);
    require(whole.image.width() == header.width && whole.image.height() == header.height, "a picture of the header's size");
    const wavelet::DecodedTexture half = wavelet::decode_texture(bytes.first(std::max(header.bytes, bytes.size() / 2)), {}, kLimits);
    require(half.significant <= whole.significant, "more bytes tell more");
  });
}

void repair(std::vector<std::byte>& stream) {
  if (stream.size() < 6) return;
  const std::size_t end = 13 + ((std::to_integer<int>(stream[5]) & 2) != 0 ? 4 : 0);
  if (stream.size() < end + 2) return;
  wavelet::Crc32 crc;
  for (std::size_t i = 0; i < end; ++i) crc.add(std::to_integer<std::uint8_t>(stream[i]));
  stream[end] = static_cast<std::byte>(crc.value() & 0xFF);
  stream[end + 1] = static_cast<std::byte>((crc.value() >> 8) & 0xFF);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return read_and_read_repaired(
      data, size, [](std::span<const std::byte> bytes) { read(bytes); }, repair);
}
