// libFuzzer on images by way of OpenImageIO and OpenEXR; one program for each signature (ETALON_FUZZ_SIGNATURE), so that none starves the others.
// The outside libraries are not instrumented: what is found in them is found by the address sanitizer's allocator or by a signal.
#include "core/base/error.h"
#include "core/io/exr_file.h"
#include "core/io/image_file.h"
#include "core/io/range_file.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/png_checksums.h"

using namespace etalon;
using namespace etalon::test;

namespace {

constexpr std::string_view kSignature = ETALON_FUZZ_SIGNATURE;

void read_as_image(std::span<const std::byte> bytes) {
  is_read("fuzz: ", [&] {
    const Image image = io::decode_image(bytes, "fuzz");
    require(image.width() >= 1 && image.height() >= 1 && image.width() <= kMaxImageSize && image.height() <= kMaxImageSize,
            "a size within the limits");
    (void)io::color_bytes(image, "fuzz: ");
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::byte> bytes = bytes_of(data, size);
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (!text.starts_with(kSignature)) return 0;
  read_as_image(bytes);
  if (kSignature == "\x76\x2f\x31\x01") is_read("fuzz: ", [&] { (void)io::decode_exr(bytes, "fuzz"); });
  if (kSignature == "\x89PNG") read_as_image(with_png_checksums(bytes));
  return 0;
}
