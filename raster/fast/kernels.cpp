// Compiled once per instruction set by Highway (foreach_target includes this file again). Contraction is allowed here: every bound holds
// for fused and unfused arithmetic alike, so the bytes cannot depend on it.
// Vectors whose length is not known when compiling cannot be members of a struct: SVE and RISC-V use the next best target.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/fast/kernels.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <type_traits>

#include "raster/fast/kernels.h"
#include "raster/fast/planes.h"
#include "raster/visibility.h"

HWY_BEFORE_NAMESPACE();
namespace etalon::raster::fast::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// clang-format off
// Each builds on the one before.
#include "raster/fast/plane_kernels.inc"
#include "raster/fast/texel_kernels.inc"
#include "raster/fast/nearest_kernels.inc"
#include "raster/fast/linear_kernels.inc"
#include "raster/fast/copy_kernels.inc"
#include "raster/fast/store_kernels.inc"
#include "raster/fast/depth_kernels.inc"
#include "raster/fast/run_kernels.inc"
#include "raster/fast/small_kernels.inc"
#include "raster/fast/make_plane_kernels.inc"
#include "raster/fast/margin_kernels.inc"
#include "raster/fast/lookup_kernels.inc"
#undef ETALON_INLINE_STEP
// clang-format on

const Kernels* kernels() {
  static const Kernels table = {
      .set_up_small = set_up_small,
      .set_up_small_depth = set_up_small_depth,
      .draw_small = draw_small,
      .make_planes = make_planes,
      .equal_run = equal_run,
      .renumber = renumber,
      .mark = mark,
      .nonzero_run = nonzero_run,
      .positions = positions,
      .attribute = attribute,
      .nearest_texels = nearest_texels,
      .nearest_axis = nearest_axis,
      .linear_axis = linear_axis,
      .texel_offsets = texel_offsets,
      .copy_words = copy_words,
      .copy_float_pairs = copy_float_pairs,
      .bilinear = bilinear,
      .bilinear_rgba8 = bilinear_rgba8,
      .linear_float_pairs = linear_float_pairs,
      .to_unorm = to_unorm,
      .to_float32 = to_float32,
      .depth = depth,
      .depth_test = depth_test,
      .edge_distance = edge_distance,
      .border_distance = border_distance,
      .lookup_squares = lookup_squares,
      .lookup_squares_of_group = lookup_squares_of_group,
      .vector_doubles = static_cast<int>(hn::Lanes(kDoubles)),
  };
  return &table;
}

}  // namespace etalon::raster::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace etalon::raster::fast {

const Kernels* kernels_for(SimdLevel level) {
  static const std::int64_t supported = hwy::SupportedTargets();
  [[maybe_unused]] const auto runs_here = [](std::int64_t target) { return (supported & target) != 0; };
  switch (level) {
    case SimdLevel::baseline: return HWY_STATIC_DISPATCH(kernels)();
    case SimdLevel::ssse3:
#if HWY_TARGETS & HWY_SSSE3
      if (runs_here(HWY_SSSE3)) return N_SSSE3::kernels();
#endif
      return nullptr;
    case SimdLevel::sse4:
#if HWY_TARGETS & HWY_SSE4
      if (runs_here(HWY_SSE4)) return N_SSE4::kernels();
#endif
      return nullptr;
    case SimdLevel::avx2:
#if HWY_TARGETS & HWY_AVX2
      if (runs_here(HWY_AVX2)) return N_AVX2::kernels();
#endif
      return nullptr;
    case SimdLevel::avx512:
#if HWY_TARGETS & HWY_AVX3
      if (runs_here(HWY_AVX3)) return N_AVX3::kernels();
#endif
      return nullptr;
    case SimdLevel::neon:
#if HWY_TARGETS & HWY_NEON
      if (runs_here(HWY_NEON)) return N_NEON::kernels();
#endif
      return nullptr;
  }
  return nullptr;
}

}  // namespace etalon::raster::fast
#endif
