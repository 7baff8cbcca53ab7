// libFuzzer on FILE.draws: any bytes are refused by an InputError in one line that names the file, or are a list that is valid.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>

#include "core/base/error.h"
#include "core/io/draws_file.h"

namespace {

etalon::io::DrawsFile decoded(std::span<const std::byte> bytes) {
  return etalon::io::decode_draws(bytes, "fuzz.draws", "", [](const auto&, const auto&) { return etalon::Image(2, 3, etalon::kRgba8); });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const etalon::io::DrawsFile file = decoded(std::as_bytes(std::span(data, size)));
    validate(file.list, file.frame);
  } catch (const etalon::InputError& error) {
    const std::string message = error.what();
    if (!message.starts_with("fuzz.draws: ") || message.find('\n') != std::string::npos) std::abort();
  }
  return 0;
}
