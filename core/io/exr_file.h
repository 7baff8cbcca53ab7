// OpenEXR files of named channels: what OpenImageIO's one-type images cannot carry (half, float and uint32 side by side: `R G B A`,
// `id.triangle`, `Z`, `margin.edge`, `bound.uv`, …), with text in the header.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/image/image.h"

namespace etalon::io {

/// The channels of one image under their names in the file.
struct ExrLayer {
  std::vector<std::string> channel_names;  ///< one for each channel of `image`
  Image image;                             ///< half, float32 or uint32
};

struct ExrContent {
  std::vector<ExrLayer> layers;                   ///< all of one size; channel names all different
  std::map<std::string, std::string> attributes;  ///< text attributes of the header, e.g. "drawListSha256"
};

/// Writes one scanline image (ZIP, no loss) atomically; rows flipped as in image_file.h. WriteError where the file cannot be written, where
/// there is no layer, sizes differ, a name is empty, longer than 255 bytes or used twice, a type is none of the three, or an attribute's
/// name is one of OpenEXR's own of another type.
void write_exr(const std::filesystem::path& path, const ExrContent& content);

/// All channels, one layer each, in ascending order of their names (the file's own order), and all text attributes. InputError for anything
/// missing, truncated or corrupt, deep or multi-part files, subsampled channels, a side over 32768 (refused before decoding).
[[nodiscard]] ExrContent read_exr(const std::filesystem::path& path);

/// The same from memory; `name` stands for the file in messages.
[[nodiscard]] ExrContent decode_exr(std::span<const std::byte> bytes, const std::string& name);

/// The named channels (1 to 4) of `content` side by side, whichever layers they are in; half and float32 together give float32.
/// InputError (beginning with `name`) where one is missing or uint32 meets another type.
[[nodiscard]] Image channels_image(const ExrContent& content, const std::vector<std::string>& channel_names, const std::string& name);

/// The colour image: RGBA, RGB, RG, R or Y, the first of these that is there.
[[nodiscard]] Image color_image(const ExrContent& content, const std::string& name);

}  // namespace etalon::io
