// SHA-256 over numbers, not over memory: every value as the bytes of its little-endian form, so that machines of both byte orders agree.
#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/sha256.h"
#include "core/image/image.h"
#include "core/math/vec.h"
#include "core/mesh/mesh.h"

namespace etalon::test {

class CanonicalHash {
 public:
  template <std::unsigned_integral T>
  void add(T value) {
    std::array<std::byte, sizeof(T)> bytes;
    for (std::size_t k = 0; k < sizeof(T); ++k) bytes[k] = static_cast<std::byte>(value >> (8 * k));
    hash_.update(bytes);
  }
  void add(float value) { add(std::bit_cast<std::uint32_t>(value)); }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(const std::string& bytes) { hash_.update(bytes.data(), bytes.size()); }
  template <int N, class T, glm::qualifier Q>
  void add(const glm::vec<N, T, Q>& v) {
    for (int k = 0; k < N; ++k) add(v[k]);
  }
  void add(const Wedge& wedge) { add(wedge.vertex.index), add(wedge.uv); }
  template <class T, std::size_t N>
  void add(const std::array<T, N>& values) {
    for (const T& value : values) add(value);
  }
  template <class T>
  requires requires(T id) { id.index; }
  void add(const T& id) { add(id.index); }
  template <class T>
  void add(const std::vector<T>& values) {
    for (const T& value : values) add(value);
  }
  void add(const Mesh& mesh) { add(mesh.positions), add(mesh.colors), add(mesh.wedges), add(mesh.faces); }
  void add(const Image& image);

  [[nodiscard]] std::string hex() { return hash_.hex(); }

 private:
  Sha256 hash_;
};

}  // namespace etalon::test
