// The two sources of scalars behind the PLY reader: binary in either byte order, and ascii. Not for use outside core/io.
// Both fail with the place of the scalar last read, and end the file with InputError instead of reading past it.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/io/input_error.h"
#include "core/io/ply_header.h"
#include "core/io/text_scan.h"

namespace etalon::io {

/// Scalars of a binary body.
template <bool kSwap>
class BinarySource {
 public:
  BinarySource(const std::string& file, std::span<const std::byte> content, const PlyHeader& header)
      : file_(file), content_(content), at_(header.body_offset_bytes) {}

  [[noreturn]] void fail(const std::string& what) const { fail_at_byte(file_, last_, what); }

  float real(PlyType type) {
    if (type == PlyType::float32) return raw<float>();
    // A double beyond float32 becomes inf (IEEE conversion) and is refused as such.
    if (type == PlyType::float64) return static_cast<float>(raw<double>());
    return static_cast<float>(integer(type));
  }
  std::int64_t integer(PlyType type) {
    switch (type) {
      case PlyType::int8: return raw<std::int8_t>();
      case PlyType::uint8: return raw<std::uint8_t>();
      case PlyType::int16: return raw<std::int16_t>();
      case PlyType::uint16: return raw<std::uint16_t>();
      case PlyType::int32: return raw<std::int32_t>();
      case PlyType::uint32: return raw<std::uint32_t>();
      case PlyType::float32:
      case PlyType::float64: break;
    }
    fail("expected an integer, got a real number");
  }
  void skip(PlyType type, std::uint64_t count) {
    last_ = at_;
    if (count > (content_.size() - at_) / size_bytes(type)) fail("the file ends early");
    at_ += count * size_bytes(type);
  }
  /// Whether `count` more values of this type can be there at all.
  [[nodiscard]] bool can_hold(PlyType type, std::uint64_t count) const { return count <= (content_.size() - at_) / size_bytes(type); }

 private:
  template <class T>
  T raw() {
    last_ = at_;
    if (content_.size() - at_ < sizeof(T))
      fail(fmt::format("the file ends early: expected {} more bytes, got {}", sizeof(T), content_.size() - at_));
    std::array<std::byte, sizeof(T)> bytes;
    std::memcpy(bytes.data(), content_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    if constexpr (kSwap) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<T>(bytes);
  }
  const std::string& file_;
  std::span<const std::byte> content_;
  std::size_t at_;
  std::size_t last_ = 0;  // offset of the scalar last read
};

/// Scalars of an ascii body; one row a line is usual but not asked for.
class AsciiSource {
 public:
  AsciiSource(const std::string& file, std::string_view content, const PlyHeader& header)
      : file_(file), rest_(content.substr(header.body_offset_bytes)), line_(header.line_count + 1) {}

  [[noreturn]] void fail(const std::string& what) const { fail_at_line(file_, line_, what); }

  float real(PlyType) {
    const std::string_view word = next();
    const std::optional<float> value = parse_float(word);
    if (!value) fail(fmt::format("expected a finite number, got '{}'", printable(word)));
    return *value;
  }
  std::int64_t integer(PlyType) {
    const std::string_view word = next();
    const std::optional<std::int64_t> value = parse_integer(word);
    if (!value) fail(fmt::format("expected an integer, got '{}'", printable(word)));
    return *value;
  }
  void skip(PlyType, std::uint64_t count) {
    for (; count > 0; --count) next();
  }
  [[nodiscard]] bool can_hold(PlyType, std::uint64_t count) const { return count <= (rest_.size() + 1) / 2; }

 private:
  std::string_view next() {
    while (!rest_.empty() && (is_blank(rest_.front()) || rest_.front() == '\n')) {
      line_ += rest_.front() == '\n';
      rest_.remove_prefix(1);
    }
    std::size_t end = 0;
    while (end < rest_.size() && !is_blank(rest_[end]) && rest_[end] != '\n') ++end;
    if (end == 0) fail("the file ends early: expected a number");
    const std::string_view word = rest_.substr(0, end);
    rest_.remove_prefix(end);
    return word;
  }
  const std::string& file_;
  std::string_view rest_;
  std::size_t line_;
};

}  // namespace etalon::io
