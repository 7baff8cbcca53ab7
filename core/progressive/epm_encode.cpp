#include <algorithm>
#include <array>

#include "core/progressive/epm_bytes.h"
#include "core/progressive/epm_chunks.h"
#include "core/progressive/epm_format.h"

namespace etalon::progressive {

namespace {

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
  Encoder(const ProgressiveData& data, const std::vector<EpmExtra>& extras) : data_(data), extras_(extras) {}

  [[nodiscard]] std::string bytes() {
    check_extras();
    std::string file(kMagic);
    file += chunk(kHead, head());
    file += chunk(kBase, base());
    if (!data_.material_names.empty()) file += chunk(kNames, names());
    add_extras(0, file);
    for (std::size_t first = 0; first < data_.splits.size(); first += kEpmBlockSplits) {
      const std::size_t end = std::min(first + kEpmBlockSplits, data_.splits.size());
      ByteWriter block;
      for (std::size_t i = first; i < end; ++i) split(i, block);
      file += chunk(kSplits, block.bytes());
      add_extras(end, file);
    }
    return file + chunk(kDone, "");
  }

 private:
  void check_extras() const {
    std::size_t place = 0;
    for (const EpmExtra& extra : extras_) {
      if (extra.tag.size() != 4 || !may_pass(name_of(extra)))
        throw InputError(fmt::format("extra chunk: expected CELL, BMAP or four letters, the first small, got '{}'", extra.tag));
      const std::size_t at = extra.after_splits;
      if (at < place || at > data_.splits.size() || (at % kEpmBlockSplits != 0 && at != data_.splits.size()))
        throw InputError(
            fmt::format("extra chunk {}: expected in order behind whole blocks of {} splits, got {}", extra.tag, kEpmBlockSplits, at));
      place = at;
    }
  }
  static std::uint32_t name_of(const EpmExtra& extra) {
    std::uint32_t name = 0;
    for (std::size_t i = 0; i < 4; ++i) name |= static_cast<std::uint32_t>(static_cast<unsigned char>(extra.tag[i])) << (8 * i);
    return name;
  }
  void add_extras(std::size_t after_splits, std::string& file) {
    for (; next_extra_ < extras_.size() && extras_[next_extra_].after_splits == after_splits; ++next_extra_)
      file += chunk(name_of(extras_[next_extra_]), extras_[next_extra_].payload);
  }
  [[nodiscard]] std::string names() const {
    ByteWriter out;
    out.u32(static_cast<std::uint32_t>(data_.material_names.size()));
    for (const std::string& name : data_.material_names) {
      out.u32(static_cast<std::uint32_t>(name.size()));
      out.append(name);
    }
    return out.bytes();
  }
  [[nodiscard]] std::string head() const {
    ByteWriter out;
    out.u32(kEpmVersion);
    out.u32((data_.has_uv ? kHasUv : 0) | (data_.has_colors ? kHasColors : 0) | (data_.has_materials ? kHasMaterials : 0) |
            (data_.moves.empty() ? 0 : kHasMoves));
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
    if (!data_.moves.empty()) move(s, out);
  }
  void move(const VertexSplit& s, ByteWriter& out) const {
    if (s.move == kNone) return out.u8(0);
    const ParentMove& m = data_.moves[s.move];
    const auto sides = static_cast<std::uint8_t>((m.wedge[0] != kNone ? kMovesLeft : 0) | (m.wedge[1] != kNone ? kMovesRight : 0));
    out.u8(kMovesParent | sides);
    for (int k = 0; k < 3; ++k) out.f32(m.position[k]);
    for (int k = 0; k < 4 && data_.has_colors; ++k) out.f32(m.color[k]);
    for (std::size_t side = 0; side < 2; ++side) {
      if (m.wedge[side] == kNone) continue;
      out.u32(m.wedge[side]);
      for (int k = 0; k < 2; ++k) out.f32(m.uv[side][k]);
    }
  }
  const ProgressiveData& data_;
  const std::vector<EpmExtra>& extras_;
  std::size_t next_extra_ = 0;
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

std::string encode_epm(const ProgressiveData& data, const std::vector<EpmExtra>& extras) { return Encoder(data, extras).bytes(); }

}  // namespace etalon::progressive
