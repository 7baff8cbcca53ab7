#include "core/bake/triangle_sizes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <queue>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/math/nearest_point.h"

namespace etalon::bake {
namespace {

// Class k holds the triangles of size 2^k.
std::size_t class_of(int size) { return static_cast<std::size_t>(std::countr_zero(static_cast<unsigned>(size))) % kSizeCount; }

// Throws where the triangles do not fit even at the least size.
void require_room(std::size_t triangles, int width, int height, Gutter gutter) {
  const std::uint64_t least = least_height(triangles, width, gutter), square = least_square(triangles, gutter);
  if (least <= static_cast<std::uint64_t>(height)) return;
  std::string would_do;
  if (least <= kLargestMap) would_do = fmt::format("the smallest of this width is {}x{}, ", width, least);
  would_do += square <= kLargestMap ? fmt::format("the smallest square {0}x{0}", square)
                                    : fmt::format("nor in the largest, {0}x{0}: expected fewer triangles", kLargestMap);
  throw InputError(fmt::format("{} triangles do not fit in a texture map of {}x{}{}: {}", triangles, width, height,
                               gutter ? fmt::format(" with a gutter for {} mip levels", *gutter) : "", would_do));
}

// (proximity or ratio, face): least first.
using Entry = std::pair<double, std::uint32_t>;
using Queue = std::priority_queue<Entry, std::vector<Entry>, std::greater<>>;

class Filter {
 public:
  Filter(const std::vector<double>& ratios, int width, int height, Gutter gutter)
      : ratios_(ratios), width_(width), height_(static_cast<std::uint64_t>(height)), gutter_(gutter), least_(least_size(gutter)) {
    const int largest = largest_size(width, height, gutter);
    for (std::uint32_t f = 0; f < ratios.size(); ++f) {
      result_.sizes.push_back(wanted_size(ratios[f], largest, least_));
      ++counts_[class_of(result_.sizes[f])];
    }
  }

  TriangleSizes run(const std::function<void(const SizeStep&)>& observe) {
    Queue queue;
    for (std::uint32_t f = 0; f < ratios_.size(); ++f)
      if (result_.sizes[f] > least_) queue.emplace(proximity(f), f);
    while (!fits()) {
      ETALON_CHECK(!queue.empty(), "all triangles are of the least size, and the map was found large enough for that");
      const auto [least, f] = queue.top();
      queue.pop();
      if (observe) observe({FaceId(f), result_.sizes[f], least});
      halve(f);
      ++result_.reductions;
      if (result_.sizes[f] > least_) queue.emplace(proximity(f), f);
    }
    make_even();
    return std::move(result_);
  }

 private:
  [[nodiscard]] double proximity(std::uint32_t f) const { return ratios_[f] / (result_.sizes[f] / 2); }

  // The area says no at once where it can; what passes need not fit: three pairs of size 256 use 75 % of 512 x 512 and need 514 rows.
  [[nodiscard]] bool fits() const {
    const SizeCounts even = even_counts(counts_);
    std::uint64_t area = 0;
    for (int k = 1; k < kSizeCount; ++k) {
      const std::uint64_t count = even[static_cast<std::size_t>(k)], d = std::uint64_t{1} << k;
      area += count * (gutter_ ? texels_of_size(d) + border_texels(1 << k, *gutter_) : texels_of_size(d));
    }
    if (area > static_cast<std::uint64_t>(width_) * height_) return false;
    return (gutter_ ? tile_pairs(even, width_, *gutter_).height : tiling_height(even, width_)) <= height_;
  }

  void halve(std::uint32_t f) {
    --counts_[class_of(result_.sizes[f])];
    result_.sizes[f] /= 2;
    ++counts_[class_of(result_.sizes[f])];
  }

  void make_even() {
    std::array<std::vector<Entry>, kSizeCount> members;
    for (std::uint32_t f = 0; f < ratios_.size(); ++f) members[class_of(result_.sizes[f])].emplace_back(ratios_[f], f);
    std::size_t lowest = 0;
    while (lowest < kSizeCount && members[lowest].empty()) ++lowest;
    for (std::size_t k = kSizeCount - 1; k > lowest && k < kSizeCount; --k) {
      if (members[k].size() % 2 == 0) continue;
      const auto least = std::min_element(members[k].begin(), members[k].end());
      members[k - 1].push_back(*least);
      halve(least->second);
      ++result_.handed_down;
    }
  }

  const std::vector<double>& ratios_;
  int width_;
  std::uint64_t height_;
  Gutter gutter_;
  int least_;
  SizeCounts counts_{};
  TriangleSizes result_;
};

}  // namespace

double mean_edge_length(const Mesh& mesh) {
  // The upper ends of all sides, grouped by their lower end: each edge is in one group, as often as it has faces.
  std::vector<std::size_t> starts(mesh.vertex_count() + 1, 0);
  const auto for_each_side = [&](const auto& visit) {
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
      for (int c = 0; c < 3; ++c) {
        const std::uint32_t a = mesh.vertex(FaceId(f), c).index, b = mesh.vertex(FaceId(f), (c + 1) % 3).index;
        if (a != b) visit(std::min(a, b), std::max(a, b));
      }
  };
  for_each_side([&](std::uint32_t low, std::uint32_t) { ++starts[low + 1]; });
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  std::vector<std::uint32_t> highs(starts.back());
  std::vector<std::size_t> next(starts.begin(), starts.end() - 1);
  for_each_side([&](std::uint32_t low, std::uint32_t high) { highs[next[low]++] = high; });
  double sum = 0;
  std::size_t count = 0;
  for (std::uint32_t low = 0; low < mesh.vertex_count(); ++low) {
    const auto first = highs.begin() + static_cast<std::ptrdiff_t>(starts[low]),
               last = highs.begin() + static_cast<std::ptrdiff_t>(starts[low + 1]);
    std::sort(first, last);
    for (auto high = first; high != last; ++high) {
      if (high != first && *high == *(high - 1)) continue;
      const Vec3d d = difference_of(mesh.positions[low], mesh.positions[*high]);
      sum += std::sqrt(dot_product(d, d));
      ++count;
    }
  }
  return count == 0 ? 0 : sum / static_cast<double>(count);
}

std::vector<double> size_ratios(const Mesh& mesh, double spacing) {
  ETALON_CHECK(spacing > 0, fmt::format("spacing {}", spacing));
  std::vector<double> ratios;
  ratios.reserve(mesh.face_count());
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    double longest2 = 0;
    for (int c = 0; c < 3; ++c) {
      const Vec3d d = difference_of(mesh.position(FaceId(f), c), mesh.position(FaceId(f), (c + 1) % 3));
      longest2 = std::max(longest2, dot_product(d, d));
    }
    ratios.push_back(std::sqrt(longest2) / spacing);
  }
  return ratios;
}

int wanted_size(double ratio, int largest, int least) {
  int size = least;
  while (size < largest && size < ratio) size *= 2;
  return size;
}

int largest_size(int width, int height, Gutter gutter) {
  if (width < 2 || width > kLargestMap || !std::has_single_bit(static_cast<unsigned>(width)))
    throw InputError(fmt::format("a texture map of {}x{}: expected a width that is a power of two, 2 to {}", width, height, kLargestMap));
  if (height < 3 || height > kLargestMap)
    throw InputError(fmt::format("a texture map of {}x{}: expected a height of 3 to {}", width, height, kLargestMap));
  int size = width;
  if (!gutter) {
    while (size + 1 > height) size /= 2;
    return size;
  }
  if (*gutter < 0 || *gutter > kLargestGutter)
    throw InputError(fmt::format("expected a gutter for 0 to {} mip levels, got {}", kLargestGutter, *gutter));
  if (height % (1 << *gutter) != 0)
    throw InputError(fmt::format("a texture map of {0}x{1} with a gutter for {2} mip levels: expected a height that is a multiple of {3}",
                                 width, height, *gutter, 1 << *gutter));
  const auto fits = [&](int d) { return pair_block(d, *gutter).width <= width && pair_block(d, *gutter).height <= height; };
  while (size > least_size(gutter) && !fits(size)) size /= 2;
  const PairBlock least = pair_block(least_size(gutter), *gutter);
  if (!fits(size))
    throw InputError(fmt::format("a texture map of {}x{} with a gutter for {} mip levels: expected at least {}x{}", width, height, *gutter,
                                 std::bit_ceil(static_cast<unsigned>(least.width)), least.height));
  return size;
}

TriangleSizes choose_sizes(const std::vector<double>& ratios, int width, int height, const std::function<void(const SizeStep&)>& observe,
                           Gutter gutter) {
  (void)largest_size(width, height, gutter);
  for (std::size_t f = 0; f < ratios.size(); ++f)
    if (!(ratios[f] >= 0) || std::isinf(ratios[f]))
      throw InputError(fmt::format("triangle {}: its longest edge over the spacing: expected a finite number, got {}", f, ratios[f]));
  require_room(ratios.size(), width, height, gutter);
  return Filter(ratios, width, height, gutter).run(observe);
}

}  // namespace etalon::bake
