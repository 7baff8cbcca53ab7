// What a stream decodes to, as one hash: every number that a reader gets out of it, in a written order.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace etalon::test {

/// SHA-256 of what `bytes` decode to, by the extension of `path`: .epm (every level and the cells), .ettm (terrain: heights, levels, view), .etws
/// (texture), .ejt (both), .draws (its images beside `path`). InputError as their readers; for another extension too.
[[nodiscard]] std::string decoded_sha256(const std::filesystem::path& path, std::span<const std::byte> bytes);

}  // namespace etalon::test
