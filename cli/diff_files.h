// Which pictures `etalon diff` compares, where the difference goes, and idiff's spelling of options.
#pragma once

#include <string>
#include <vector>

#include "core/image/image.h"

namespace etalon::cli {

struct FilePair {
  std::string name;               ///< relative to the folders, with '/'; of two files the candidate's base name
  std::string golden, candidate;  ///< empty: missing
};

/// Two files, or the pictures below two folders (.png .jpg .jpeg .tif .tiff .exr, any case) by their relative names, sorted; where a name has
/// no other half, by the name without its ending. The textures beside a FILE.draws (STEM.0.png) are no pictures. UsageError where
/// one is a folder and the other a file; InputError where a folder cannot be read or neither holds a picture.
[[nodiscard]] std::vector<FilePair> file_pairs(const std::string& golden, const std::string& candidate);

/// idiff writes its options with one dash (-failpercent 1): those of the verb diff get the second, which CLI11 wants.
[[nodiscard]] std::vector<std::string> with_two_dashes(const std::vector<std::string>& arguments);

/// (candidate − golden) · scale, or its absolute value; what a picture lacks counts as 0. For .exr as float32, else unorm8, clamped to [0, 1].
[[nodiscard]] Image difference_image(const Image& golden, const Image& candidate, double scale, bool absolute, bool as_float);

}  // namespace etalon::cli
