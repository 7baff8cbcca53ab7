// SHA-256 against the published vectors (FIPS 180-4 examples and the NIST CAVP long message), and against itself in pieces.
#include "core/base/sha256.h"

#include <doctest/doctest.h>

#include <string>
#include <string_view>

#include "core/base/rng.h"

namespace {

std::string digest(std::string_view text) { return etalon::sha256_hex(std::as_bytes(std::span(text))); }

}  // namespace

TEST_CASE("sha256: the examples of FIPS 180-4") {
  CHECK(digest("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  CHECK(digest("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(digest("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
        "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}

TEST_CASE("sha256: a million times the letter a") {
  CHECK(digest(std::string(1'000'000, 'a')) == "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST_CASE("sha256: lengths around the padding boundary, against coreutils' sha256sum") {
  CHECK(digest(std::string(55, 'x')) == "d5e285683cd4efc02d021a5c62014694958901005d6f71e89e0989fac77e4072");
  CHECK(digest(std::string(56, 'x')) == "04c26261370ee7541549d16dee320c723e3fd14671e66a099afe0a377c16888e");
  CHECK(digest(std::string(63, 'x')) == "75220b47218278e656f2013bb8f0c455a25eaf01e86c64924e9d48d89776d6f2");
  CHECK(digest(std::string(64, 'x')) == "7ce100971f64e7001e8fe5a51973ecdfe1ced42befe7ee8d5fd6219506b5393c");
  CHECK(digest(std::string(65, 'x')) == "9537c5fdf120482f7d58d25e9ed583f52c02b4e304ea814db1633ad565aed7e9");
}

TEST_CASE("sha256: any cut into pieces gives the same digest") {
  etalon::Rng rng(1);
  std::string text;
  for (int i = 0; i < 1000; ++i) text += static_cast<char>(rng.below(256));
  const std::string whole = digest(text);
  for (int round = 0; round < 200; ++round) {
    etalon::Sha256 hash;
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t n = std::min<std::size_t>(rng.below(150), text.size() - at);
      hash.update(text.data() + at, n);
      at += n;
    }
    CHECK(hash.hex() == whole);
  }
}
