// Damage as files meet it: a few changed bytes, stretches removed, doubled or moved, an end cut off, a number made larger.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/rng.h"

namespace etalon::test {

/// A place in a file of `size` bytes, size > 0; one in two within the first 512, where headers stand.
inline std::size_t place_in(std::size_t size, Rng& rng) { return rng.below(rng.coin() ? std::min<std::size_t>(size, 512) : size); }

/// The digits around `at` become another number; false where there are none.
inline bool change_number(std::string& bytes, std::size_t at, Rng& rng) {
  static constexpr std::array<std::string_view, 8> kNumbers = {"0",     "-1",   "4294967295", "2147483648",
                                                               "65536", "1e39", "nan",        "99999999999999999999"};
  constexpr std::string_view kDigits = "0123456789";
  const std::size_t begin = bytes.find_first_of(kDigits, at);
  if (begin == std::string::npos) return false;
  const std::size_t end = std::min(bytes.find_first_not_of(kDigits, begin), bytes.size());
  bytes.replace(begin, end - begin, kNumbers[rng.below(kNumbers.size())]);
  return true;
}

/// `whole`, not empty, with one to four such changes; never empty.
inline std::string mutant_of(std::string whole, Rng& rng) {
  static constexpr std::array<unsigned char, 6> kTelling = {0x00, 0x01, 0x7F, 0x80, 0xFE, 0xFF};
  for (std::uint64_t n = 1 + rng.below(4); n > 0; --n) {
    const std::size_t at = place_in(whole.size(), rng);
    const std::size_t length = 1 + rng.below(rng.coin() ? 8 : 512);
    switch (rng.below(9)) {
      case 0: whole.erase(at, std::min(length, whole.size() - 1)); break;
      case 1: whole.insert(at, whole.substr(at, length)); break;
      case 2: whole.insert(at, whole.substr(place_in(whole.size(), rng), length)); break;
      case 3: whole.resize(std::max<std::size_t>(at, 1)); break;
      case 4: change_number(whole, at, rng); break;
      case 5:
        whole.replace(at, std::min<std::size_t>(4, whole.size() - at), 4, static_cast<char>(kTelling[rng.below(kTelling.size())]));
        break;
      case 6: whole[at] = static_cast<char>(kTelling[rng.below(kTelling.size())]); break;
      case 7: whole[at] = static_cast<char>(rng.below(256)); break;
      default: whole[at] = static_cast<char>(static_cast<unsigned char>(whole[at]) ^ (1u << rng.below(8)));
    }
  }
  return whole;
}

}  // namespace etalon::test
