#include "core/progressive/epm_format.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "core/progressive/epm_bytes.h"

namespace etalon::progressive {

namespace {

constexpr std::string_view kMagic = "etalonPM";
constexpr std::uint32_t tag(const char (&name)[5]) {
  return static_cast<std::uint32_t>(name[0]) | static_cast<std::uint32_t>(name[1]) << 8 | static_cast<std::uint32_t>(name[2]) << 16 |
         static_cast<std::uint32_t>(name[3]) << 24;
}
constexpr std::uint32_t kHead = tag("HEAD"), kBase = tag("BASE"), kSplits = tag("SPLT"), kDone = tag("DONE");
constexpr std::uint32_t kHasUv = 1, kHasColors = 2, kHasMaterials = 4;
constexpr std::size_t kChunkHead = 16;

// Tag, checksum, size, payload; the checksum covers the other three.
std::string chunk(std::uint32_t name, const std::string& payload) {
  ByteWriter covered;
  covered.u32(name);
  covered.u64(payload.size());
  covered.append(payload);
  ByteWriter result;
  result.u32(name);
  result.u32(crc32(std::as_bytes(std::span(covered.bytes()))));
  result.u64(payload.size());
  result.append(payload);
  return result.bytes();
}

class Encoder {
 public:
  explicit Encoder(const ProgressiveData& data) : data_(data) {}

  [[nodiscard]] std::string bytes() const {
    std::string file(kMagic);
    file += chunk(kHead, head());
    file += chunk(kBase, base());
    for (std::size_t first = 0; first < data_.splits.size(); first += kEpmBlockSplits) {
      ByteWriter block;
      for (std::size_t i = first; i < std::min(first + kEpmBlockSplits, data_.splits.size()); ++i) split(i, block);
      file += chunk(kSplits, block.bytes());
    }
    return file + chunk(kDone, "");
  }

 private:
  [[nodiscard]] std::string head() const {
    ByteWriter out;
    out.u32(kEpmVersion);
    out.u32((data_.has_uv ? kHasUv : 0) | (data_.has_colors ? kHasColors : 0) | (data_.has_materials ? kHasMaterials : 0));
    out.u32(static_cast<std::uint32_t>(data_.splits.size()));
    return out.bytes();
  }
  [[nodiscard]] std::string base() const {
    ByteWriter out;
    out.u32(data_.base_vertices);
    out.u32(data_.base_wedges);
    out.u32(data_.base_faces);
    for (std::uint32_t v = 0; v < data_.base_vertices; ++v) vertex(v, out);
    for (std::uint32_t w = 0; w < data_.base_wedges; ++w) wedge(w, out);
    for (std::uint32_t f = 0; f < data_.base_faces; ++f) face(f, out);
    return out.bytes();
  }
  void vertex(std::size_t v, ByteWriter& out) const {
    out.u32(data_.vertex_ids[v]);
    for (int k = 0; k < 3; ++k) out.f32(data_.positions[v][k]);
    for (int k = 0; k < 4 && data_.has_colors; ++k) out.f32(data_.colors[v][k]);
  }
  void wedge(std::size_t w, ByteWriter& out) const {
    out.u32(data_.wedge_ids[w]);
    out.u32(data_.wedges[w].vertex.index);
    for (int k = 0; k < 2 && data_.has_uv; ++k) out.f32(data_.wedges[w].uv[k]);
  }
  void face(std::size_t f, ByteWriter& out) const {
    out.u32(data_.face_ids[f]);
    for (const std::uint32_t w : data_.faces[f]) out.u32(w);
    if (data_.has_materials) out.u32(data_.materials[f]);
  }
  void split(std::size_t i, ByteWriter& out) const {
    const VertexSplit& s = data_.splits[i];
    const bool last = i + 1 == data_.splits.size();
    const std::size_t wedges_end = last ? data_.wedges.size() : data_.splits[i + 1].first_wedge;
    const std::size_t faces_end = last ? data_.faces.size() : data_.splits[i + 1].first_face;
    out.u32(s.parent);
    out.u8(static_cast<std::uint8_t>(faces_end - s.first_face));
    out.u8(static_cast<std::uint8_t>(wedges_end - s.first_wedge));
    out.u32(s.right_corner - s.first_corner);
    out.u32(s.end_corner - s.right_corner);
    vertex(data_.base_vertices + i, out);
    for (std::size_t w = s.first_wedge; w < wedges_end; ++w) wedge(w, out);
    for (std::size_t f = s.first_face; f < faces_end; ++f) face(f, out);
    const std::array<std::uint32_t, 3> bounds{s.first_corner, s.right_corner, s.end_corner};
    for (std::size_t side = 0; side < 2; ++side) {
      if (bounds[side] == bounds[side + 1]) continue;
      out.u32(s.wedge_of_parent[side]);
      out.u32(s.wedge[side]);
      for (std::uint32_t c = bounds[side]; c < bounds[side + 1]; ++c) out.u32(data_.corners[c]);
    }
  }
  const ProgressiveData& data_;
};

class Decoder {
 public:
  explicit Decoder(std::span<const std::byte> bytes) : in_(bytes, 0) {}

  EpmContent content() {
    if (in_.left() < kMagic.size() || !is_magic(in_.take(kMagic.size())))
      throw InputError(fmt::format("byte 0: expected the signature '{}' of a progressive mesh", kMagic));
    head(required(kHead, "HEAD"));
    base(required(kBase, "BASE"));
    bool complete = false;
    Chunk next;
    while (!complete && read(next)) {
      if (next.name == kSplits) {
        block(next.payload);
      } else if (next.name == kDone) {
        next.payload.require_end();
        complete = true;
      } else if ((next.name & 0x20u) == 0) {  // a capital letter first: must be understood
        throw InputError(fmt::format("byte {}: expected a chunk of version {}, got an unknown one", next.at, kEpmVersion));
      }
    }
    if (complete && in_.left() > 0)
      throw InputError(fmt::format("byte {}: expected the end of the file, got {} more bytes", in_.place(), in_.left()));
    if (complete && data_.splits.size() != total_)
      throw InputError(fmt::format("splits: expected {}, got {}", total_, data_.splits.size()));
    return {ProgressiveMesh(std::move(data_)), total_, complete};
  }

 private:
  struct Chunk {
    std::uint32_t name = 0;
    std::size_t at = 0;
    ByteReader payload{{}, 0};
  };

  static bool is_magic(std::span<const std::byte> bytes) {
    return std::equal(bytes.begin(), bytes.end(), kMagic.begin(), [](std::byte a, char b) { return a == static_cast<std::byte>(b); });
  }

  // False where the rest is no whole chunk: the file has been cut there.
  bool read(Chunk& next) {
    if (in_.left() < kChunkHead) return false;
    next.at = in_.place();
    const std::span<const std::byte> head = in_.take(kChunkHead);
    ByteReader fields(head, next.at);
    next.name = fields.u32();
    const std::uint32_t expected = fields.u32();
    const std::uint64_t size = fields.u64();
    if (size > in_.left()) return false;
    next.payload = ByteReader(in_.take(static_cast<std::size_t>(size)), next.at + kChunkHead);
    ByteReader again = next.payload;
    const std::uint32_t got = crc32(again.take(again.left()), crc32(head.subspan(8), crc32(head.first(4))));
    if (got != expected) throw InputError(fmt::format("byte {}: checksum: expected {:08x}, got {:08x}", next.at, expected, got));
    return true;
  }

  ByteReader required(std::uint32_t name, const char* shown) {
    const std::size_t at = in_.place();
    Chunk next;
    if (!read(next)) throw InputError(fmt::format("byte {}: the file ends inside its {} chunk", at, shown));
    if (next.name != name) throw InputError(fmt::format("byte {}: expected the {} chunk", next.at, shown));
    return next.payload;
  }

  void head(ByteReader in) {
    const std::uint32_t version = in.u32(), flags = in.u32();
    if (version != kEpmVersion) throw InputError(fmt::format("version: expected {}, got {}", kEpmVersion, version));
    if (flags > 7) throw InputError(fmt::format("flags: expected at most 7, got {}", flags));
    data_.has_uv = flags & kHasUv;
    data_.has_colors = flags & kHasColors;
    data_.has_materials = flags & kHasMaterials;
    total_ = in.u32();
    in.require_end();
  }

  void base(ByteReader in) {
    data_.base_vertices = in.u32();
    data_.base_wedges = in.u32();
    data_.base_faces = in.u32();
    for (std::uint32_t v = 0; v < data_.base_vertices; ++v) vertex(in);
    for (std::uint32_t w = 0; w < data_.base_wedges; ++w) wedge(in);
    for (std::uint32_t f = 0; f < data_.base_faces; ++f) face(in);
    in.require_end();
  }

  void vertex(ByteReader& in) {
    data_.vertex_ids.push_back(in.u32());
    Vec3f position;
    for (int k = 0; k < 3; ++k) position[k] = in.f32();
    data_.positions.push_back(position);
    if (!data_.has_colors) return;
    Vec4f color;
    for (int k = 0; k < 4; ++k) color[k] = in.f32();
    data_.colors.push_back(color);
  }
  void wedge(ByteReader& in) {
    data_.wedge_ids.push_back(in.u32());
    Wedge wedge{VertexId(in.u32()), {0, 0}};
    for (int k = 0; k < 2 && data_.has_uv; ++k) wedge.uv[k] = in.f32();
    data_.wedges.push_back(wedge);
  }
  void face(ByteReader& in) {
    data_.face_ids.push_back(in.u32());
    std::array<std::uint32_t, 3> wedges{};
    for (std::uint32_t& w : wedges) w = in.u32();
    data_.faces.push_back(wedges);
    if (data_.has_materials) data_.materials.push_back(in.u32());
  }

  void block(ByteReader in) {
    for (std::size_t i = 0; i < kEpmBlockSplits && data_.splits.size() < total_; ++i) split(in);
    in.require_end();
  }

  void split(ByteReader& in) {
    VertexSplit s;
    s.first_wedge = static_cast<std::uint32_t>(data_.wedges.size());
    s.first_face = static_cast<std::uint32_t>(data_.faces.size());
    s.first_corner = static_cast<std::uint32_t>(data_.corners.size());
    s.parent = in.u32();
    const std::uint8_t faces = in.u8(), wedges = in.u8();
    const std::array<std::uint32_t, 2> counts{in.u32(), in.u32()};
    vertex(in);
    for (int w = 0; w < wedges; ++w) wedge(in);
    for (int f = 0; f < faces; ++f) face(in);
    for (std::size_t side = 0; side < 2; ++side) {
      if (counts[side] > 0) {
        s.wedge_of_parent[side] = in.u32();
        s.wedge[side] = in.u32();
      }
      for (std::uint32_t c = 0; c < counts[side]; ++c) data_.corners.push_back(in.u32());
      (side == 0 ? s.right_corner : s.end_corner) = static_cast<std::uint32_t>(data_.corners.size());
    }
    data_.splits.push_back(s);
  }

  ByteReader in_;
  ProgressiveData data_;
  std::size_t total_ = 0;
};

}  // namespace

std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t crc) {
  static const std::array<std::uint32_t, 256> kTable = [] {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t i = 0; i < 256; ++i) {
      std::uint32_t x = i;
      for (int k = 0; k < 8; ++k) x = (x & 1u) != 0 ? 0xEDB88320u ^ (x >> 1) : x >> 1;
      table[i] = x;
    }
    return table;
  }();
  crc = ~crc;
  for (const std::byte b : bytes) crc = kTable[(crc ^ static_cast<std::uint32_t>(b)) & 0xFFu] ^ (crc >> 8);
  return ~crc;
}

std::string encode_epm(const ProgressiveData& data) { return Encoder(data).bytes(); }
EpmContent decode_epm(std::span<const std::byte> bytes) { return Decoder(bytes).content(); }

}  // namespace etalon::progressive
