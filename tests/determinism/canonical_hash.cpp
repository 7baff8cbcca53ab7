#include "tests/determinism/canonical_hash.h"

#include <fmt/format.h>

namespace etalon::test {

void CanonicalHash::add(const Image& image) {
  add(fmt::format("{} {} {}\n", to_string(image.format()), image.width(), image.height()));
  const auto size = static_cast<std::size_t>(bytes_per_channel(image.format().type));
  const auto bytes = image.bytes();
  if (std::endian::native == std::endian::little) return hash_.update(bytes);
  std::vector<std::byte> swapped;
  swapped.reserve(bytes.size());
  for (std::size_t at = 0; at < bytes.size(); at += size)
    for (std::size_t k = size; k-- > 0;) swapped.push_back(bytes[at + k]);
  hash_.update(swapped);
}

}  // namespace etalon::test
