// What the verbs hold for each triangle beside the mesh that they read, as a lower bound: below it a run cannot end well, so that it is
// refused before the file is parsed (core/io/mesh_file.h, read_mesh).
//
// Measured as the growth of `run.peak_bytes` from 0.5 to 1 million faces of `etalon make knot` (vertex colours, no coordinates, 32 bytes a
// face as a mesh), one thread more or less changing nothing: info 130, render 113, bake 156, simplify (qem) 163, metro 135 for each of its
// two, progressive 265. Four fifths of what is left beside the mesh are asked for; other metrics and textures take more, never less.
#pragma once

#include <cstdint>

namespace etalon::cli {

constexpr std::uint64_t kMinDrawBytesPerFace = 64;
constexpr std::uint64_t kMinValidateBytesPerFace = 78;
constexpr std::uint64_t kMinMetroBytesPerFace = 82;
constexpr std::uint64_t kMinSimplifyBytesPerFace = 99;
constexpr std::uint64_t kMinProgressiveBytesPerFace = 186;

}  // namespace etalon::cli
