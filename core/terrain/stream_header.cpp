#include "core/terrain/stream_header.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <string_view>

#include "core/base/error.h"
#include "core/base/sha256.h"
#include "core/terrain/levels.h"

namespace etalon::terrain {

namespace {

constexpr std::string_view kMagic = "eTTM";
constexpr unsigned kVersion = 1, kHasView = 1;
constexpr std::size_t kCheckDigits = 8;

// The first four bytes of the SHA-256 of all before them, as text.
std::string check_of(std::span<const std::byte> bytes) { return sha256_hex(bytes).substr(0, kCheckDigits); }

class Writer {
 public:
  void integer(std::uint64_t x, int count) {
    for (int i = 0; i < count; ++i) bytes += static_cast<char>((x >> (8 * i)) & 0xFF);
  }
  void number(double x) { integer(std::bit_cast<std::uint64_t>(x), 8); }
  void vector(const Vec3d& v) {
    for (int k = 0; k < 3; ++k) number(v[k]);
  }
  std::string bytes;
};

class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}
  std::uint64_t integer(int count) {
    if (bytes_.size() - at < static_cast<std::size_t>(count))
      throw InputError(fmt::format("terrain stream: byte {}: expected {} more bytes of the header, got {}", at, count, bytes_.size() - at));
    std::uint64_t x = 0;
    for (int i = 0; i < count; ++i) x |= std::to_integer<std::uint64_t>(bytes_[at++]) << (8 * i);
    return x;
  }
  double number() { return std::bit_cast<double>(integer(8)); }
  Vec3d vector() {
    Vec3d v;
    for (int k = 0; k < 3; ++k) v[k] = number();
    return v;
  }
  std::size_t at = 0;

 private:
  std::span<const std::byte> bytes_;
};

void read_view(Reader& in, TerrainView& view) {
  view.eye = in.vector();
  view.target = in.vector();
  view.up = in.vector();
  view.tan_half_fov_y = in.number();
  view.near = in.number();
  view.far = in.number();
  view.width = static_cast<int>(in.integer(2));
  view.height = static_cast<int>(in.integer(2));
}

void check_numbers(const StreamHeader& header, int max_bits) {
  const HeightField& grid = header.grid;
  const auto refuse = [](const std::string& what) { throw InputError("terrain stream: " + what); };
  if (grid.bits < kMinGridBits || grid.bits > kMaxGridBits || grid.bits > max_bits)
    refuse(fmt::format("byte 6: expected a grid of k {} to {}, got {}", kMinGridBits, max_bits < kMaxGridBits ? max_bits : kMaxGridBits,
                       grid.bits));
  if (header.level_count < 1 || header.level_count > kMaxLevels)
    refuse(fmt::format("byte 7: expected 1 to {} levels, got {}", kMaxLevels, header.level_count));
  try {
    validate_grid(grid);
    if (header.view) (void)ViewFrustum(*header.view);
  } catch (const InputError& error) {
    refuse(fmt::format("header: {}", error.what()));
  }
  if (header.lowest > header.highest || header.lowest <= -kMaxHeight || header.highest >= kMaxHeight)
    refuse(fmt::format("byte 41: expected heights from lowest to highest below 2^24, got {} and {}", header.lowest, header.highest));
}

}  // namespace

std::string header_bytes(const StreamHeader& header) {
  Writer out;
  for (const char c : kMagic) out.integer(static_cast<unsigned char>(c), 1);
  out.integer(kVersion, 1);
  out.integer(header.view ? kHasView : 0, 1);
  out.integer(static_cast<std::uint64_t>(header.grid.bits), 1);
  out.integer(header.level_count, 2);
  for (const double x : {header.grid.spacing, header.grid.unit, header.grid.uv_start, header.grid.uv_step}) out.number(x);
  for (const std::int32_t h : {header.lowest, header.highest}) out.integer(static_cast<std::uint32_t>(h), 4);
  if (header.view) {
    const TerrainView& view = *header.view;
    for (const Vec3d& v : {view.eye, view.target, view.up}) out.vector(v);
    for (const double x : {view.tan_half_fov_y, view.near, view.far}) out.number(x);
    out.integer(static_cast<std::uint64_t>(view.width), 2);
    out.integer(static_cast<std::uint64_t>(view.height), 2);
  }
  const std::string check = check_of(std::as_bytes(std::span(out.bytes)));
  out.integer(std::stoul(check, nullptr, 16), 4);
  return out.bytes;
}

StreamHeader read_header(std::span<const std::byte> stream, int max_bits) {
  Reader in(stream);
  for (const char c : kMagic)
    if (in.integer(1) != static_cast<unsigned char>(c)) throw InputError("terrain stream: byte 0: expected the signature eTTM");
  const std::uint64_t version = in.integer(1);
  if (version != kVersion) throw InputError(fmt::format("terrain stream: byte 4: expected version {}, got {}", kVersion, version));
  const std::uint64_t flags = in.integer(1);
  if (flags > kHasView) throw InputError(fmt::format("terrain stream: byte 5: expected flags 0 or 1, got {}", flags));
  StreamHeader header;
  header.grid.bits = static_cast<int>(in.integer(1));
  header.level_count = in.integer(2);
  header.grid.spacing = in.number();
  header.grid.unit = in.number();
  header.grid.uv_start = in.number();
  header.grid.uv_step = in.number();
  header.lowest = static_cast<std::int32_t>(static_cast<std::uint32_t>(in.integer(4)));
  header.highest = static_cast<std::int32_t>(static_cast<std::uint32_t>(in.integer(4)));
  if (flags & kHasView) read_view(in, header.view.emplace());
  const std::string expected = check_of(stream.first(in.at));
  const std::size_t check_at = in.at;
  if (fmt::format("{:08x}", in.integer(4)) != expected)
    throw InputError(fmt::format("terrain stream: byte {}: the header's checksum is wrong", check_at));
  check_numbers(header, max_bits);
  header.bytes = in.at;
  return header;
}

}  // namespace etalon::terrain
