#include "core/joint/joint_stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/base/error.h"
#include "core/terrain/stream_header.h"
#include "core/wavelet/checksum.h"

namespace etalon::joint {
namespace {

constexpr std::array<char, 8> kSignature = {'\x89', 'E', 'J', 'T', '\r', '\n', '\x1a', '\1'};
constexpr std::size_t kMostLevels = 65535;
enum class Kind : std::uint8_t { mesh = 'M', texture = 'T' };

void put_u32(std::vector<std::byte>& out, std::uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8) out.push_back(static_cast<std::byte>((value >> shift) & 0xFF));
}
std::uint32_t get_u32(std::span<const std::byte> bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t n = 4; n-- > 0;) value = (value << 8) | std::to_integer<std::uint32_t>(bytes[at + n]);
  return value;
}

[[noreturn]] void refuse(std::size_t at, const std::string& what) { throw InputError(fmt::format("joint stream: byte {}: {}", at, what)); }

// The level's own part of its stream.
std::span<const std::byte> part(std::span<const std::byte> stream, const std::vector<std::size_t>& ends, std::size_t level) {
  const std::size_t begin = level == 0 ? 0 : ends[level - 1];
  return stream.subspan(begin, ends[level] - begin);
}

void put_segment(std::vector<std::byte>& out, Kind kind, std::span<const std::byte> payload) {
  out.push_back(static_cast<std::byte>(kind));
  put_u32(out, static_cast<std::uint32_t>(payload.size()));
  put_u32(out, wavelet::crc32(payload));
  out.insert(out.end(), payload.begin(), payload.end());
}

// The whole segments of a prefix, put together again by kind.
struct Segments {
  std::size_t mesh_levels = 0, texture_levels = 0;  ///< of the header
  int pyramid_steps = 0;
  std::vector<std::byte> mesh, texture;
  std::size_t meshes = 0, textures = 0;
  std::size_t bytes_used = 0;
};

Segments read_segments(std::span<const std::byte> bytes) {
  if (bytes.size() < kJointHeaderBytes) refuse(bytes.size(), fmt::format("expected a header of {} bytes", kJointHeaderBytes));
  for (std::size_t n = 0; n < kSignature.size(); ++n)
    if (bytes[n] != static_cast<std::byte>(kSignature[n])) refuse(n, "not the signature of a joint stream");
  if (get_u32(bytes, 16) != wavelet::crc32(bytes.first(16))) refuse(16, "the header's checksum is wrong");
  Segments s;
  s.mesh_levels = get_u32(bytes, 8), s.texture_levels = get_u32(bytes, 12) & 0xFFFF;
  s.pyramid_steps = static_cast<int>(get_u32(bytes, 12) >> 16);
  if (s.mesh_levels < 1 || s.mesh_levels > kMostLevels || s.texture_levels < 1 || s.texture_levels > kMostLevels)
    refuse(8, fmt::format("expected 1 to {} levels, got {} and {}", kMostLevels, s.mesh_levels, s.texture_levels));
  if (s.pyramid_steps > wavelet::kMaxPyramidSteps)
    refuse(14, fmt::format("expected at most {} steps of distance, got {}", wavelet::kMaxPyramidSteps, s.pyramid_steps));
  s.bytes_used = kJointHeaderBytes;
  while (bytes.size() - s.bytes_used >= kSegmentHeadBytes) {
    const std::size_t at = s.bytes_used, length = get_u32(bytes, at + 1);
    const auto kind = static_cast<Kind>(bytes[at]);
    if (kind != Kind::mesh && kind != Kind::texture) refuse(at, "no segment of a mesh or texture");
    std::size_t& count = kind == Kind::mesh ? s.meshes : s.textures;
    if (count == (kind == Kind::mesh ? s.mesh_levels : s.texture_levels)) refuse(at, "more segments than levels");
    if (bytes.size() - at - kSegmentHeadBytes < length) break;
    const std::span<const std::byte> payload = bytes.subspan(at + kSegmentHeadBytes, length);
    if (get_u32(bytes, at + 5) != wavelet::crc32(payload)) refuse(at + 5, "the segment's checksum is wrong");
    std::vector<std::byte>& stream = kind == Kind::mesh ? s.mesh : s.texture;
    stream.insert(stream.end(), payload.begin(), payload.end());
    ++count;
    s.bytes_used = at + kSegmentHeadBytes + length;
  }
  if (s.meshes == 0 || s.textures == 0) refuse(s.bytes_used, "expected the segments of a mesh and a texture");
  if (s.meshes == s.mesh_levels && s.textures == s.texture_levels && s.bytes_used != bytes.size())
    refuse(s.bytes_used, "bytes behind the last segment");
  return s;
}

}  // namespace

bool has_joint_signature(std::span<const std::byte> bytes) {
  return bytes.size() >= kSignature.size() &&
         std::ranges::equal(bytes.first(kSignature.size()), kSignature, {}, {}, [](char c) { return static_cast<std::byte>(c); });
}

std::vector<std::byte> encode_joint(const JointLevels& levels, const Path& path) {
  const auto mesh_stream = std::as_bytes(std::span(levels.mesh_stream.bytes));
  const std::vector<std::size_t>&mesh_ends = levels.mesh_stream.level_ends_bytes, &texture_ends = levels.texture_ends_bytes;
  if (path.points.empty() || path.points.front().pair != Pair{0, 0})
    throw InputError("joint stream: expected a path from the smallest pair");
  std::vector<std::byte> out;
  for (const char c : kSignature) out.push_back(static_cast<std::byte>(c));
  put_u32(out, static_cast<std::uint32_t>(mesh_ends.size()));
  put_u32(out, static_cast<std::uint32_t>(texture_ends.size()) | static_cast<std::uint32_t>(levels.pyramid_steps) << 16);
  put_u32(out, wavelet::crc32(out));
  Pair next{0, 0};
  for (const PathPoint& point : path.points) {
    if (point.pair.mesh >= mesh_ends.size() || point.pair.texture >= texture_ends.size() || point.pair.mesh + 1 < next.mesh ||
        point.pair.texture + 1 < next.texture)
      throw InputError(fmt::format("joint stream: a path cannot go to pair ({}, {})", point.pair.mesh, point.pair.texture));
    for (; next.mesh <= point.pair.mesh; ++next.mesh) put_segment(out, Kind::mesh, part(mesh_stream, mesh_ends, next.mesh));
    for (; next.texture <= point.pair.texture; ++next.texture)
      put_segment(out, Kind::texture, part(levels.texture_stream, texture_ends, next.texture));
  }
  return out;
}

DecodedJoint decode_joint(std::span<const std::byte> bytes, const wavelet::DecodeLimits& limits) {
  const Segments s = read_segments(bytes);
  DecodedJoint result;
  result.terrain = terrain::decode_terrain(s.mesh);
  if (result.terrain.levels.count() != s.meshes || result.terrain.levels_in_whole != s.mesh_levels)
    throw InputError(
        fmt::format("joint stream: {} mesh segments hold {} levels of {}", s.meshes, result.terrain.levels.count(), s.mesh_levels));
  const wavelet::TextureHeader texture = wavelet::read_texture_header(s.texture, limits);
  wavelet::Delays delays;
  if (texture.has_delays)
    delays = delays_of(terrain::read_header(s.mesh, terrain::kMaxGridBits), texture.width, texture.height, texture.levels, s.pyramid_steps);
  result.texture = wavelet::decode_texture(s.texture, delays, limits).image;
  result.pair = {s.meshes - 1, s.textures - 1};
  result.mesh_levels = s.mesh_levels, result.texture_levels = s.texture_levels;
  result.is_complete = s.meshes == s.mesh_levels && s.textures == s.texture_levels;
  result.bytes_used = s.bytes_used;
  return result;
}

}  // namespace etalon::joint
