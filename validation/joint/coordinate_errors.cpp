// CoordinatePicture's squared differences: sixteen lookups at a time by vectors, and in integers where these leave a rounding open.
#include <algorithm>
#include <bit>
#include <numeric>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "raster/fast/kernels.h"
#include "validation/joint/coordinate_picture.h"

namespace etalon::validation {
namespace {

using raster::fast::kLookupBlock, raster::fast::LookupBlocks;

constexpr std::size_t kSlice = 8192;  ///< lookups of a task
constexpr std::size_t kMostBlocks = 64;

const raster::fast::Kernels& kernels() { return *raster::fast::kernels_for(raster::simd_level()); }

/// Calls blocks(first lookup, number of blocks) for as many whole blocks as there are, and rest(lookup) for the others.
template <class Blocks, class Rest>
void for_each_block(std::size_t begin, std::size_t end, const Blocks& blocks, const Rest& rest) {
  while (end - begin >= kLookupBlock) {
    const std::size_t count = std::min((end - begin) / kLookupBlock, kMostBlocks);
    blocks(begin, static_cast<int>(count));
    begin += count * kLookupBlock;
  }
  for (; begin < end; ++begin) rest(begin);
}

}  // namespace

CoordinatePicture::Reference CoordinatePicture::reference(const Image& wanted) const {
  ETALON_CHECK(wanted.format() == kRgba8 && wanted.texel_count() == coordinates_->texel_count(), "a picture of the frame's size");
  const auto* const texels = wanted.channels<std::uint8_t>(0, 0);
  const auto energy = [&](std::size_t n) {
    const std::uint8_t* const t = texels + 4 * n;
    return static_cast<std::uint64_t>(t[0] * t[0] + t[1] * t[1] + t[2] * t[2]);
  };
  Reference result;
  result.covered.resize(at_.size());
  const auto slices = [](std::size_t count) { return std::vector<std::uint64_t>(count / kSlice + 1); };
  std::vector<std::uint64_t> all = slices(wanted.texel_count()), covered = slices(at_.size());
  parallel_for_blocks(wanted.texel_count(), kSlice, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) all[begin / kSlice] += energy(n);
  });
  parallel_for_blocks(at_.size(), kSlice, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      const std::uint8_t* const t = texels + 4 * std::size_t{at_[n]};
      // Alpha 255, as all texels of a texture have.
      result.covered[n] = {t[0], t[1], t[2], 255};
      covered[begin / kSlice] += energy(at_[n]);
    }
  });
  result.elsewhere =
      std::accumulate(all.begin(), all.end(), std::uint64_t{0}) - std::accumulate(covered.begin(), covered.end(), std::uint64_t{0});
  return result;
}

std::uint64_t CoordinatePicture::square(const std::uint8_t* texels, std::size_t lookup, const Reference& reference) const {
  const std::array<std::uint8_t, 3> drawn = color(texels, lookup);
  const std::array<std::uint8_t, 4>& wanted = reference.covered[lookup];
  std::uint64_t sum = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const int difference = drawn[c] - wanted[c];
    sum += static_cast<std::uint64_t>(difference * difference);
  }
  return sum;
}

std::uint64_t CoordinatePicture::sse(const Image& texture, const Reference& reference) const {
  require_texture(texture);
  ETALON_CHECK(reference.covered.size() == at_.size(), "a reference of this picture");
  const auto* const texels = texture.channels<std::uint8_t>(0, 0);
  std::vector<std::uint64_t> sums(at_.size() / kSlice + 1);
  parallel_for_blocks(at_.size(), kSlice, [&](std::size_t begin, std::size_t end) {
    std::uint64_t sum = 0;
    for_each_block(
        begin, end,
        [&](std::size_t first, int count) {
          const LookupBlocks blocks{texel_.data() + first, fx_.data() + first, fy_.data() + first, reference.covered.data() + first};
          auto undecided = kernels().lookup_squares(texture.bytes().data(), static_cast<std::uint32_t>(texture_width_), blocks, count, sum);
          for (; undecided != 0; undecided &= undecided - 1) {
            const std::size_t from = first + kLookupBlock * static_cast<std::size_t>(std::countr_zero(undecided));
            for (std::size_t n = from; n < from + kLookupBlock; ++n) sum += square(texels, n, reference);
          }
        },
        [&](std::size_t n) { sum += square(texels, n, reference); });
    sums[begin / kSlice] = sum;
  });
  return std::accumulate(sums.begin(), sums.end(), reference.elsewhere);
}

TextureGroup::Sums CoordinatePicture::sse(const TextureGroup& group, const Reference& reference) const {
  for (const Image& texture : group.textures()) require_texture(texture);
  ETALON_CHECK(reference.covered.size() == at_.size(), "a reference of this picture");
  std::vector<TextureGroup::Sums> sums(at_.size() / kSlice + 1, TextureGroup::Sums{});
  parallel_for_blocks(at_.size(), kSlice, [&](std::size_t begin, std::size_t end) {
    TextureGroup::Sums& sum = sums[begin / kSlice];
    const auto add_exactly = [&](std::size_t texture, std::size_t n) {
      sum[texture] += square(group.textures()[texture].channels<std::uint8_t>(0, 0), n, reference);
    };
    for_each_block(
        begin, end,
        [&](std::size_t first, int count) {
          const LookupBlocks blocks{texel_.data() + first, fx_.data() + first, fy_.data() + first, reference.covered.data() + first};
          std::array<std::uint8_t, kMostBlocks> undecided;
          kernels().lookup_squares_of_group(group.texels().data(), static_cast<std::uint32_t>(texture_width_), blocks, count, sum.data(),
                                            undecided.data());
          for (std::size_t block = 0; block < static_cast<std::size_t>(count); ++block)
            for (std::size_t t = 0; undecided[block] != 0 && t < group.textures().size(); ++t)
              for (std::size_t n = 0; (undecided[block] >> t & 1) != 0 && n < kLookupBlock; ++n)
                add_exactly(t, first + block * kLookupBlock + n);
        },
        [&](std::size_t n) {
          for (std::size_t t = 0; t < group.textures().size(); ++t) add_exactly(t, n);
        });
  });
  TextureGroup::Sums result;
  result.fill(reference.elsewhere);
  for (const TextureGroup::Sums& sum : sums)
    for (std::size_t t = 0; t < result.size(); ++t) result[t] += sum[t];
  return result;
}

}  // namespace etalon::validation
