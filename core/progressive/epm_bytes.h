// Numbers as little-endian bytes, written and read with bounds.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include <fmt/format.h>

#include "core/base/error.h"

namespace etalon::progressive {

class ByteWriter {
 public:
  void u8(std::uint8_t x) { bytes_.push_back(static_cast<char>(x)); }
  void u32(std::uint32_t x) {
    for (int i = 0; i < 4; ++i) u8(static_cast<std::uint8_t>(x >> (8 * i)));
  }
  void u64(std::uint64_t x) {
    u32(static_cast<std::uint32_t>(x));
    u32(static_cast<std::uint32_t>(x >> 32));
  }
  void f32(float x) { u32(std::bit_cast<std::uint32_t>(x)); }
  void append(const std::string& bytes) { bytes_ += bytes; }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Reads from a block that starts at byte `offset` of its file; past its end an InputError names the byte.
class ByteReader {
 public:
  ByteReader(std::span<const std::byte> bytes, std::size_t offset) : bytes_(bytes), offset_(offset) {}
  [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }
  [[nodiscard]] std::size_t place() const { return offset_ + at_; }

  std::uint8_t u8() {
    require(1);
    return static_cast<std::uint8_t>(bytes_[at_++]);
  }
  std::uint32_t u32() {
    require(4);
    std::uint32_t x = 0;
    for (int i = 0; i < 4; ++i) x |= static_cast<std::uint32_t>(bytes_[at_++]) << (8 * i);
    return x;
  }
  std::uint64_t u64() {
    const std::uint64_t low = u32();
    return low | (static_cast<std::uint64_t>(u32()) << 32);
  }
  float f32() { return std::bit_cast<float>(u32()); }
  std::span<const std::byte> take(std::size_t count) {
    require(count);
    at_ += count;
    return bytes_.subspan(at_ - count, count);
  }
  void require_end() const {
    if (left() > 0) throw InputError(fmt::format("byte {}: expected the end of the chunk, got {} more bytes", place(), left()));
  }

 private:
  void require(std::size_t count) const {
    if (count > left()) throw InputError(fmt::format("byte {}: expected {} more bytes, got {}", place(), count, left()));
  }
  std::span<const std::byte> bytes_;
  std::size_t offset_ = 0, at_ = 0;
};

}  // namespace etalon::progressive
