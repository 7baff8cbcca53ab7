#include "core/adapt/cell_chunks.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>

#include "core/base/error.h"
#include "core/progressive/epm_bytes.h"
#include "core/progressive/epm_chunks.h"

namespace etalon::adapt {
namespace {

using progressive::ByteReader;
using progressive::ByteWriter;
using progressive::EpmExtra;
using progressive::kEpmBlockSplits;

constexpr std::string_view kTag = "CELL";

// One byte: the ring's status; with cells a second one: the shares' places in their lists, and the overlay's plane.
constexpr int kCrossingShift = 3, kPlaneShift = 6;

void put_number(ByteWriter& out, const Vec2f& p) { out.f32(p.x), out.f32(p.y); }

std::uint8_t shares_of(const RingCells& cells) {
  return static_cast<std::uint8_t>(index_of_place_share(cells.u_kept) | index_of_crossing_share(cells.crossings_kept) << kCrossingShift |
                                   static_cast<int>(cells.plane) << kPlaneShift);
}

// Every bit of a split's cells, for the checksum.
void put_all(ByteWriter& out, const std::vector<ChartCells>& charts) {
  for (const ChartCells& chart : charts) {
    out.u8(static_cast<std::uint8_t>(chart.status));
    out.u8(shares_of(chart.cells));
    out.u32(static_cast<std::uint32_t>(chart.cells.nodes.size())), out.u32(static_cast<std::uint32_t>(chart.cells.cells.size()));
    for (const CellNode& node : chart.cells.nodes) put_number(out, node.before), put_number(out, node.after);
    for (const auto& cell : chart.cells.cells)
      for (const std::uint16_t corner : cell) out.u8(static_cast<std::uint8_t>(corner)), out.u8(static_cast<std::uint8_t>(corner >> 8));
  }
}

std::uint32_t checksum_of(const ByteWriter& all, std::uint32_t before) {
  return progressive::crc32(std::as_bytes(std::span(all.bytes())), before);
}

void put_chosen(ByteWriter& out, const std::vector<ChartCells>& charts) {
  out.u8(static_cast<std::uint8_t>(charts.size()));
  for (const ChartCells& chart : charts) {
    out.u8(static_cast<std::uint8_t>(chart.status));
    if (chart.status != CellStatus::made) continue;
    out.u8(shares_of(chart.cells));
    if (chart.cells.plane == OverlayPlane::texture_after) put_number(out, chart.cells.nodes[0].after);
  }
}

// What a block's chunk says of one ring.
struct Chosen {
  CellStatus status = CellStatus::made;
  CellChoice choice;
};

Chosen chosen_from(ByteReader& in) {
  Chosen chosen;
  const std::uint8_t status = in.u8();
  if (status >= kCellStatusCount) throw InputError(fmt::format("status: expected below {}, got {}", kCellStatusCount, status));
  chosen.status = static_cast<CellStatus>(status);
  if (chosen.status != CellStatus::made) return chosen;
  const std::uint8_t shares = in.u8();
  const std::size_t place = shares & 7u, crossing = shares >> kCrossingShift & 7u, plane = shares >> kPlaneShift;
  if (place >= kPlaceShares.size() || crossing >= kCrossingShares.size() || plane >= kOverlayPlaneCount)
    throw InputError(fmt::format("shares: expected below {} and {}, plane below {}, got {}, {}, {}", kPlaceShares.size(),
                                 kCrossingShares.size(), kOverlayPlaneCount, place, crossing, plane));
  CellChoice& choice = chosen.choice;
  choice = {static_cast<OverlayPlane>(plane), kPlaceShares[place], kCrossingShares[crossing], {0, 0}};
  if (choice.plane != OverlayPlane::texture_after) return chosen;
  choice.place.x = in.f32(), choice.place.y = in.f32();
  if (!std::isfinite(choice.place.x) || !std::isfinite(choice.place.y)) throw InputError("place of u: expected finite numbers");
  return chosen;
}

ChartCells cells_chosen(const ChartRing& ring, const Chosen& chosen) {
  const auto refuse = [&](const char* expected, CellStatus got) {
    throw InputError(fmt::format("status: expected {} for this ring, got {}", expected, to_string(got)));
  };
  if (ring.status != CellStatus::made && chosen.status != ring.status) refuse(to_string(ring.status), chosen.status);
  if (ring.status == CellStatus::made && chosen.status != CellStatus::made && chosen.status != CellStatus::no_place)
    refuse("made or no_place", chosen.status);
  if (chosen.status != CellStatus::made) return {chosen.status, {}};
  ChartCells cells = chart_cells_at(ring, chosen.choice);
  if (cells.status != CellStatus::made)
    throw InputError(
        fmt::format("place of u: expected one that leaves all cells positive, got {} {}", chosen.choice.place.x, chosen.choice.place.y));
  return cells;
}

// The chunk of each block, by its number.
std::vector<const EpmExtra*> by_block(const std::vector<EpmExtra>& extras, std::size_t splits) {
  std::vector<const EpmExtra*> result((splits + kEpmBlockSplits - 1) / kEpmBlockSplits, nullptr);
  for (const EpmExtra& extra : extras) {
    if (extra.tag != kTag) continue;
    if (extra.after_splits == 0) throw InputError("CELL of splits 0 to 0: expected behind a block of splits, got behind the base");
    const EpmExtra*& place = result[(extra.after_splits - 1) / kEpmBlockSplits];
    if (place != nullptr) throw InputError(fmt::format("CELL of splits up to {}: expected once, got twice", extra.after_splits));
    place = &extra;
  }
  return result;
}

// Cells of one block, each at its level; downward, as they were made.
void decode_block(progressive::ProgressiveMesh& mesh, std::size_t first, std::size_t end, const EpmExtra& chunk, VertexFaces& faces,
                  CellStore& store) {
  ByteReader in(std::as_bytes(std::span(chunk.payload)), 0);
  if (const std::uint8_t rules = in.u8(); rules != kCellRules)
    throw InputError(fmt::format("rules: expected {}, got {}: make the file again", kCellRules, rules));
  const std::uint32_t expected = in.u32();
  std::vector<std::vector<Chosen>> chosen(end - first);
  for (std::vector<Chosen>& rings : chosen) {
    rings.resize(in.u8());
    for (Chosen& ring : rings) ring = chosen_from(in);
  }
  in.require_end();
  std::uint32_t got = 0;
  for (std::size_t n = end; n-- > first;) {
    mesh.go_to(n + 1);
    const std::vector<ChartRing> rings = rings_of_split(mesh, n, &faces);
    const std::vector<Chosen>& said = chosen[n - first];
    if (rings.size() != said.size()) throw InputError(fmt::format("split {}: rings: expected {}, got {}", n, rings.size(), said.size()));
    std::vector<ChartCells> charts;
    for (std::size_t k = 0; k < rings.size(); ++k) charts.push_back(cells_chosen(rings[k], said[k]));
    ByteWriter all;
    put_all(all, charts);
    got = checksum_of(all, got);
    store.put(n, charts);
    faces.coarsen(mesh, n);
  }
  if (got != expected) throw InputError(fmt::format("checksum of the cells: expected {:08x}, got {:08x}", expected, got));
}

}  // namespace

std::vector<EpmExtra> encode_cells(const AdaptSequence& sequence) {
  std::vector<EpmExtra> chunks;
  std::vector<ChartCells> charts;
  for (std::size_t first = 0; first < sequence.size(); first += kEpmBlockSplits) {
    const std::size_t end = std::min(first + kEpmBlockSplits, sequence.size());
    ByteWriter chosen, out;
    for (std::size_t n = first; n < end; ++n) {
      sequence.read(n, charts);
      put_chosen(chosen, charts);
    }
    std::uint32_t checksum = 0;
    for (std::size_t n = end; n-- > first;) {
      sequence.read(n, charts);
      ByteWriter all;
      put_all(all, charts);
      checksum = checksum_of(all, checksum);
    }
    out.u8(kCellRules);
    out.u32(checksum);
    out.append(chosen.bytes());
    chunks.push_back({std::string(kTag), end, out.bytes()});
  }
  return chunks;
}

std::optional<AdaptSequence> decode_cells(progressive::EpmContent& content, const std::function<void(std::size_t, std::size_t)>& progress) {
  progressive::ProgressiveMesh& mesh = content.mesh;
  const std::vector<EpmExtra>& extras = content.extras;
  if (std::none_of(extras.begin(), extras.end(), [](const EpmExtra& extra) { return extra.tag == kTag; })) return std::nullopt;
  if (!mesh.data().has_uv) throw InputError("CELL: expected a mesh with texture coordinates, got one without");
  const std::size_t splits = mesh.split_count();
  const std::vector<const EpmExtra*> chunks = by_block(extras, splits);
  CellStore store(splits);
  mesh.go_to(splits);
  VertexFaces faces(mesh);
  constexpr std::size_t kBlocksBetweenReports = 16;
  for (std::size_t block = chunks.size(); block-- > 0;) {
    const std::size_t first = block * kEpmBlockSplits, end = std::min(first + kEpmBlockSplits, splits);
    const auto refuse = [&](const char* what) { throw InputError(fmt::format("CELL of splits {} to {}: {}", first, end, what)); };
    if (chunks[block] == nullptr && !content.complete && block + 1 == chunks.size()) {
      for (std::size_t n = end; n-- > first;) faces.coarsen(mesh, n);
      continue;
    }
    if (chunks[block] == nullptr) refuse("expected a chunk for each block of splits, got none here");
    try {
      decode_block(mesh, first, end, *chunks[block], faces, store);
    } catch (const InputError& error) {
      refuse(error.what());
    }
    if (progress && block % kBlocksBetweenReports == 0) progress(splits - first, splits);
  }
  mesh.go_to(0);
  return AdaptSequence(std::move(store));
}

std::size_t cell_chunk_bytes(const std::vector<EpmExtra>& extras) {
  std::size_t bytes = 0;
  for (const EpmExtra& extra : extras)
    if (extra.tag == kTag) bytes += progressive::kChunkHead + extra.payload.size();
  return bytes;
}

}  // namespace etalon::adapt
