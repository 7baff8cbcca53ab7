#include "tests/bench/limits.h"

#include <algorithm>
#include <bit>
#include <cstring>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "tests/bench/timing.h"

namespace etalon::bench {
namespace {

constexpr std::size_t kRow = 1024;        ///< elements stored by one step of the outer loop
constexpr std::size_t kRowsPerTask = 64;  ///< finer than a scene's tiles, coarse enough to cost nothing
constexpr std::size_t kCopyTask_bytes = std::size_t{1} << 18;

// The rotation of the 3-4-5 triangle in steps of 2^-16 element.
constexpr std::uint32_t kCosine = 52429, kSine = 39322;

#if defined(__x86_64__)
#define ETALON_SET1_256(a) _mm256_set1_epi32(static_cast<int>(a))
#define ETALON_SET1_512(a) _mm512_set1_epi32(static_cast<int>(a))
#endif

std::uint32_t random_index(std::uint32_t i, std::uint32_t bits) {
  i *= 0x9E3779B1u;
  i ^= i >> 15;
  i *= 0x85EBCA77u;
  return i >> (32 - bits);
}

}  // namespace

CopyLimit::CopyLimit(std::size_t bytes) : from_(bytes, std::byte{1}), to_(bytes, std::byte{2}) {}

void CopyLimit::run() {
  parallel_for_blocks(from_.size(), kCopyTask_bytes,
                      [&](std::size_t begin, std::size_t end) { std::memcpy(to_.data() + begin, from_.data() + begin, end - begin); });
}

/// The loops, each over rows: element x of row y is read at (x·cos + y·sin, y·cos − x·sin) or at a hash of its number.
struct GatherKernels {
  template <class T>
  static void scalar(const GatherLimit& g, std::size_t first_row, std::size_t end_row) {
    const auto* table = reinterpret_cast<const T*>(g.table_.data());
    auto* out = reinterpret_cast<T*>(const_cast<std::byte*>(g.out_.data()));
    const std::uint32_t bits = g.side_bits_, mask = (1u << bits) - 1;
    for (std::size_t y = first_row; y < end_row; ++y) {
      T* row = out + y * kRow;
      if (g.order_ == GatherOrder::random) {
        for (std::size_t x = 0; x < kRow; ++x) row[x] = table[random_index(static_cast<std::uint32_t>(y * kRow + x), 2 * bits)];
        continue;
      }
      auto u = static_cast<std::uint32_t>(y) * kSine, v = static_cast<std::uint32_t>(y) * kCosine;
      for (std::size_t x = 0; x < kRow; ++x, u += kCosine, v -= kSine) row[x] = table[((v >> 16 & mask) << bits) + (u >> 16 & mask)];
    }
  }

#if defined(__x86_64__)
  template <class T>
  __attribute__((target("avx2"))) static void avx2(const GatherLimit& g, std::size_t first_row, std::size_t end_row) {
    const auto* table = reinterpret_cast<const T*>(g.table_.data());
    auto* out = reinterpret_cast<T*>(const_cast<std::byte*>(g.out_.data()));
    const std::uint32_t bits = g.side_bits_;
    const __m256i mask = ETALON_SET1_256((1u << bits) - 1), lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
    const __m128i shift = _mm_cvtsi32_si128(static_cast<int>(bits)), hash_shift = _mm_cvtsi32_si128(static_cast<int>(32 - 2 * bits));
    for (std::size_t y = first_row; y < end_row; ++y) {
      const auto row_number = static_cast<std::uint32_t>(y);
      __m256i u = _mm256_add_epi32(ETALON_SET1_256(row_number * kSine), _mm256_mullo_epi32(lane, ETALON_SET1_256(kCosine)));
      __m256i v = _mm256_sub_epi32(ETALON_SET1_256(row_number * kCosine), _mm256_mullo_epi32(lane, ETALON_SET1_256(kSine)));
      for (std::size_t x = 0; x < kRow; x += 8) {
        __m256i index;
        if (g.order_ == GatherOrder::random) {
          index = _mm256_mullo_epi32(_mm256_add_epi32(ETALON_SET1_256(static_cast<std::uint32_t>(y * kRow + x)), lane),
                                     ETALON_SET1_256(0x9E3779B1u));
          index = _mm256_mullo_epi32(_mm256_xor_si256(index, _mm256_srli_epi32(index, 15)), ETALON_SET1_256(0x85EBCA77u));
          index = _mm256_srl_epi32(index, hash_shift);
        } else {
          index = _mm256_add_epi32(_mm256_sll_epi32(_mm256_and_si256(_mm256_srli_epi32(v, 16), mask), shift),
                                   _mm256_and_si256(_mm256_srli_epi32(u, 16), mask));
          u = _mm256_add_epi32(u, ETALON_SET1_256(8 * kCosine));
          v = _mm256_sub_epi32(v, ETALON_SET1_256(8 * kSine));
        }
        auto* to = reinterpret_cast<__m256i*>(out + y * kRow + x);
        if constexpr (sizeof(T) == 4) {
          _mm256_storeu_si256(to, _mm256_i32gather_epi32(reinterpret_cast<const int*>(table), index, 4));
        } else {
          const auto* base = reinterpret_cast<const long long*>(table);
          _mm256_storeu_si256(to, _mm256_i32gather_epi64(base, _mm256_castsi256_si128(index), 8));
          _mm256_storeu_si256(to + 1, _mm256_i32gather_epi64(base, _mm256_extracti128_si256(index, 1), 8));
        }
      }
    }
  }

  template <class T>
  __attribute__((target("avx512f"))) static void avx512(const GatherLimit& g, std::size_t first_row, std::size_t end_row) {
    const auto* table = reinterpret_cast<const T*>(g.table_.data());
    auto* out = reinterpret_cast<T*>(const_cast<std::byte*>(g.out_.data()));
    const std::uint32_t bits = g.side_bits_;
    const __m512i mask = ETALON_SET1_512((1u << bits) - 1);
    const __m512i lane = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    const __m128i shift = _mm_cvtsi32_si128(static_cast<int>(bits)), hash_shift = _mm_cvtsi32_si128(static_cast<int>(32 - 2 * bits));
    for (std::size_t y = first_row; y < end_row; ++y) {
      const auto row_number = static_cast<std::uint32_t>(y);
      __m512i u = _mm512_add_epi32(ETALON_SET1_512(row_number * kSine), _mm512_mullo_epi32(lane, ETALON_SET1_512(kCosine)));
      __m512i v = _mm512_sub_epi32(ETALON_SET1_512(row_number * kCosine), _mm512_mullo_epi32(lane, ETALON_SET1_512(kSine)));
      for (std::size_t x = 0; x < kRow; x += 16) {
        __m512i index;
        if (g.order_ == GatherOrder::random) {
          index = _mm512_mullo_epi32(_mm512_add_epi32(ETALON_SET1_512(static_cast<std::uint32_t>(y * kRow + x)), lane),
                                     ETALON_SET1_512(0x9E3779B1u));
          index = _mm512_mullo_epi32(_mm512_xor_si512(index, _mm512_srli_epi32(index, 15)), ETALON_SET1_512(0x85EBCA77u));
          index = _mm512_srl_epi32(index, hash_shift);
        } else {
          index = _mm512_add_epi32(_mm512_sll_epi32(_mm512_and_si512(_mm512_srli_epi32(v, 16), mask), shift),
                                   _mm512_and_si512(_mm512_srli_epi32(u, 16), mask));
          u = _mm512_add_epi32(u, ETALON_SET1_512(16 * kCosine));
          v = _mm512_sub_epi32(v, ETALON_SET1_512(16 * kSine));
        }
        T* to = out + y * kRow + x;
        if constexpr (sizeof(T) == 4) {
          _mm512_storeu_si512(to, _mm512_i32gather_epi32(index, table, 4));
        } else {
          _mm512_storeu_si512(to, _mm512_i32gather_epi64(_mm512_castsi512_si256(index), table, 8));
          _mm512_storeu_si512(to + 8, _mm512_i32gather_epi64(_mm512_extracti64x4_epi64(index, 1), table, 8));
        }
      }
    }
  }
#endif
};

GatherLimit::GatherLimit(std::size_t count, std::size_t table_elements, std::size_t element_bytes, GatherOrder order)
    : rows_((std::max<std::size_t>(count, 1) + kRow - 1) / kRow),
      side_bits_(std::max<std::uint32_t>(6, static_cast<std::uint32_t>(std::bit_width(table_elements) - 1) / 2)),
      element_bytes_(element_bytes),
      order_(order),
      table_((std::size_t{1} << (2 * side_bits_)) * element_bytes),
      out_(rows_ * kRow * element_bytes) {
  ETALON_CHECK(element_bytes == 4 || element_bytes == 8, std::to_string(element_bytes));
  const bool narrow = element_bytes == 4;
  struct Candidate {
    const char* name;
    Kernel kernel;
    bool available;
  };
  const Candidate candidates[] = {
    {"scalar", narrow ? GatherKernels::scalar<std::uint32_t> : GatherKernels::scalar<std::uint64_t>, true},
#if defined(__x86_64__)
    {"avx2", narrow ? GatherKernels::avx2<std::uint32_t> : GatherKernels::avx2<std::uint64_t>, __builtin_cpu_supports("avx2") != 0},
    {"avx512", narrow ? GatherKernels::avx512<std::uint32_t> : GatherKernels::avx512<std::uint64_t>,
     __builtin_cpu_supports("avx512f") != 0},
#endif
  };
  std::vector<Way> ways;
  std::vector<const Candidate*> tried;
  for (const Candidate& c : candidates) {
    if (!c.available) continue;
    tried.push_back(&c);
    ways.push_back({c.name, [this, kernel = c.kernel] { run(kernel); }, {}});
  }
  for (std::size_t i = 0; i < table_.size(); ++i) table_[i] = static_cast<std::byte>(i * 0x9E3779B1u >> 24);
  std::vector<std::byte> expected;
  for (Way& way : ways) {
    way.run();
    if (expected.empty()) expected = out_;
    ETALON_CHECK(out_ == expected, way.name + " gathers something else");
  }
  for (int round = 0; round < 5; ++round) measure_round(ways);
  std::size_t best = 0;
  for (std::size_t i = 1; i < ways.size(); ++i)
    if (median(ways[i].milliseconds) < median(ways[best].milliseconds)) best = i;
  kernel_ = tried[best]->kernel;
  method_ = tried[best]->name;
}

void GatherLimit::run(Kernel kernel) {
  parallel_for_blocks(rows_, kRowsPerTask, [&](std::size_t begin, std::size_t end) { kernel(*this, begin, end); });
}

void GatherLimit::run() { run(kernel_); }

std::string GatherLimit::method() const { return method_; }

}  // namespace etalon::bench
