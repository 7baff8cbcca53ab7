#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>

#include "core/base/error.h"
#include "core/base/float_environment.h"
#include "core/base/sha256.h"
#include "core/draw/clip_placer.h"
#include "core/io/draws_file.h"
#include "core/io/draws_header.h"
#include "core/io/image_file.h"
#include "core/io/input_error.h"
#include "core/io/inputs.h"

namespace etalon::io {
namespace {

template <class T>
T load(const std::byte* at) {
  T value;
  std::memcpy(&value, at, sizeof value);  // the file is little-endian, as are the machines that we run on
  return value;
}

// The arrays behind the header, draw after draw: vertices, then triangles.
class DrawsArrays {
 public:
  DrawsArrays(const DrawsHeader& header, std::span<const std::byte> file, std::size_t begin, const std::string& name)
      : header_(header), file_(file), name_(name) {
    std::uint64_t end = begin;
    for (const DrawsDraw& d : header.draws) {
      vertices_at_.push_back(static_cast<std::size_t>(end));
      end += d.vertex_count * kDrawsVertexBytes;
      triangles_at_.push_back(static_cast<std::size_t>(end));
      end += std::uint64_t{d.draw.triangle_count} * kDrawsTriangleBytes;
      first_vertex_.push_back(vertex_count_);
      vertex_count_ += d.vertex_count;
    }
    if (end != file.size()) fail_file(name, fmt::format("arrays: expected to end at byte {}, got a file of {} bytes", end, file.size()));
  }

  [[nodiscard]] std::uint64_t vertex_count() const { return vertex_count_; }

  /// Vertices of the file in clip space; those of the other space are left as they are.
  [[nodiscard]] std::vector<ClipVertex> clip_vertices() const {
    std::vector<ClipVertex> result(static_cast<std::size_t>(vertex_count_));
    for_each_vertex(true, [&](std::size_t d, std::uint64_t n, const std::byte* at) {
      ClipVertex& v = result[static_cast<std::size_t>(n)];
      std::array<float*, 10> fields{&v.x, &v.y, &v.z, &v.w, &v.uv.x, &v.uv.y, &v.color.x, &v.color.y, &v.color.z, &v.color.w};
      for (std::size_t k = 0; k < fields.size(); ++k)
        *fields[k] = number(d, n, at, k, "xyzwuvrgba"[k], k < 4 ? kMostPosition : kMostAttribute);
    });
    // Vertices at one place are cut alike wherever they stand in the file: a seam of texture coordinates does not open.
    std::vector<std::size_t> by_place(result.size());
    std::iota(by_place.begin(), by_place.end(), std::size_t{0});
    const auto place = [&](std::size_t n) {
      const ClipVertex& v = result[n];
      return std::array{std::bit_cast<std::uint32_t>(v.x), std::bit_cast<std::uint32_t>(v.y), std::bit_cast<std::uint32_t>(v.z),
                        std::bit_cast<std::uint32_t>(v.w)};
    };
    std::sort(by_place.begin(), by_place.end(), [&](std::size_t a, std::size_t b) {
      const auto place_a = place(a), place_b = place(b);
      return place_a != place_b ? place_a < place_b : a < b;
    });
    for (std::size_t i = 0; i < by_place.size(); ++i) {
      const bool same = i > 0 && place(by_place[i]) == place(by_place[i - 1]);
      result[by_place[i]].order = same ? result[by_place[i - 1]].order : by_place[i];
    }
    return result;
  }

  /// Appends the vertices in raster space; where in the list each vertex of the file then is.
  [[nodiscard]] std::vector<std::uint32_t> add_raster_vertices(DrawList& list) const {
    std::vector<std::uint32_t> index(static_cast<std::size_t>(vertex_count_), kNoTriangle);
    for_each_vertex(false, [&](std::size_t d, std::uint64_t n, const std::byte* at) {
      RasterVertex v;
      v.x = load<std::int32_t>(at);
      v.y = load<std::int32_t>(at + 4);
      std::array<float*, 8> fields{&v.z, &v.w, &v.uv.x, &v.uv.y, &v.color.x, &v.color.y, &v.color.z, &v.color.w};
      for (std::size_t k = 0; k < fields.size(); ++k)
        *fields[k] = number(d, n, at, k + 2, "zwuvrgba"[k], k < 2 ? kMostPosition : kMostAttribute);
      index[static_cast<std::size_t>(n)] = static_cast<std::uint32_t>(list.vertices.size());
      list.vertices.push_back(v);
    });
    return index;
  }

  /// Triangle `t` of draw `d`: vertices of that draw or an earlier one, in its space.
  [[nodiscard]] std::array<std::uint32_t, 3> triangle(std::size_t d, std::uint32_t t) const {
    std::array<std::uint32_t, 3> corners{};
    const std::size_t at = triangles_at_[d] + t * kDrawsTriangleBytes;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = load<std::uint32_t>(file_.data() + at + 4 * k);
      const std::uint64_t limit = first_vertex_[d] + header_.draws[d].vertex_count;
      const auto refuse = [&](const std::string& expected) {
        fail_at_byte(name_, at + 4 * k, fmt::format("draws[{}], triangle {}: expected {}, got {}", d, t, expected, corners[k]));
      };
      if (corners[k] >= limit) refuse(fmt::format("vertex indices below {}", limit));
      const auto owner =
          std::upper_bound(first_vertex_.begin(), first_vertex_.begin() + static_cast<std::ptrdiff_t>(d) + 1, std::uint64_t{corners[k]}) -
          first_vertex_.begin() - 1;
      if (header_.draws[static_cast<std::size_t>(owner)].clip_space != header_.draws[d].clip_space) refuse("a vertex of the same space");
    }
    return corners;
  }

 private:
  static constexpr float kMostPosition = 3.402823466e38f;  // the ranges of raster space are validate()'s business
  static constexpr float kMostAttribute = 0x1p40f;

  template <class Visit>
  void for_each_vertex(bool clip_space, const Visit& visit) const {
    for (std::size_t d = 0; d < header_.draws.size(); ++d)
      for (std::uint64_t n = 0; header_.draws[d].clip_space == clip_space && n < header_.draws[d].vertex_count; ++n)
        visit(d, first_vertex_[d] + n, file_.data() + vertices_at_[d] + n * kDrawsVertexBytes);
  }

  // The float in place k of the record at `at`.
  [[nodiscard]] float number(std::size_t d, std::uint64_t n, const std::byte* at, std::size_t k, char field, float most) const {
    const auto value = load<float>(at + 4 * k);
    if (!(std::abs(value) <= most)) {
      fail_at_byte(name_, static_cast<std::size_t>(at - file_.data()) + 4 * k,
                   fmt::format("draws[{}], vertex {}: {}: expected a finite number of at most {}, got {}", d, n, field, most, value));
    }
    return value;
  }

  const DrawsHeader& header_;
  std::span<const std::byte> file_;
  const std::string& name_;
  std::vector<std::size_t> vertices_at_, triangles_at_;
  std::vector<std::uint64_t> first_vertex_;
  std::uint64_t vertex_count_ = 0;
};

DrawList make_list(const DrawsHeader& header, const DrawsArrays& arrays) {
  DrawList list;
  const std::vector<std::uint32_t> raster_index = arrays.add_raster_vertices(list);
  const bool any_clip = std::any_of(header.draws.begin(), header.draws.end(), [](const DrawsDraw& d) { return d.clip_space; });
  const std::vector<ClipVertex> clip = any_clip ? arrays.clip_vertices() : std::vector<ClipVertex>();
  ClipPlacer placer(clip, header.frame, list);
  for (std::size_t d = 0; d < header.draws.size(); ++d) {
    Draw draw = header.draws[d].draw;
    const std::uint32_t file_triangle = draw.first_triangle;
    draw.first_triangle = static_cast<std::uint32_t>(list.triangles.size());
    for (std::uint32_t t = 0; t < header.draws[d].draw.triangle_count; ++t) {
      const std::array<std::uint32_t, 3> corners = arrays.triangle(d, t);
      if (header.draws[d].clip_space)
        placer.add(corners);
      else
        list.triangles.push_back({raster_index[corners[0]], raster_index[corners[1]], raster_index[corners[2]]});
      if (any_clip) list.source_faces.resize(list.triangles.size(), file_triangle + t);
    }
    draw.triangle_count = static_cast<std::uint32_t>(list.triangles.size() - draw.first_triangle);
    if (draw.triangle_count > 0 || !header.draws[d].clip_space) list.draws.push_back(draw);
  }
  return list;
}

Image as_declared(Image image, const DrawsImage& declared, const std::string& file, std::size_t n) {
  if (declared.top_first) image = flipped_rows(image);
  if (!declared.srgb) return image;
  if (image.format().type != ChannelType::unorm8)
    fail_file(file, fmt::format("images[{}].color_space: expected 8-bit texels for 'srgb', got {}", n, to_string(image.format())));
  Image curved(image.width(), image.height(), {ChannelType::srgb8, image.format().channels});
  std::copy(image.bytes().begin(), image.bytes().end(), curved.bytes().begin());
  return curved;
}

Image load_from_disk(const std::filesystem::path& path, const std::string& sha256) {
  const FileBytes bytes = read_file(path);
  const std::string got = sha256_hex(bytes.bytes());
  if (got != sha256) fail_file(path.string(), fmt::format("expected sha256 {}, got {}", sha256, got));
  return decode_image(bytes.bytes(), path.string());
}

}  // namespace

DrawsFile decode_draws(std::span<const std::byte> bytes, const std::string& name, const std::filesystem::path& folder,
                       const DrawsImageLoader& load_image) {
  const DefaultFloatEnvironment environment;
  if (bytes.size() < kDrawsPreambleBytes || std::memcmp(bytes.data(), kDrawsSignature.data(), kDrawsSignature.size()) != 0)
    fail_file(name, fmt::format("expected the signature '{}' and the size of a header, got something else", kDrawsSignature));
  const auto header_bytes = load<std::uint64_t>(bytes.data() + kDrawsSignature.size());
  const std::uint64_t most = std::min<std::uint64_t>(kDrawsHeaderLimitBytes, bytes.size() - kDrawsPreambleBytes);
  if (header_bytes > most)
    fail_at_byte(name, kDrawsSignature.size(), fmt::format("expected a header of at most {} bytes, got {}", most, header_bytes));
  const DrawsHeader header = parse_draws_header(bytes.subspan(kDrawsPreambleBytes, static_cast<std::size_t>(header_bytes)), name);
  const DrawsArrays arrays(header, bytes, kDrawsPreambleBytes + static_cast<std::size_t>(header_bytes), name);
  DrawsFile result;
  result.frame = header.frame;
  result.sha256 = sha256_hex(bytes);
  try {
    validate(result.frame);
    result.list = make_list(header, arrays);
  } catch (const InputError& error) {
    if (std::string(error.what()).starts_with(name)) throw;
    fail_file(name, error.what());
  }
  for (std::size_t n = 0; n < header.images.size(); ++n) {
    result.image_paths.push_back(folder / header.images[n].path);
    result.list.images.push_back(std::make_shared<const Image>(
        as_declared(load_image(result.image_paths.back(), header.images[n].sha256), header.images[n], name, n)));
  }
  try {
    validate(result.list, result.frame);
  } catch (const InputError& error) {
    fail_file(name, error.what());
  }
  return result;
}

DrawsFile read_draws(const std::filesystem::path& path) {
  const FileBytes bytes = read_file(path);
  return decode_draws(bytes.bytes(), path.string(), path.parent_path(), load_from_disk);
}

}  // namespace etalon::io
