#include <algorithm>
#include <array>

#include "core/progressive/epm_bytes.h"
#include "core/progressive/epm_chunks.h"
#include "core/progressive/epm_format.h"

namespace etalon::progressive {

namespace {

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
      } else if (next.name == kNames) {
        names(next);
      } else if (next.name == kDone) {
        next.payload.require_end();
        complete = true;
      } else if (may_pass(next.name)) {
        extras_.push_back({text_of(next.name), data_.splits.size(), bytes_of(next.payload)});
      } else {
        throw InputError(fmt::format("byte {}: expected a chunk of version {}, got an unknown one", next.at, kEpmVersion));
      }
    }
    if (complete && in_.left() > 0)
      throw InputError(fmt::format("byte {}: expected the end of the file, got {} more bytes", in_.place(), in_.left()));
    if (complete && data_.splits.size() != total_)
      throw InputError(fmt::format("splits: expected {}, got {}", total_, data_.splits.size()));
    return {ProgressiveMesh(std::move(data_)), total_, complete, std::move(extras_)};
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

  static std::string bytes_of(ByteReader payload) {
    const std::span<const std::byte> bytes = payload.take(payload.left());
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }

  // Behind the base, once.
  void names(Chunk chunk) {
    if (!data_.splits.empty() || !data_.material_names.empty())
      throw InputError(fmt::format("byte {}: expected the names of materials once, before the splits", chunk.at));
    ByteReader& in = chunk.payload;
    const std::uint32_t count = in.u32();
    if (count == 0) throw InputError(fmt::format("byte {}: expected at least one name", chunk.at));
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::span<const std::byte> bytes = in.take(in.u32());
      data_.material_names.emplace_back(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    }
    in.require_end();
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
    if (flags > kAllFlags) throw InputError(fmt::format("flags: expected at most {}, got {}", kAllFlags, flags));
    data_.has_uv = flags & kHasUv;
    data_.has_colors = flags & kHasColors;
    data_.has_materials = flags & kHasMaterials;
    has_moves_ = flags & kHasMoves;
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
    if (has_moves_) move(in, s);
    data_.splits.push_back(s);
  }

  void move(ByteReader& in, VertexSplit& s) {
    const std::uint8_t moves = in.u8();
    if (moves == 0) return;
    if ((moves & kMovesParent) == 0 || moves > (kMovesParent | kMovesLeft | kMovesRight))
      throw InputError(fmt::format("byte {}: move: expected 0, or 1 and perhaps 2 and 4, got {}", in.place() - 1, moves));
    s.move = static_cast<std::uint32_t>(data_.moves.size());
    ParentMove& m = data_.moves.emplace_back();
    for (int k = 0; k < 3; ++k) m.position[k] = in.f32();
    for (int k = 0; k < 4 && data_.has_colors; ++k) m.color[k] = in.f32();
    for (std::size_t side = 0; side < 2; ++side) {
      if ((moves & (side == 0 ? kMovesLeft : kMovesRight)) == 0) continue;
      m.wedge[side] = in.u32();
      if (m.wedge[side] == kNone) throw InputError(fmt::format("byte {}: moved wedge: expected one", in.place() - 4));
      for (int k = 0; k < 2; ++k) m.uv[side][k] = in.f32();
    }
  }

  ByteReader in_;
  ProgressiveData data_;
  std::size_t total_ = 0;
  bool has_moves_ = false;
  std::vector<EpmExtra> extras_;
};

}  // namespace

EpmContent decode_epm(std::span<const std::byte> bytes) { return Decoder(bytes).content(); }

}  // namespace etalon::progressive
