#include "core/mesh/range_image.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "core/base/error.h"

namespace etalon {

namespace {

constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();

void require(const RangeImage& range, std::span<const std::byte> rgb, double max_jump) {
  if (range.width < 1 || range.height < 1)
    throw InputError(fmt::format("range image: size: expected at least 1x1, got {}x{}", range.width, range.height));
  const std::size_t samples = static_cast<std::size_t>(range.width) * static_cast<std::size_t>(range.height);
  if (range.z.size() != samples) throw InputError(fmt::format("range image: samples: expected {}, got {}", samples, range.z.size()));
  if (samples >= kUnused) throw InputError(fmt::format("range image: samples: expected below {}, got {}", kUnused, samples));
  if (!rgb.empty() && rgb.size() != 3 * samples)
    throw InputError(fmt::format("range image: colours: expected {} bytes, got {}", 3 * samples, rgb.size()));
  if (!(range.spacing > 0) || !std::isfinite(range.spacing))
    throw InputError(fmt::format("range image: spacing: expected a length above 0, got {}", range.spacing));
  if (!(max_jump > 0)) throw InputError(fmt::format("range image: largest jump: expected a length above 0, got {}", max_jump));
}

/// A sample's index in the grid and its depth.
struct Sample {
  std::uint32_t index;
  double z;
};

double jump(const Sample& a, const Sample& b) { return std::fabs(a.z - b.z); }

class Triangulator {
 public:
  Triangulator(int width, int height, std::span<const float> depth, double max_jump)
      : width_(width), height_(height), depth_(depth), max_jump_(max_jump) {}

  std::vector<std::array<std::uint32_t, 3>> faces() {
    for (int j = 0; j + 1 < height_; ++j)
      for (int i = 0; i + 1 < width_; ++i) add_cell(i, j);
    return std::move(faces_);
  }

 private:
  [[nodiscard]] Sample sample(int i, int j) const {
    const std::uint32_t index = static_cast<std::uint32_t>(j) * static_cast<std::uint32_t>(width_) + static_cast<std::uint32_t>(i);
    return {index, double{depth_[index]}};
  }

  void add_cell(int i, int j) {
    // Counter-clockwise from the lowest corner.
    const std::array<Sample, 4> corners = {sample(i, j), sample(i + 1, j), sample(i + 1, j + 1), sample(i, j + 1)};
    std::size_t missing = 4;
    int count = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      if (std::isfinite(corners[k].z))
        ++count;
      else
        missing = k;
    }
    if (count < 3) return;
    if (count == 3) return add(corners[(missing + 1) % 4], corners[(missing + 2) % 4], corners[(missing + 3) % 4]);
    if (jump(corners[0], corners[2]) <= jump(corners[1], corners[3])) {
      add(corners[0], corners[1], corners[2]);
      add(corners[0], corners[2], corners[3]);
    } else {
      add(corners[0], corners[1], corners[3]);
      add(corners[1], corners[2], corners[3]);
    }
  }

  void add(const Sample& a, const Sample& b, const Sample& c) {
    if (jump(a, b) > max_jump_ || jump(b, c) > max_jump_ || jump(c, a) > max_jump_) return;
    faces_.push_back({a.index, b.index, c.index});
  }

  int width_, height_;
  std::span<const float> depth_;
  double max_jump_;
  std::vector<std::array<std::uint32_t, 3>> faces_;
};

}  // namespace

std::vector<std::array<std::uint32_t, 3>> grid_triangles(int width, int height, std::span<const float> depth, double max_jump) {
  return Triangulator(width, height, depth, max_jump).faces();
}

std::size_t sample_count(const RangeImage& range) {
  std::size_t count = 0;
  for (const float z : range.z) count += std::isfinite(z);
  return count;
}

Mesh triangulate(const RangeImage& range, std::span<const std::byte> rgb, const TriangulateOptions& options) {
  const double max_jump = options.max_jump.value_or(4 * range.spacing);
  require(range, rgb, max_jump);
  const std::vector<std::array<std::uint32_t, 3>> faces = grid_triangles(range.width, range.height, range.z, max_jump);

  std::vector<std::uint32_t> vertex(range.z.size(), kUnused);
  for (const auto& face : faces)
    for (const std::uint32_t s : face) vertex[s] = 0;
  Mesh mesh;
  const auto width = static_cast<std::size_t>(range.width);
  for (std::size_t s = 0; s < vertex.size(); ++s) {
    if (vertex[s] == kUnused) continue;
    vertex[s] = static_cast<std::uint32_t>(mesh.positions.size());
    const double x = (static_cast<double>(s % width) + 0.5) * range.spacing, y = (static_cast<double>(s / width) + 0.5) * range.spacing;
    mesh.positions.emplace_back(static_cast<float>(x), static_cast<float>(y), range.z[s]);
    mesh.wedges.push_back({VertexId(vertex[s]), {0, 0}});
    if (rgb.empty()) continue;
    const auto channel = [&](std::size_t k) { return static_cast<float>(std::to_integer<int>(rgb[3 * s + k])) / 255.0f; };
    mesh.colors.emplace_back(channel(0), channel(1), channel(2), 1.0f);
  }
  mesh.faces.reserve(faces.size());
  for (const auto& face : faces) mesh.faces.push_back({WedgeId(vertex[face[0]]), WedgeId(vertex[face[1]]), WedgeId(vertex[face[2]])});
  return mesh;
}

}  // namespace etalon
