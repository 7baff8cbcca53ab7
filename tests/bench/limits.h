// What no renderer on this machine can beat: moving the bytes of a scene, and reading its texels from a table.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace etalon::bench {

/// memcpy of `bytes` bytes, on as many threads as all parallel work has.
class CopyLimit {
 public:
  explicit CopyLimit(std::size_t bytes);
  void run();

 private:
  std::vector<std::byte> from_, to_;
};

enum class GatherOrder : std::uint8_t {
  affine,  ///< along a rotated line, as rotated texturing reads
  random,
};

/// Reads `count` elements (rounded up to whole rows of 1024) of a square power-of-two table and stores them one after another, on as many
/// threads as all parallel work has, by the fastest of plain code and the gather instructions that this CPU has.
class GatherLimit {
 public:
  /// The table is the largest square of a power of two not above `table_elements`, at least 64 × 64; elements of 4 or 8 bytes.
  GatherLimit(std::size_t count, std::size_t table_elements, std::size_t element_bytes, GatherOrder order);
  void run();
  /// "scalar", "avx2" or "avx512": what is run, chosen by a first measurement.
  [[nodiscard]] std::string method() const;

 private:
  using Kernel = void (*)(const GatherLimit&, std::size_t first_row, std::size_t end_row);
  friend struct GatherKernels;

  void run(Kernel kernel);

  std::size_t rows_;
  std::uint32_t side_bits_;
  std::size_t element_bytes_;
  GatherOrder order_;
  std::vector<std::byte> table_, out_;
  Kernel kernel_ = nullptr;
  const char* method_ = "";
};

}  // namespace etalon::bench
