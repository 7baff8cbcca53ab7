// Cells as CELL chunks of an .epm file (docs/formats.md#cells): what follows from the mesh is not stored.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/adapt/adapt_sequence.h"
#include "core/progressive/epm_format.h"

namespace etalon::adapt {

/// Of the rules by which cells follow from the mesh and what is stored.
inline constexpr std::uint8_t kCellRules = 1;

/// One chunk behind each block of splits, for encode_epm(): of a ring its status, and where it has cells the shares and u's place after; about
/// 12 bytes a split. Equal cells give equal bytes.
[[nodiscard]] std::vector<progressive::EpmExtra> encode_cells(const AdaptSequence& sequence);

/// The cells that encode_cells() was given, bit for bit: made again from the mesh with what is stored, every area tested, all compared with the
/// checksum in each block. Nothing where there is no CELL chunk. A prefix of a file may end between a block and its cells: the splits of that
/// block then have none. The mesh is left at its base. `progress` hears of splits done and in all about every 1,000; an exception of it stops the
/// work. InputError "CELL of splits A to B: what, expected, got": a block without its chunk, or with two, other rules, and whatever is not what
/// encode_cells() writes for this mesh.
[[nodiscard]] std::optional<AdaptSequence> decode_cells(progressive::EpmContent& content,
                                                        const std::function<void(std::size_t, std::size_t)>& progress = {});

/// How many bytes of a file its CELL chunks take, with their heads.
[[nodiscard]] std::size_t cell_chunk_bytes(const std::vector<progressive::EpmExtra>& extras);

}  // namespace etalon::adapt
